#include "io/formats/ply/ply_reader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "io/attributes/other_colours.h"
#include "io/attributes/texture_pages.h"
#include "io/files/non_finite_advice.h"
#include "io/files/text_scanner.h"
#include "io/formats/ply/ply_header.h"
#include "number_text.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/polygons.h"

// A body gives numbers one by one: from a text, one record a line, or from bytes in either order.
// The elements are read from it in the order of the header by one piece of code for all encodings.

namespace sphparam {
namespace {

/// Where the body is, for messages.
struct Record {
  const PlyElement* element = nullptr;
  std::int64_t index = 0;

  std::string describe() const {
    return element->name + " " + std::to_string(index) + " of " + std::to_string(element->count) +
           " (counted from 0)";
  }
};

class TextBody {
 public:
  TextBody(std::string_view bytes, const PlyHeader& header, const std::string& name,
           const ReadOptions& options)
      : scanner_(bytes.substr(header.body_offset), name, options, header.body_line) {
    scanner_.require_text();
  }

  void begin(const Record& record) {
    if (!scanner_.next_filled_line()) scanner_.fail("the file ends before " + record.describe());
  }

  void end() {
    if (!scanner_.at_line_end())
      scanner_.fail("unexpected " + sphparam::quoted(scanner_.peek_word()) +
                    " at the end of the line");
  }

  double coordinate(ScalarType type) {
    if (type == ScalarType::Float64) return scanner_.coordinate();
    if (type == ScalarType::Float32) return static_cast<double>(scanner_.coordinate32());
    return real(type);
  }

  double real(ScalarType type) {
    if (type == ScalarType::Float64) return scanner_.real();
    if (type == ScalarType::Float32) return static_cast<double>(scanner_.real32());
    return static_cast<double>(integer(type));
  }

  double any_real(ScalarType type) {
    if (type == ScalarType::Float64) return scanner_.any_real();
    if (type == ScalarType::Float32) return static_cast<double>(scanner_.any_real32());
    return static_cast<double>(integer(type));
  }

  std::int64_t integer(ScalarType type) {
    const std::int64_t value = scanner_.integer();
    if (!holds_exactly(type, static_cast<double>(value)))
      fail(std::to_string(value) + " is no number of type " + std::string(ply_name(type)));
    return value;
  }

  // One byte a number at least is still to come: the length needs no check of its own.
  void skip(ScalarType type, std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i) any_real(type);
  }

  bool has_trailing_data() { return scanner_.next_filled_line(); }
  [[noreturn]] void fail(const std::string& message) const { scanner_.fail(message); }

 private:
  TextScanner scanner_;
};

template <std::endian Order>
class BinaryBody {
 public:
  BinaryBody(std::string_view bytes, const PlyHeader& header, const std::string& name,
             const ReadOptions& options)
      : bytes_(bytes), name_(name), options_(options), offset_(header.body_offset) {}

  void begin(const Record& record) { record_ = record; }
  void end() {}

  double coordinate(ScalarType type) {
    return with_scalar(type, [this](auto scalar) {
      const double value = static_cast<double>(this->template read<decltype(scalar)>());
      if (!std::isfinite(value) && !options_.non_finite) fail_not_finite(non_finite_advice());
      return value;
    });
  }

  double real(ScalarType type) {
    return with_scalar(type, [this](auto scalar) {
      const double value = static_cast<double>(this->template read<decltype(scalar)>());
      if (!std::isfinite(value)) fail_not_finite();
      return value;
    });
  }

  double any_real(ScalarType type) {
    return with_scalar(type, [this](auto scalar) {
      return static_cast<double>(this->template read<decltype(scalar)>());
    });
  }

  std::int64_t integer(ScalarType type) {
    return with_scalar(type, [this](auto scalar) {
      return static_cast<std::int64_t>(this->template read<decltype(scalar)>());
    });
  }

