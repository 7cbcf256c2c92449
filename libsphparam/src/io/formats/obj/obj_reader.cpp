#include "io/formats/obj/obj_reader.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "io/attributes/material_comments.h"
#include "io/attributes/named_file.h"
#include "io/attributes/remarks.h"
#include "io/files/text_scanner.h"
#include "io/formats/obj/obj_materials.h"
#include "io/formats/obj/obj_other_statements.h"
#include "io/formats/shapes/shape_tables.h"
#include "number_text.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/polygons.h"

// One pass over the lines fills flat arrays; faces hold three indices a corner (v/vt/vn), vt and vn
// only from the first corner that has one. An index may name a vertex of a later line, so indices
// beyond the current count are remembered with their line and judged at the end. Polygons are cut
// when all positions are known; corner attributes follow the corners.

namespace sphparam {
namespace {

constexpr int no_index = -1;

/// Indices that name something not read yet, in order of appearance. Only new maxima are kept: the
/// first index out of range at the end is one of them.
class ForwardReferences {
 public:
  void note(std::int64_t index, long line) {
    if (found_.empty() || index > found_.back().index) found_.push_back({index, line});
  }

  void check(std::int64_t count, const char* what, const TextScanner& scanner) const {
    for (const auto& [index, line] : found_)
      if (index >= count)
        scanner.fail_at(line, std::string("face names ") + what + " " + std::to_string(index + 1) +
                                  " of " + std::to_string(count));
  }

 private:
  struct Reference {
    std::int64_t index;
    long line;
  };
  std::vector<Reference> found_;
};

/// A kind of thing that corners point at: v, vt or vn.
struct IndexedKind {
  const char* name;
  std::int64_t count = 0;
  ForwardReferences forward;
};

/// One index a corner, stored from the first corner that has one.
struct CornerIndices {
  std::vector<int> values;

  void set(std::size_t corner, int index) {
    if (index == no_index) return;
    values.resize(corner, no_index);
    values.push_back(index);
  }
  bool used() const { return !values.empty(); }
};

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& name,
            const std::optional<std::filesystem::path>& folder, const ReadOptions& options)
      : scanner_(text, name, options), folder_(folder), options_(options) {
    scanner_.require_text();
    // A line of a vertex or a face has about 25 bytes.
    constexpr std::size_t usual_line_bytes = 25;
    const std::size_t lines = text.size() / usual_line_bytes;
    positions_.reserve(lines);
    polygons_.corners.reserve(2 * lines);
    polygons_.starts.reserve(lines);
  }

  MeshFile read() {
    while (scanner_.next_line()) read_line();
    if (polygons_.count() == 0 || vertices_.count == 0) others_.refuse_unknown(scanner_);
    check_forward_references();
    if (first_zero_line_ > 0) count_from_zero();
    return finish();
  }

 private:
  void read_line() {
    if (scanner_.at_line_end()) {
      if (scanner_.at_comment()) read_comment();
      return;
    }
    in_header_ = false;
    scanner_.join_continued_lines();
    const std::string_view keyword = scanner_.word();
    if (keyword == "v") return read_vertex();
    if (keyword == "f") return read_face();
    if (keyword == "vt") return read_texcoord();
    if (keyword == "vn") return read_normal();
    if (keyword == "usemtl") return read_material();
    others_.note(std::string(keyword), scanner_);
  }

  /// Some programs write one a face; ZBrush writes the colours of 64 vertices into each of them.
  void read_comment() {
    constexpr const char* of_zbrush = "#MRGB";
    if (scanner_.peek_rest().starts_with(of_zbrush)) {
      others_.leave_out(of_zbrush);
      return;
    }
    std::string comment = one_line(scanner_.comment());
    if (!in_header_ && is_tally(comment)) return;
    if (!in_header_ && ++later_comments_ > most_later_comments) return;
    file_.comments.push_back(std::move(comment));
  }

