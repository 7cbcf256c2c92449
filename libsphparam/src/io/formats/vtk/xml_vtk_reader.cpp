#include "io/formats/vtk/xml_vtk_reader.h"

#include <algorithm>
#include <cmath>

#include "io/formats/vtk/vtk_document.h"
#include "sphparam/io/losses.h"

// The XML is taken apart (vtk_document), arrays are decoded (vtk_data), pieces put together.

namespace sphparam {
namespace {

constexpr std::int64_t as_many_as_there_are = -1;

class XmlVtkReader {
 public:
  XmlVtkReader(const VtkDocument& document, std::size_t file_bytes, const std::string& name,
               const ReadOptions& options)
      : document_(document), decoder_(document, file_bytes, name), name_(name), options_(options) {}

  MeshFile read() {
    if (document_.pieces.empty()) throw ReadError(name_, "holds no <Piece>");
    check_limits();
    for (const VtkXmlArray& array : document_.field_data) read_field(array);
    for (const VtkXmlPiece& piece : document_.pieces) read_piece(piece);
    MeshFile file = as_mesh_file(std::move(surface_), name_, options_);
    file.format = document_.compressed ? "VTK XML, zlib" : "VTK XML";
    return file;
  }

 private:
  void check_limits() const {
    std::int64_t points = 0, cells = 0;
    for (const VtkXmlPiece& piece : document_.pieces) {
      points += piece.points;
      cells += piece.polys + piece.strips;
    }
    if (points > options_.max_vertices)
      throw ReadError(name_, std::to_string(points) + " points are over the limit of " +
                                 std::to_string(options_.max_vertices));
    if (cells > options_.max_faces)
      throw ReadError(name_, std::to_string(cells) + " cells are over the limit of " +
                                 std::to_string(options_.max_faces));
  }

  void read_field(const VtkXmlArray& array) {
    const bool taken = array.type == "String" &&
                       (array.name == "comments" || array.name == "materials") &&
                       take_strings(surface_, array.name, decoder_.strings(array));
    if (!taken) add_loss(surface_.notes, "field data " + quoted(array.name));
  }

  void read_piece(const VtkXmlPiece& piece) {
    const std::int64_t first = surface_.points ? surface_.points->count() : 0;
    read_points(piece);
    const std::int64_t others = piece.verts + piece.lines;
    const std::int64_t faces = surface_.polygons.count();
    if (piece.polys > 0) read_polys(piece, first);
    if (piece.strips > 0) read_strips(piece, first);
    const bool is_first = &piece == &document_.pieces.front();
    read_data(piece.point_data, piece.points, is_first, surface_.point_arrays);
    if (piece.strips > 0) {
      surface_.has_strips = true;
      for (const VtkXmlArray& array : piece.cell_data.arrays) leave(array, "of strips");
    } else {
      const std::int64_t polys = surface_.polygons.count() - faces;
      read_cell_data(piece, others, polys, is_first);
    }
    lost_cells_ += others;
    if (&piece == &document_.pieces.back() && lost_cells_ > 0)
      add_loss(surface_.notes, std::to_string(lost_cells_) + " cells that are points or lines");
  }

  void read_points(const VtkXmlPiece& piece) {
    if (!piece.coordinates && piece.points > 0)
      throw ReadError(name_, "a piece of " + std::to_string(piece.points) + " points has none");
    VtkArray points{.name = "Points", .width = 3};
    if (piece.coordinates) {
      if (piece.coordinates->width != 3)
        fail_in_array(name_, *piece.coordinates, "does not have three coordinates a point");
      points = decoder_.numbers(*piece.coordinates, 3 * piece.points, surface_.notes,
                                TextDigits::AllThatMatter);
    }
    if (!surface_.points) {
      surface_.points = std::move(points);
      return;
    }
    VtkArray& all = *surface_.points;
    all.type = common_type(all.type, points.type);
    all.values.insert(all.values.end(), points.values.begin(), points.values.end());
  }

  // --- Cells ---

  /// Corners of cells and, for each, where its corners end.
  struct Cells {
    std::vector<int> corners;
    std::vector<std::size_t> ends;
  };

  Cells read_cells(const VtkXmlPiece::Cells& arrays, std::int64_t count, std::int64_t points,
                   std::int64_t first, const char* what) {
    if (!arrays.connectivity || !arrays.offsets)
      throw ReadError(name_, std::string("<") + what + "> lacks connectivity or offsets");
    const VtkArray ends = decoder_.numbers(*arrays.offsets, count, surface_.notes);
    const VtkArray corners =
        decoder_.numbers(*arrays.connectivity, as_many_as_there_are, surface_.notes);
    Cells cells;
    for (const double v : corners.values) {
      if (v != std::floor(v) || v < 0 || v >= static_cast<double>(points))
        fail_in_array(name_, *arrays.connectivity,
                      "names a point that is not one of the " + std::to_string(points));
      cells.corners.push_back(static_cast<int>(first + static_cast<std::int64_t>(v)));
    }
    double before = 0;
    for (const double end : ends.values) {
      if (end != std::floor(end) || end < before || end > static_cast<double>(cells.corners.size()))
        fail_in_array(name_, *arrays.offsets, "does not fit the connectivity");
      before = end;
      cells.ends.push_back(static_cast<std::size_t>(end));
    }
    return cells;
  }

