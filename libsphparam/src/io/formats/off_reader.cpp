#include "io/formats/off_reader.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

#include "io/files/text_scanner.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/polygons.h"

// Keyword, counts, then one line a vertex (x y z, normal, colour, texture coordinates, as far as
// the keyword names them) and one line a face (degree, indices, colour). The first vertex line
// decides how many numbers the others have: files exist whose keyword promises more than they hold.

namespace sphparam {
namespace {

/// What a keyword such as STCNOFF promises about every vertex.
struct Keyword {
  bool texcoords = false, colours = false, normals = false;
  bool four_dimensional = false, any_dimension = false;
};

std::optional<Keyword> parse_keyword(std::string_view word) {
  Keyword keyword;
  const auto skip = [&word](std::string_view prefix) {
    const bool there = word.starts_with(prefix);
    if (there) word.remove_prefix(prefix.size());
    return there;
  };
  keyword.texcoords = skip("ST");
  keyword.colours = skip("C");
  keyword.normals = skip("N");
  keyword.four_dimensional = skip("4");
  keyword.any_dimension = skip("n");
  if (word != "OFF") return std::nullopt;
  return keyword;
}

/// Columns of numbers, a name each; all values of one line after those of another.
struct Columns {
  std::vector<const char*> names;
  std::vector<double> values;
  bool whole_bytes = true;  // every value was written as a whole number from 0 to 255

  std::size_t width() const { return names.size(); }

  void append_to(std::vector<Property>& properties, ScalarType type) const {
    for (std::size_t column = 0; column < width(); ++column) {
      Property property{names[column], type, {}};
      property.values.reserve(values.size() / width());
      for (std::size_t i = column; i < values.size(); i += width())
        property.values.push_back(values[i]);
      properties.push_back(std::move(property));
    }
  }
};

ScalarType colour_type(const Columns& colours) {
  return colours.whole_bytes ? ScalarType::Uint8 : ScalarType::Float32;
}

class OffReader {
 public:
  OffReader(std::string_view text, const std::string& name, const ReadOptions& options)
      : scanner_(text, name, options), options_(options) {}

  MeshFile read() {
    read_header();
    read_vertices();
    read_faces();
    if (next_line_past_comments()) file_.notes.push_back("data after the last face ignored");
    return finish();
  }

 private:
  void read_header() {
    if (!next_line_past_comments()) scanner_.fail("the file holds no OFF keyword");
    file_.format = scanner_.word();
    const std::optional<Keyword> keyword = parse_keyword(file_.format);
    if (!keyword) scanner_.fail("expected the keyword OFF, found " + quoted(file_.format));
    if (keyword->four_dimensional || keyword->any_dimension)
      scanner_.fail(file_.format + " files (not three-dimensional) are not supported");
    if (scanner_.peek_word() == "BINARY") scanner_.fail("binary OFF files are not supported");
    keyword_ = *keyword;
    scanner_.require_text();
    if (scanner_.at_line_end() && !next_line_past_comments())
      scanner_.fail("the file ends before the counts of vertices and faces");
    vertex_count_ = read_count("vertices", options_.max_vertices);
    face_count_ = read_count("faces", options_.max_faces);
    if (!scanner_.at_line_end() && scanner_.integer() < 0) scanner_.fail("negative edge count");
    expect_line_end();
    check_proportions();
  }

  /// In front of the counts and after the last face, where comments are kept.
  bool next_line_past_comments() {
    while (scanner_.next_line()) {
      if (!scanner_.at_line_end()) return true;
      if (scanner_.at_comment()) file_.comments.push_back(one_line(scanner_.comment()));
    }
    return false;
  }

  std::int64_t read_count(const char* what, std::int64_t limit) {
    constexpr std::int64_t hard_limit = std::numeric_limits<int>::max() / 3;  // ids are ints
    const long count = scanner_.integer();
    if (count < 0) scanner_.fail(std::string("negative number of ") + what);
    if (count > std::min(limit, hard_limit))
      scanner_.fail(std::to_string(count) + " " + what + " are over the limit of " +
                    std::to_string(std::min(limit, hard_limit)));
    return count;
  }