  void read_vertex() {
    if (positions_.empty()) is_of_fortran_ = has_fortran_exponent(scanner_.peek_rest());
    if (is_of_fortran_) {
      for (const double coordinate : table_vector(scanner_, options_.non_finite))
        positions_.push_back(coordinate);
    } else {
      for (int i = 0; i < 3; ++i) positions_.push_back(scanner_.coordinate());
    }
    if (++vertices_.count > std::min(options_.max_vertices, most_vertices))
      scanner_.fail("more vertices than the limit of " + std::to_string(options_.max_vertices));
    if (!scanner_.at_line_end()) read_vertex_extras();
    expect_line_end();
  }

  // x y z w, or x y z r g b [a].
  void read_vertex_extras() {
    std::array<float, 4> extras{};
    std::size_t count = 0;
    while (count < extras.size() && !scanner_.at_line_end()) extras[count++] = scanner_.real32();
    if (count == 1) {
      weights_ |= extras[0] != 1;
      return;
    }
    if (count < 3) scanner_.fail("vertex has 5 numbers: neither coordinates nor colours");
    if (colour_channels_ == 0) colour_channels_ = count;
    if (count == colour_channels_) {
      colours_.insert(colours_.end(), extras.begin(), extras.begin() + count);
      ++coloured_;
    }
  }

  void read_texcoord() {
    const double s = scanner_.real();
    const double t = scanner_.at_line_end() ? 0 : scanner_.real();
    if (!scanner_.at_line_end()) depths_ |= scanner_.real() != 0;  // of volume textures
    expect_line_end();
    texcoord_values_.insert(texcoord_values_.end(), {s, t});
    ++texcoords_.count;
  }

  void read_normal() {
    for (int i = 0; i < 3; ++i) normal_values_.push_back(scanner_.real());
    expect_line_end();
    ++normals_.count;
  }

  void read_face() {
    const std::size_t first = polygons_.corners.size();
    for (std::size_t corner = first; !scanner_.at_line_end(); ++corner) read_corner(corner);
    const std::string problem = polygons_.close_polygon(options_);
    if (!problem.empty()) scanner_.fail(problem);
    if (material_ != no_index) {
      material_of_.resize(static_cast<std::size_t>(polygons_.count() - 1), no_index);
      material_of_.push_back(material_);
    }
  }

  // v, v/vt, v//vn or v/vt/vn.
  void read_corner(std::size_t corner) {
    polygons_.add_corner(read_index(vertices_));
    if (!scanner_.skip('/')) return;
    if (!scanner_.at_token_end() && !scanner_.skip('/')) {
      corner_texcoords_.set(corner, read_index(texcoords_));
      if (!scanner_.skip('/')) return;
    }
    if (!scanner_.at_token_end()) corner_normals_.set(corner, read_index(normals_));
    if (!scanner_.at_token_end()) scanner_.fail("corner has more than three indices");
  }

  int read_index(IndexedKind& kind) {
    const long written = scanner_.index();
    counts_from_the_end_ |= written < 0;
    if (written == 0 && &kind == &vertices_) {
      if (first_zero_line_ == 0) first_zero_line_ = scanner_.line_number();
      return no_index;
    }
    if (written == 0) scanner_.fail(std::string(kind.name) + " index 0: indices start at 1");
    const std::int64_t index = written > 0 ? written - 1 : kind.count + written;
    if (index < 0)
      scanner_.fail(std::string("relative ") + kind.name + " index " + std::to_string(written) +
                    " points before the first of " + std::to_string(kind.count));
    if (index > std::numeric_limits<int>::max())
      scanner_.fail(std::string(kind.name) + " index " + std::to_string(written) +
                    " is out of range");
    if (index >= kind.count) [[unlikely]]
      kind.forward.note(index, scanner_.line_number());
    return static_cast<int>(index);
  }