  void read_polys(const VtkXmlPiece& piece, std::int64_t first) {
    const Cells cells = read_cells(piece.poly_cells, piece.polys, piece.points, first, "Polys");
    for (std::size_t i = 0, at = 0; i < cells.ends.size(); ++i) {
      for (; at < cells.ends[i]; ++at) surface_.polygons.add_corner(cells.corners[at]);
      const std::string problem = surface_.polygons.close_polygon(options_);
      if (!problem.empty()) throw ReadError(name_, "polygon " + std::to_string(i) + ": " + problem);
    }
  }

  void read_strips(const VtkXmlPiece& piece, std::int64_t first) {
    const Cells cells = read_cells(piece.strip_cells, piece.strips, piece.points, first, "Strips");
    std::size_t at = 0;
    for (std::size_t i = 0; i < cells.ends.size(); ++i) {
      const std::vector<int> strip(
          cells.corners.begin() + static_cast<std::ptrdiff_t>(at),
          cells.corners.begin() + static_cast<std::ptrdiff_t>(cells.ends[i]));
      at = cells.ends[i];
      const std::string problem = add_strip(surface_, strip, options_);
      if (!problem.empty()) throw ReadError(name_, "strip " + std::to_string(i) + ": " + problem);
    }
  }

  // --- Arrays ---

  void leave(const VtkXmlArray& array, const std::string& why) {
    add_loss(surface_.notes, "array " + quoted(array.name) + ": " + why);
  }

  static VtkRole role_of(const VtkXmlData& data, const std::string& name) {
    if (!name.empty() && name == data.normals) return VtkRole::Normals;
    if (!name.empty() && name == data.texcoords) return VtkRole::Texcoords;
    return VtkRole::Plain;
  }

  /// Arrays of the first piece are there to stay; later pieces add to those that both have.
  void merge(VtkArray array, const VtkXmlArray& described, bool is_first,
             std::vector<VtkArray>& arrays) {
    if (is_first) {
      arrays.push_back(std::move(array));
      return;
    }
    const auto same = std::find_if(arrays.begin(), arrays.end(), [&](const VtkArray& known) {
      return known.name == array.name && known.width == array.width;
    });
    if (same == arrays.end()) return leave(described, "not all pieces have it");
    same->type = common_type(same->type, array.type);
    same->values.insert(same->values.end(), array.values.begin(), array.values.end());
  }

  bool is_numeric(const VtkXmlArray& array) {
    if (array.type == "String") leave(array, "it holds strings");
    return array.type != "String";
  }

  void read_data(const VtkXmlData& data, std::int64_t count, bool is_first,
                 std::vector<VtkArray>& arrays) {
    for (const VtkXmlArray& described : data.arrays) {
      if (!is_numeric(described)) continue;
      VtkArray array = decoder_.numbers(described, described.width * count, surface_.notes);
      array.role = role_of(data, array.name);
      merge(std::move(array), described, is_first, arrays);
    }
  }

  /// Of arrays of all cells the part of the polygons.
  void read_cell_data(const VtkXmlPiece& piece, std::int64_t others, std::int64_t polys,
                      bool is_first) {
    for (const VtkXmlArray& described : piece.cell_data.arrays) {
      if (!is_numeric(described)) continue;
      VtkArray array =
          decoder_.numbers(described, described.width * (others + polys), surface_.notes);
      array.values.erase(array.values.begin(), array.values.begin() + others * array.width);
      array.role = role_of(piece.cell_data, array.name);
      merge(std::move(array), described, is_first, surface_.cell_arrays);
    }
  }

  const VtkDocument& document_;
  VtkDecoder decoder_;
  const std::string& name_;
  const ReadOptions& options_;
  std::int64_t lost_cells_ = 0;
  VtkSurface surface_;
};

}  // namespace

bool looks_like_xml_vtk(std::string_view bytes) {
  constexpr std::size_t prologue_size = 4096;
  bytes.remove_prefix(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
  return bytes.starts_with("<") &&
         bytes.substr(0, prologue_size).find("<VTKFile") != std::string_view::npos;
}

MeshFile read_xml_vtk(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  const VtkDocument document = parse_vtk_document(bytes, name);
  return XmlVtkReader(document, bytes.size(), name, options).read();
}

}  // namespace sphparam