  // A number in text takes two bytes with its separator, which the last one may lack. Before any
  // memory is set aside, the counts must fit the bytes there are.
  void check_proportions() {
    constexpr std::uint64_t vertex_bytes = 3 * 2, face_bytes = 4 * 2;
    const std::uint64_t least = vertex_bytes * static_cast<std::uint64_t>(vertex_count_) +
                                face_bytes * static_cast<std::uint64_t>(face_count_);
    if (least > scanner_.remaining_bytes() + 1)
      scanner_.fail(std::to_string(vertex_count_) + " vertices and " + std::to_string(face_count_) +
                    " faces do not fit the " + std::to_string(scanner_.remaining_bytes()) +
                    " bytes that follow");
  }

  void next_record(const char* what, std::int64_t i, std::int64_t count) {
    if (scanner_.next_filled_line()) return;
    scanner_.fail("the file ends before " + std::string(what) + " " + std::to_string(i + 1) +
                  " of " + std::to_string(count));
  }

  void expect_line_end() {
    if (!scanner_.at_line_end())
      scanner_.fail("unexpected " + quoted(scanner_.peek_word()) + " at the end of the line");
  }

  void read_vertices() {
    file_.mesh.positions.resize(vertex_count_, 3);
    std::vector<double> extras;
    std::size_t width = 0;
    for (std::int64_t v = 0; v < vertex_count_; ++v) {
      next_record("vertex", v, vertex_count_);
      for (int axis = 0; axis < 3; ++axis) file_.mesh.positions(v, axis) = scanner_.coordinate();
      if (v == 0) {
        width = count_numbers();
        lay_out_columns(width);
      }
      if (width > 0) read_vertex_columns();
      expect_line_end();
    }
  }

  /// Numbers left on the line of the first vertex.
  std::size_t count_numbers() {
    TextScanner copy(scanner_.peek_rest(), scanner_.file(), options_, scanner_.line_number());
    std::size_t count = 0;
    for (copy.next_line(); !copy.at_line_end(); ++count) copy.real();
    return count;
  }

  void lay_out_columns(std::size_t width) {
    const std::size_t normals = keyword_.normals ? 3 : 0;
    const std::size_t texcoords = keyword_.texcoords ? 2 : 0;
    const std::size_t colours = keyword_.colours ? width - normals - texcoords : 0;
    const bool as_promised = normals + texcoords <= width &&
                             normals + colours + texcoords == width &&
                             (!keyword_.colours || colours == 3 || colours == 4);
    if (as_promised) {
      if (normals) normals_.names = {"nx", "ny", "nz"};
      if (colours) colours_.names = {"red", "green", "blue"};
      if (colours == 4) colours_.names.push_back("alpha");
      if (texcoords) texcoords_.names = {"s", "t"};
      return;
    }
    const bool bare_keyword = !keyword_.normals && !keyword_.texcoords && !keyword_.colours;
    if (width > 0 && !bare_keyword)
      scanner_.fail("vertex has " + std::to_string(width) +
                    " numbers after its coordinates, which " + file_.format + " does not explain");
    unexplained_ = width;
    if (width == 0)
      file_.notes.push_back("the keyword is " + file_.format +
                            " but vertices hold coordinates only");
    else
      add_loss(file_.notes,
               std::to_string(width) + " numbers after the coordinates of each vertex");
  }

  void read_vertex_columns() {
    for (std::size_t i = 0; i < normals_.width(); ++i) normals_.values.push_back(scanner_.real());
    for (std::size_t i = 0; i < colours_.width(); ++i) read_colour(colours_);
    for (std::size_t i = 0; i < texcoords_.width(); ++i)
      texcoords_.values.push_back(scanner_.real());
    for (std::size_t i = 0; i < unexplained_; ++i) scanner_.real();
  }

