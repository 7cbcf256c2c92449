#include "io/formats/ply/ply_reader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <optional>
#include <utility>

#include "io/attributes/other_colours.h"
#include "io/attributes/texture_pages.h"
#include "io/files/float32_digits.h"
#include "io/formats/ply/missing_values.h"
#include "io/formats/ply/ply_body.h"
#include "io/formats/ply/ply_layout.h"
#include "number_text.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/polygons.h"

// The layout says which elements are the mesh. All elements are read in the order of the header, by
// one piece of code for the bodies of all encodings.

namespace sphparam {
namespace {

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

template <class Body>
class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& name, const ReadOptions& options,
            PlyHeader header)
      : header_(std::move(header)),
        body_(bytes, header_, name, options),
        layout_(find_layout(header_, name, options)),
        name_(name),
        options_(options) {}

  MeshFile read() {
    for (const PlyElement& element : header_.elements) {
      if (&element == layout_.vertices)
        read_vertices(element);
      else if (&element == layout_.faces)
        read_faces(element);
      else if (&element == layout_.strips)
        read_strips(element);
      else
        skip_element(element);
    }
    if (body_.has_trailing_data()) file_.notes.push_back("data after the last element ignored");
    return finish();
  }

 private:
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
    settle_digits(element);
    leave_out_non_finite(file_.vertex_properties, true, name_, file_.notes);
  }

  /// Texts that say more than the float32 that the header declares are kept as they are; else each
  /// number is the float32 that was printed.
  void settle_digits(const PlyElement& element) {
    if (body_.exceeds_float32()) {
      file_.position_type = ScalarType::Float64;
      return;
    }
    constexpr std::string_view axes = "xyz";
    for (std::size_t axis = 0; axis < axes.size(); ++axis)
      if (element.find(axes.substr(axis, 1))->type == ScalarType::Float32)
        for (double& value : file_.mesh.positions.col(static_cast<Eigen::Index>(axis)))
          value = rounded_to_float32(value);
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
    return &element == layout_.vertices &&
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
        {layout_.corners->name, has_texcoords_ ? "texcoord" : "", has_normals_ ? "normal" : ""});
    for (std::int64_t f = 0; f < element.count; ++f) {
      body_.begin({&element, f});
      read_face(element, f);
      body_.end();
    }
    leave_out_non_finite(file_.face_properties, false, name_, file_.notes);
  }

  void read_face(const PlyElement& element, std::int64_t f) {
    std::size_t column = 0;
    for (const PlyProperty& property : element.properties) {
      if (&property == layout_.corners)
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
    if (v < 0 || v >= layout_.vertices->count)
      body_.fail(std::string(what) + " names vertex " + std::to_string(v) + " of " +
                 std::to_string(layout_.vertices->count) + " (counted from 0)");
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
      if (&property != layout_.corners)
        add_loss(file_.notes,
                 "property " + sphparam::quoted(property.name) + " of triangle strips");
    for (std::int64_t s = 0; s < element.count; ++s) {
      body_.begin({&element, s});
      for (const PlyProperty& property : element.properties)
        &property == layout_.corners ? read_strip(property) : skip(property);
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

  PlyHeader header_;
  Body body_;
  const PlyLayout layout_;
  const std::string& name_;
  const ReadOptions& options_;
  long turns_ = 0;  // triangles of strips that name a vertex twice

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
      return read_body<PlyTextBody>(bytes, name, options, std::move(header), "PLY ASCII");
    case PlyEncoding::BinaryLittleEndian:
      return read_body<PlyBinaryBody<std::endian::little>>(bytes, name, options, std::move(header),
                                                           "PLY binary little-endian");
    case PlyEncoding::BinaryBigEndian:
      break;
  }
  return read_body<PlyBinaryBody<std::endian::big>>(bytes, name, options, std::move(header),
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