  /// Tables of shape models (v x y z, f a b c) may count from 0: they name vertex 0, and as the
  /// largest the last one. Throws: ReadError for any other index 0.
  void count_from_zero() {
    const int largest = *std::max_element(polygons_.corners.begin(), polygons_.corners.end()) + 1;
    const bool bare = !corner_texcoords_.used() && !corner_normals_.used();
    if (!bare || counts_from_the_end_ || largest != vertices_.count - 1)
      scanner_.fail_at(first_zero_line_, "vertex index 0: indices start at 1");
    for (int& corner : polygons_.corners) ++corner;
    file_.notes.push_back("faces count vertices from 0");
  }

  /// Programs that name a material so which has no name say in its library what it is.
  bool is_none(const std::string& name) {
    if (name != obj_no_material) return false;
    if (!null_is_none_)
      null_is_none_ =
          !folder_ ||
          read_obj_materials({name}, others_.libraries(), *folder_, options_).base_colours.empty();
    return *null_is_none_;
  }

  void read_material() {
    const std::string name = one_line(scanner_.rest());
    if (is_none(name)) {
      material_ = no_index;
      return;
    }
    const auto [found, is_new] =
        material_ids_.try_emplace(name, static_cast<int>(file_.materials.size()));
    if (is_new) file_.materials.push_back(name);
    material_ = found->second;
  }

  void expect_line_end() {
    if (!scanner_.at_line_end())
      scanner_.fail("unexpected " + sphparam::quoted(scanner_.peek_word()) +
                    " at the end of the line");
  }

  void check_forward_references() const {
    vertices_.forward.check(vertices_.count, "vertex", scanner_);
    texcoords_.forward.check(texcoords_.count, "texture coordinate", scanner_);
    normals_.forward.check(normals_.count, "normal", scanner_);
  }

  MeshFile finish() {
    file_.format = "OBJ";
    file_.mesh.positions = Eigen::Map<const Points>(positions_.data(), vertices_.count, 3);
    Triangulation triangulation = triangulate(file_.mesh.positions, polygons_);
    add_materials();
    add_colours();
    add_texcoords(triangulation);
    add_normals(triangulation);
    adopt_triangulation(file_, std::move(triangulation));
    add_notes();
    return std::move(file_);
  }

  void add_materials() {
    if (file_.materials.empty()) return;
    material_of_.resize(static_cast<std::size_t>(polygons_.count()), no_index);
    file_.set_face_property(
        {"material", ScalarType::Int32, {material_of_.begin(), material_of_.end()}});
  }

  /// OBJ has fractions; what some write instead would be white all over.
  bool colours_are_bytes() const {
    const auto is_byte = [](float value) {
      return holds_exactly(ScalarType::Uint8, static_cast<double>(value));
    };
    return std::ranges::all_of(colours_, is_byte) &&
           std::ranges::any_of(colours_, [](float value) { return value > 1; });
  }

  void add_colours() {
    if (colour_channels_ == 0) return;
    if (coloured_ != vertices_.count) {
      add_loss(file_.notes, "colours: only " + std::to_string(coloured_) + " of " +
                                std::to_string(vertices_.count) + " vertices have them");
      return;
    }
    const char* const names[] = {"red", "green", "blue", "alpha"};
    const bool bytes = colours_are_bytes();
    if (bytes) file_.notes.push_back("colours of vertices are whole numbers up to 255");
    for (std::size_t channel = 0; channel < colour_channels_; ++channel) {
      Property colour{names[channel], bytes ? ScalarType::Uint8 : ScalarType::Float32, {}};
      for (std::size_t i = channel; i < colours_.size(); i += colour_channels_)
        colour.values.push_back(colours_[i]);
      file_.vertex_properties.push_back(std::move(colour));
    }
  }