  void read_colour(Columns& colours) {
    const std::string_view word = scanner_.peek_word();
    const bool digits =
        std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
    const float value = scanner_.real32();
    colours.whole_bytes &= digits && value <= 255;
    colours.values.push_back(value);
  }

  void read_faces() {
    polygons_.corners.reserve(static_cast<std::size_t>(3 * face_count_));
    polygons_.starts.reserve(static_cast<std::size_t>(face_count_ + 1));
    for (std::int64_t f = 0; f < face_count_; ++f) {
      next_record("face", f, face_count_);
      read_corners();
      read_face_colour(f);
    }
  }

  void read_corners() {
    const long degree = scanner_.integer();
    if (degree < 3) scanner_.fail("face has fewer than 3 corners");
    if (degree > options_.max_polygon_degree)
      scanner_.fail("face has more corners than the limit of " +
                    std::to_string(options_.max_polygon_degree));
    for (long i = 0; i < degree; ++i) {
      const long v = scanner_.integer();
      if (v < 0 || v >= vertex_count_)
        scanner_.fail("face names vertex " + std::to_string(v) + " of " +
                      std::to_string(vertex_count_) + " (counted from 0)");
      polygons_.add_corner(static_cast<int>(v));
    }
    const std::string problem = polygons_.close_polygon(options_);
    if (!problem.empty()) scanner_.fail(problem);
  }

  // Colours are kept while every face has as many numbers as the first one.
  void read_face_colour(std::int64_t f) {
    std::size_t count = 0;
    for (; !scanner_.at_line_end(); ++count) {
      if (keep_face_numbers_)
        read_colour(face_colours_);
      else
        scanner_.real32();
    }
    if (f == 0) face_number_count_ = count;
    keep_face_numbers_ &= count == face_number_count_ && (count == 3 || count == 4);
    face_numbers_ |= count > 0;
  }

  MeshFile finish() {
    add_face_colours();
    adopt_triangulation(file_, triangulate(file_.mesh.positions, polygons_));
    normals_.append_to(file_.vertex_properties, ScalarType::Float64);
    colours_.append_to(file_.vertex_properties, colour_type(colours_));
    texcoords_.append_to(file_.vertex_properties, ScalarType::Float64);
    return std::move(file_);
  }

  void add_face_colours() {
    if (!face_numbers_) return;
    const auto is_fraction = [](double value) { return value >= 0 && value <= 1; };
    const bool colours =
        keep_face_numbers_ &&
        (face_colours_.whole_bytes ||
         std::all_of(face_colours_.values.begin(), face_colours_.values.end(), is_fraction));
    if (!colours) {
      add_loss(file_.notes, "numbers after the faces: they are not one colour a face");
      return;
    }
    face_colours_.names = {"red", "green", "blue"};
    if (face_number_count_ == 4) face_colours_.names.push_back("alpha");
    face_colours_.append_to(file_.face_properties, colour_type(face_colours_));
  }

  TextScanner scanner_;
  const ReadOptions& options_;
  Keyword keyword_;
  std::int64_t vertex_count_ = 0, face_count_ = 0;

  Columns normals_, colours_, texcoords_, face_colours_;
  std::size_t unexplained_ = 0;  // numbers a vertex that the keyword does not name
  Polygons polygons_;
  std::size_t face_number_count_ = 0;  // of the first face
  bool keep_face_numbers_ = true, face_numbers_ = false;

  MeshFile file_;
};

}  // namespace

bool looks_like_off(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  for (;;) {
    const std::size_t start = text.find_first_not_of(blanks);
    if (start == std::string_view::npos) return false;
    text.remove_prefix(start);
    if (text.front() != '#') break;
    text.remove_prefix(std::min(text.find_first_of("\r\n"), text.size()));
  }
  return parse_keyword(text.substr(0, text.find_first_of(" \t\r\n#"))).has_value();
}

MeshFile read_off(std::string_view text, const std::string& name, const ReadOptions& options) {
  return OffReader(text, name, options).read();
}

}  // namespace sphparam