  void skip(ScalarType type, std::int64_t count) {
    const std::size_t size = size_in_bytes(type);
    require(static_cast<std::uint64_t>(count) <= (bytes_.size() - offset_) / size);
    offset_ += static_cast<std::size_t>(count) * size;
  }

  bool has_trailing_data() const { return offset_ < bytes_.size(); }
  [[noreturn]] void fail(const std::string& message) const {
    throw ReadError::at_byte(name_, offset_, message);
  }

 private:
  [[noreturn]] void fail_not_finite(const std::string& advice = "") const {
    fail("number is not finite in " + record_.describe() + advice);
  }

  void require(bool bytes_are_there) const {
    if (!bytes_are_there) [[unlikely]]
      fail("the file ends within " + record_.describe());
  }

  template <class T>
  T read() {
    require(sizeof(T) <= bytes_.size() - offset_);
    char raw[sizeof(T)];
    std::memcpy(raw, bytes_.data() + offset_, sizeof(T));
    if constexpr (Order != std::endian::native) std::reverse(raw, raw + sizeof(T));
    offset_ += sizeof(T);
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }

  std::string_view bytes_;
  const std::string& name_;
  const ReadOptions& options_;
  std::size_t offset_;
  Record record_;
};

/// Corner attributes as the polygons' corners have them: `width` numbers each.
struct CornerList {
  int width;
  const char* what;
  std::vector<double> values;
  ScalarType type = ScalarType::Float64;
  long missing = 0;  // polygons with an empty list