  /// Rows of `values`, `Width` numbers each, as the corners of the triangles name them.
  template <int Width>
  auto gather(const Triangulation& triangulation, CornerIndices& indices,
              const std::vector<double>& values, const char* what) {
    using Table = RowTable<double, Width>;
    indices.values.resize(polygons_.corners.size(), no_index);
    const long missing = std::count(indices.values.begin(), indices.values.end(), no_index);
    if (missing > 0)
      file_.notes.push_back(std::to_string(missing) + " corners have no " + what + ": set to zero");
    Table table(3 * triangulation.triangles.rows(), Width);
    for (Eigen::Index i = 0; i < table.rows(); ++i) {
      const int index = indices.values[triangulation.corner_of(i)];
      for (int k = 0; k < Width; ++k)
        table(i, k) = index == no_index ? 0 : values[static_cast<std::size_t>(Width) * index + k];
    }
    return table;
  }

  void add_texcoords(const Triangulation& triangulation) {
    if (corner_texcoords_.used())
      file_.corner_texcoords =
          gather<2>(triangulation, corner_texcoords_, texcoord_values_, "texture coordinates");
  }

  void add_normals(const Triangulation& triangulation) {
    if (!corner_normals_.used()) return;
    if (const std::optional<std::vector<int>> normal_of = one_normal_a_vertex())
      return add_vertex_normals(*normal_of);
    file_.corner_normals = gather<3>(triangulation, corner_normals_, normal_values_, "normals");
  }

  /// For each vertex the normal that all its corners name, by value; nothing if two differ.
  std::optional<std::vector<int>> one_normal_a_vertex() const {
    std::vector<int> normal_of(static_cast<std::size_t>(vertices_.count), no_index);
    const auto same = [this](int a, int b) {
      const double* const values = normal_values_.data();
      return a == b || std::equal(values + 3L * a, values + 3L * a + 3, values + 3L * b);
    };
    for (std::size_t i = 0; i < corner_normals_.values.size(); ++i) {
      const int normal = corner_normals_.values[i];
      int& known = normal_of[polygons_.corners[i]];
      if (normal == no_index) continue;
      if (known == no_index) known = normal;
      if (!same(known, normal)) return std::nullopt;
    }
    return normal_of;
  }

  void add_vertex_normals(const std::vector<int>& normal_of) {
    note_missing_normals(normal_of);
    const char* const names[] = {"nx", "ny", "nz"};
    for (int axis = 0; axis < 3; ++axis) {
      Property property{names[axis], ScalarType::Float64, {}};
      property.values.reserve(normal_of.size());
      for (const int normal : normal_of)
        property.values.push_back(normal == no_index ? 0 : normal_values_[3L * normal + axis]);
      file_.vertex_properties.push_back(std::move(property));
    }
  }

  /// A vertex of no face needs none.
  void note_missing_normals(const std::vector<int>& normal_of) {
    std::vector<char> lacks_one(normal_of.size(), 0);
    for (const Vertex v : polygons_.corners)
      lacks_one[static_cast<std::size_t>(v)] = normal_of[static_cast<std::size_t>(v)] == no_index;
    const long missing = std::count(lacks_one.begin(), lacks_one.end(), 1);
    if (missing > 0)
      file_.notes.push_back(std::to_string(missing) +
                            (missing == 1 ? " vertex has no normal: set to zero"
                                          : " vertices have no normals: set to zero"));
  }

  void add_notes() {
    add_libraries();
    others_.tell_groups(file_.notes);
    others_.tell_left_out(file_.notes);
    if (depths_) add_loss(file_.notes, "third texture coordinates");
    if (later_comments_ > most_later_comments)
      add_loss(file_.notes, counted(later_comments_ - most_later_comments, "comment") +
                                " behind the first " + std::to_string(most_later_comments));
    if (weights_) add_loss(file_.notes, "fourth coordinates of vertices (weights)");
    others_.tell_unknown(file_.notes);
  }