  /// The numbers of the triangles' corners.
  template <class Table>
  Table gather(const Triangulation& triangulation) const {
    Table table(3 * triangulation.triangles.rows(), width);
    for (Eigen::Index i = 0; i < table.rows(); ++i)
      for (int k = 0; k < width; ++k)
        table(i, k) = values[static_cast<std::size_t>(width * triangulation.corner_of(i) + k)];
    return table;
  }
};

/// The properties that are one thing with this one, itself among them.
std::vector<std::string> components_beside(const std::string& name) {
  static const std::vector<std::vector<std::string>> vectors = {{"nx", "ny", "nz"},
                                                                {"red", "green", "blue", "alpha"},
                                                                {"s", "t"},
                                                                {"u", "v"},
                                                                {"texture_u", "texture_v"}};
  const auto is_component = [&](const auto& names) { return std::ranges::count(names, name) > 0; };
  const auto found = std::ranges::find_if(vectors, is_component);
  return found == vectors.end() ? std::vector{name} : *found;
}

template <class Body>
class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& name, const ReadOptions& options,
            PlyHeader header)
      : header_(std::move(header)),
        body_(bytes, header_, name, options),
        name_(name),
        options_(options) {}

  MeshFile read() {
    check_header();
    for (const PlyElement& element : header_.elements) {
      if (&element == vertex_element_)
        read_vertices(element);
      else if (&element == face_element_)
        read_faces(element);
      else if (&element == strip_element_)
        read_strips(element);
      else
        skip_element(element);
    }
    if (body_.has_trailing_data()) file_.notes.push_back("data after the last element ignored");
    return finish();
  }

 private:
  // --- What the header must say ---

  void check_header() {
    const long last_line = header_.body_line - 1;
    vertex_element_ = header_.find("vertex");
    face_element_ = header_.find("face");
    if (!vertex_element_) fail_at(last_line, "the header has no element vertex");
    check_count(*vertex_element_, options_.max_vertices);
    for (const char* axis : {"x", "y", "z"}) {
      const PlyProperty* const property = vertex_element_->find(axis);
      if (!property)
        fail_at(vertex_element_->line, std::string("vertices have no property ") + axis);
      if (property->is_list)
        fail_at(vertex_element_->line, std::string("vertex property ") + axis + " is a list");
    }
    // Strips stand in for faces: of a file with both, the faces are the mesh.
    strip_element_ =
        face_element_ && face_element_->count > 0 ? nullptr : header_.find("tristrips");
    if (strip_element_) face_element_ = nullptr;
    if (face_element_) check_corner_lists(*face_element_, "face");
    if (strip_element_) check_corner_lists(*strip_element_, "strip");
  }

  void check_corner_lists(const PlyElement& element, const std::string& what) {
    check_count(element, options_.max_faces);
    const PlyProperty* const indices = element.find("vertex_indices");
    const PlyProperty* const index = element.find("vertex_index");
    if (indices && index) fail_at(element.line, what + "s have two lists of vertices");
    index_property_ = indices ? indices : index;
    if (!index_property_) fail_at(element.line, what + "s have no list vertex_indices");
    if (!index_property_->is_list)
      fail_at(element.line, what + " property " + index_property_->name + " is no list");
    if (is_floating(index_property_->type))
      fail_at(element.line, "vertex indices of a floating-point type");
  }

  void check_count(const PlyElement& element, std::int64_t limit) const {
    constexpr std::int64_t hard_limit = std::numeric_limits<int>::max() / 3;  // ids are ints
    if (element.count > std::min(limit, hard_limit))
      fail_at(element.line, std::to_string(element.count) + " records of element " +
                                sphparam::quoted(element.name) + " are over the limit of " +
                                std::to_string(std::min(limit, hard_limit)));
  }

  // --- Vertices ---

  void read_vertices(const PlyElement& element) {
    Points& positions = file_.mesh.positions;
    positions.resize(element.count, 3);
    file_.vertex_properties = columns(element, {"x", "y", "z"});
    file_.position_type = position_type(element);
    if (element.count == 0) return;
    std::vector<Target> targets;
    for (std::size_t i = 0, column = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      const std::size_t axis = std::string_view("xyz").find(property.name);
      if (property.is_list || !is_wanted(element, property))
        targets.push_back({nullptr, 0});
      else if (property.name.size() == 1 && axis != std::string_view::npos)
        targets.push_back({positions.data() + axis, 3, true});
      else
        targets.push_back({file_.vertex_properties[column++].values.data(), 1});
    }
    for (std::int64_t v = 0; v < element.count; ++v) {
      body_.begin({&element, v});
      read_record(element, targets, v);
      body_.end();
    }
    leave_out_non_finite(file_.vertex_properties, element);
  }

  static ScalarType position_type(const PlyElement& element) {
    for (const char* axis : {"x", "y", "z"}) {
      const ScalarType type = element.find(axis)->type;
      if (!is_floating(type) || type == ScalarType::Float64) return ScalarType::Float64;
    }
    return ScalarType::Float32;
  }

  /// With `only_map` no face property is kept, and of a vertex the ray and the position.
  bool is_wanted(const PlyElement& element, const PlyProperty& property) const {
    static constexpr std::array<std::string_view, 6> of_map = {"x", "y", "z", "sx", "sy", "sz"};
    if (!options_.only_map) return true;
    return &element == vertex_element_ &&
           std::find(of_map.begin(), of_map.end(), property.name) != of_map.end();
  }

  void skip(const PlyProperty& property) {
    body_.skip(property.type, property.is_list ? list_length(property) : 1);
  }

  /// Where the value of a property goes: entry v of a strided array; nowhere for lists.
  struct Target {
    double* first;
    std::int64_t stride;
    bool is_coordinate = false;
  };

  void read_record(const PlyElement& element, const std::vector<Target>& targets, std::int64_t i) {
    for (std::size_t p = 0; p < targets.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (!targets[p].first)
        skip(property);
      else
        targets[p].first[i * targets[p].stride] = targets[p].is_coordinate
                                                      ? body_.coordinate(property.type)
                                                      : body_.any_real(property.type);
    }
  }

  /// One empty column for each scalar property that is not named in `handled`; lists are noted.
  std::vector<Property> columns(const PlyElement& element,
                                std::initializer_list<std::string_view> handled) {
    std::vector<Property> result;
    for (const PlyProperty& property : element.properties) {
      if (std::find(handled.begin(), handled.end(), property.name) != handled.end()) continue;
      if (!is_wanted(element, property)) continue;
      if (property.is_list)
        add_loss(file_.notes, "list " + sphparam::quoted(property.name) + " of element " +
                                  sphparam::quoted(element.name));
      else
        result.push_back({property.name, property.type,
                          std::vector<double>(static_cast<std::size_t>(element.count))});
    }
    return result;
  }

  static std::ptrdiff_t count_non_finite(const Property& property) {
    if (!is_floating(property.type)) return 0;
    const auto is_finite = [](double value) { return std::isfinite(value); };
    return std::ssize(property.values) - std::ranges::count_if(property.values, is_finite);
  }

  /// Programs say so of vertices and faces that have none. A map that lacks a ray is no map, and
  /// must not be taken for a mesh without one; a vector that lacks a component is none either.
  void leave_out_non_finite(std::vector<Property>& properties, const PlyElement& element) {
    static constexpr std::array<std::string_view, 3> of_rays = {"sx", "sy", "sz"};
    std::set<std::string> left_out;
    for (const Property& property : properties) {
      const auto missing = count_non_finite(property);
      if (missing == 0) continue;
      const std::string what = "property " + sphparam::quoted(property.name) + " of element " +
                               sphparam::quoted(element.name) + ": it has " +
                               counted(missing, "value that is", "values that are") + " not finite";
      if (&element == vertex_element_ && std::ranges::count(of_rays, property.name) > 0)
        throw ReadError(name_, what);
      const std::vector<std::string> together = components_beside(property.name);
      add_loss(file_.notes,
               what + (together.size() > 1 ? "; " + joined(together) + " go together" : ""));
      left_out.insert(together.begin(), together.end());
    }
    std::erase_if(properties,
                  [&](const Property& property) { return left_out.contains(property.name); });
  }

  // --- Faces ---

  void read_faces(const PlyElement& element) {
    polygons_.corners.reserve(static_cast<std::size_t>(3 * element.count));
    polygons_.starts.reserve(static_cast<std::size_t>(element.count + 1));
    const auto is_list = [&](const char* name) {
      const PlyProperty* const property = element.find(name);
      return property && property->is_list && is_wanted(element, *property);
    };
    has_texcoords_ = is_list("texcoord");
    has_normals_ = is_list("normal");
    file_.face_properties = columns(
        element,
        {index_property_->name, has_texcoords_ ? "texcoord" : "", has_normals_ ? "normal" : ""});
    for (std::int64_t f = 0; f < element.count; ++f) {
      body_.begin({&element, f});
      read_face(element, f);
      body_.end();
    }
    leave_out_non_finite(file_.face_properties, element);
  }

  void read_face(const PlyElement& element, std::int64_t f) {
    std::size_t column = 0;
    for (const PlyProperty& property : element.properties) {
      if (&property == index_property_)
        read_corners(property);
      else if (has_texcoords_ && property.name == "texcoord")
        read_list(property, texcoords_);
      else if (has_normals_ && property.name == "normal")
        read_list(property, normals_);
      else if (property.is_list || !is_wanted(element, property))
        skip(property);
      else
        file_.face_properties[column++].values[static_cast<std::size_t>(f)] =
            body_.any_real(property.type);
    }
    if (has_texcoords_) complete_list(texcoords_);
    if (has_normals_) complete_list(normals_);
  }

  std::int64_t list_length(const PlyProperty& property) {
    const std::int64_t length = body_.integer(property.count_type);
    if (length < 0) body_.fail("negative length of list " + sphparam::quoted(property.name));
    return length;
  }

  void read_corners(const PlyProperty& property) {
    const std::int64_t degree = list_length(property);
    if (degree > options_.max_polygon_degree)
      body_.fail("face has more corners than the limit of " +
                 std::to_string(options_.max_polygon_degree));
    for (std::int64_t i = 0; i < degree; ++i)
      polygons_.add_corner(checked_vertex(body_.integer(property.type), "face"));
    close_polygon();
  }

  int checked_vertex(std::int64_t v, const char* what) const {
    if (v < 0 || v >= vertex_element_->count)
      body_.fail(std::string(what) + " names vertex " + std::to_string(v) + " of " +
                 std::to_string(vertex_element_->count) + " (counted from 0)");
    return static_cast<int>(v);
  }

  void close_polygon() {
    const std::string problem = polygons_.close_polygon(options_);
    if (!problem.empty()) body_.fail(problem);
  }

  void read_list(const PlyProperty& property, CornerList& list) {
    list.type = property.type;
    const std::int64_t length = list_length(property);
    if (length > list.width * options_.max_polygon_degree)
      body_.fail("list " + sphparam::quoted(property.name) + " is longer than any face's may be");
    for (std::int64_t i = 0; i < length; ++i) list.values.push_back(body_.real(property.type));
  }

  // The list may stand before the indices, so it is judged at the end of the record.
  void complete_list(CornerList& list) {
    const std::size_t expected = static_cast<std::size_t>(list.width) * polygons_.corners.size();
    const std::size_t degree = static_cast<std::size_t>(polygons_.degree(polygons_.count() - 1));
    const std::size_t before = expected - static_cast<std::size_t>(list.width) * degree;
    if (list.values.size() == before && before != expected) {
      ++list.missing;
      list.values.resize(expected);
    }
    if (list.values.size() != expected)
      body_.fail("face of " + std::to_string(degree) + " corners has " +
                 std::to_string(list.values.size() - before) + " numbers of " + list.what);
  }

  // --- Triangle strips ---

  void read_strips(const PlyElement& element) {
    for (const PlyProperty& property : element.properties)
      if (&property != index_property_)
        add_loss(file_.notes,
                 "property " + sphparam::quoted(property.name) + " of triangle strips");
    for (std::int64_t s = 0; s < element.count; ++s) {
      body_.begin({&element, s});
      for (const PlyProperty& property : element.properties)
        &property == index_property_ ? read_strip(property) : skip(property);
      body_.end();
    }
    if (turns_ > 0)
      file_.notes.push_back(
          std::to_string(turns_) +
          " triangles of strips name a vertex twice: left out, as strips turn so");
  }

  // Each index makes a triangle with the two before it, every other one turned over; −1 starts
  // anew. A list may hold the whole mesh: no limit on corners counts here, that on faces does.
  void read_strip(const PlyProperty& property) {
    constexpr std::int64_t restart = -1;
    const std::int64_t unsigned_restart = std::numeric_limits<std::uint32_t>::max();
    std::array<int, 2> before{};
    std::int64_t in_strip = 0;
    const std::int64_t length = list_length(property);
    for (std::int64_t i = 0; i < length; ++i) {
      const std::int64_t index = body_.integer(property.type);
      if (index == restart || index == unsigned_restart) {
        in_strip = 0;
        continue;
      }
      const int v = checked_vertex(index, "strip");
      if (++in_strip > 2) add_strip_triangle(before[0], before[1], v, in_strip % 2 == 0);
      before = {before[1], v};
    }
  }

  void add_strip_triangle(int a, int b, int c, bool turned) {
    if (a == b || b == c || c == a) {
      ++turns_;
      return;
    }
    for (const int v : {turned ? b : a, turned ? a : b, c}) polygons_.add_corner(v);
    close_polygon();
  }

  // --- The rest ---

  void skip_element(const PlyElement& element) {
    if (element.count == 0) return;
    add_loss(file_.notes, counted(static_cast<long>(element.count), "record") + " of element " +
                              sphparam::quoted(element.name));
    for (std::int64_t i = 0; i < element.count; ++i) {
      body_.begin({&element, i});
      for (const PlyProperty& property : element.properties) skip(property);
      body_.end();
    }
  }

  MeshFile finish() {
    Triangulation triangulation = triangulate(file_.mesh.positions, polygons_);
    if (has_texcoords_) {
      file_.corner_texcoords = texcoords_.gather<CornerTexcoords>(triangulation);
      file_.corner_texcoord_type = texcoords_.type;
      note_missing(texcoords_);
    }
    if (has_normals_) {
      file_.corner_normals = normals_.gather<CornerNormals>(triangulation);
      file_.corner_normal_type = normals_.type;
      note_missing(normals_);
    }
    adopt_triangulation(file_, std::move(triangulation));
    add_comments();
    take_other_colours(file_);
    return std::move(file_);
  }

  void note_missing(const CornerList& list) {
    if (list.missing > 0)
      file_.notes.push_back(std::to_string(list.missing) + " faces have no " + list.what +
                            ": set to zero");
  }

  void add_comments() {
    for (const std::string& written : header_.comments) {
      std::string comment = one_line(written);
      if (comment.starts_with(material_comment))
        file_.materials.push_back(comment.substr(material_comment.size()));
      else
        file_.comments.push_back(std::move(comment));
    }
    if (header_.infos > 0)
      file_.notes.push_back(counted(header_.infos, "obj_info line is", "obj_info lines are") +
                            " kept as " + (header_.infos == 1 ? "a comment" : "comments"));
  }

  [[noreturn]] void fail_at(long line, const std::string& message) const {
    throw ReadError::at_line(name_, line, message);
  }

  PlyHeader header_;
  Body body_;
  const std::string& name_;
  const ReadOptions& options_;
  const PlyElement* vertex_element_ = nullptr;
  const PlyElement* face_element_ = nullptr;
  const PlyElement* strip_element_ = nullptr;
  const PlyProperty* index_property_ = nullptr;  // of faces, or of the strips in their stead
  long turns_ = 0;                               // triangles of strips that name a vertex twice

  Polygons polygons_;
  bool has_texcoords_ = false, has_normals_ = false;
  CornerList texcoords_{2, "texture coordinates", {}, ScalarType::Float64, 0};
  CornerList normals_{3, "normals", {}, ScalarType::Float64, 0};

  MeshFile file_;
};