  /// Base colours from the libraries; what is not carried of them, or why they are not read.
  void add_libraries() {
    const std::vector<std::string>& libraries = others_.libraries();
    if (folder_) file_.companions = library_files(libraries, *folder_);
    if (libraries.empty() || file_.materials.empty()) return;
    const std::string materials = counted(static_cast<long>(file_.materials.size()), "material");
    ObjMaterials read;
    if (folder_) read = read_obj_materials(file_.materials, libraries, *folder_, options_);
    file_.base_colours = std::move(read.base_colours);
    file_.channels = std::move(read.channels);
    for (std::size_t m = 0; m < file_.base_colours.size(); ++m)
      if (const std::string& image = file_.base_colours[m].image; !image.empty())
        note_texture(file_, file_.materials[m], image, read.diffuse[m]);
    const std::vector<std::string> unread =
        read.problems.empty() ? quoted_all(libraries) : read.problems;
    if (file_.base_colours.empty())
      add_loss(file_.notes, "colours and textures of " + materials + " in " + enumerated(unread) +
                                ", which is not read; their names are kept");
    else if (!read.problems.empty())
      add_loss(file_.notes, "materials in " + enumerated(unread));
    if (!read.unknown.empty())
      add_loss(file_.notes, "what no library has: materials " +
                                enumerated(quoted_all(read.unknown)) + " are white");
    note_taken_names(file_, read.taken);
    if (read.with_others > 0)
      add_loss(file_.notes, enumerated(read.others) + " of " + std::to_string(read.with_others) +
                                " of " + materials);
  }

  static std::vector<std::string> quoted_all(const std::vector<std::string>& names) {
    std::vector<std::string> all;
    for (const std::string& name : names) all.push_back(sphparam::quoted(name));
    return all;
  }

  static constexpr long most_later_comments = 1000;
  static constexpr std::int64_t most_vertices = std::numeric_limits<int>::max();

  TextScanner scanner_;
  const std::optional<std::filesystem::path>& folder_;  // of libraries
  const ReadOptions& options_;
  bool is_of_fortran_ = false;  // exponents are, as of tables of bodies
  bool in_header_ = true;       // only comments so far
  long later_comments_ = 0;
  std::optional<bool> null_is_none_;  // of "(null)", once it was met

  IndexedKind vertices_{"vertex", 0, {}}, texcoords_{"texture coordinate", 0, {}},
      normals_{"normal", 0, {}};
  std::vector<double> positions_, texcoord_values_, normal_values_;
  std::vector<float> colours_;
  std::size_t colour_channels_ = 0;
  std::int64_t coloured_ = 0;              // vertices with that many channels
  bool weights_ = false, depths_ = false;  // beyond x y z and s t

  Polygons polygons_;
  long first_zero_line_ = 0;  // of a face that names vertex 0; 0: none does
  bool counts_from_the_end_ = false;
  CornerIndices corner_texcoords_, corner_normals_;
  int material_ = no_index;
  std::vector<int> material_of_;  // per polygon, from the first one with a material
  std::map<std::string, int> material_ids_;
  ObjOtherStatements others_;

  MeshFile file_;
};

}  // namespace

bool looks_like_obj(std::string_view bytes) {
  static constexpr std::string_view statements[] = {"v", "vn", "vt",     "f",     "g",
                                                    "o", "s",  "mtllib", "usemtl"};
  constexpr std::string_view blanks = " \t\r\n";
  for (;;) {
    const std::size_t start = bytes.find_first_not_of(blanks);
    if (start == std::string_view::npos) return false;
    bytes.remove_prefix(start);
    if (bytes.front() != '#' && bytes.front() != '$') break;  // some exporters sign by $
    bytes.remove_prefix(std::min(bytes.find_first_of("\r\n"), bytes.size()));
  }
  const std::string_view word = bytes.substr(0, bytes.find_first_of(blanks));
  return std::find(std::begin(statements), std::end(statements), word) != std::end(statements);
}

MeshFile read_obj(std::string_view text, const std::string& name,
                  const std::optional<std::filesystem::path>& folder, const ReadOptions& options) {
  return ObjReader(text, name, folder, options).read();
}

}  // namespace sphparam