template <class Body>
MeshFile read_body(std::string_view bytes, const std::string& name, const ReadOptions& options,
                   PlyHeader header, const char* format) {
  MeshFile file = PlyReader<Body>(bytes, name, options, std::move(header)).read();
  file.format = format;
  return file;
}

MeshFile read_in_encoding(std::string_view bytes, const std::string& name,
                          const ReadOptions& options) {
  if (!looks_like_ply(bytes)) throw ReadError::at_line(name, 1, "expected the magic word 'ply'");
  PlyHeader header = parse_ply_header(bytes, name, options);
  switch (header.encoding) {
    case PlyEncoding::Ascii:
      return read_body<TextBody>(bytes, name, options, std::move(header), "PLY ASCII");
    case PlyEncoding::BinaryLittleEndian:
      return read_body<BinaryBody<std::endian::little>>(bytes, name, options, std::move(header),
                                                        "PLY binary little-endian");
    case PlyEncoding::BinaryBigEndian:
      break;
  }
  return read_body<BinaryBody<std::endian::big>>(bytes, name, options, std::move(header),
                                                 "PLY binary big-endian");
}

}  // namespace

bool looks_like_ply(std::string_view bytes) {
  return bytes.starts_with("ply") &&
         (bytes.size() == 3 || std::isspace(static_cast<unsigned char>(bytes[3])));
}

MeshFile read_ply(std::string_view bytes, const std::string& name,
                  const std::optional<std::filesystem::path>& folder, const ReadOptions& options) {
  MeshFile file = read_in_encoding(bytes, name, options);
  if (!options.only_map) take_texture_pages(file, folder);
  return file;
}

}  // namespace sphparam
