// Faces of several degrees have records of several lengths, which are appended one by one.

#include "io/formats/ply/polygon_ply.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "io/files/byte_reader.h"
#include "io/formats/lossless_type.h"
#include "io/formats/ply/ply_writer.h"

namespace sphparam {

namespace {

void put(std::string& bytes, ScalarType type, double value) {
  with_scalar(type, [&](auto scalar) {
    append_number(bytes, static_cast<decltype(scalar)>(value), std::endian::little);
  });
}

/// What has a value at each corner of the triangles.
struct CornerList {
  std::string name;
  ScalarType type;
  const double* values;
  int width;
};

template <class Table>
void add_list(std::vector<CornerList>& lists, const char* name, const std::optional<Table>& table,
              ScalarType declared) {
  if (!table) return;
  lists.push_back({name, narrow_lossless_type(declared, table->data(), table->size()),
                   table->data(), static_cast<int>(table->cols())});
}

/// The faces of a file, its triangles put together again.
class FaceRecords {
 public:
  FaceRecords(const MeshFile& file, const Polygons& faces)
      : faces_(faces), corners_(corners_in(file.mesh.triangles, faces)) {
    add_list(lists_, "texcoord", file.corner_texcoords, file.corner_texcoord_type);
    add_list(lists_, "normal", file.corner_normals, file.corner_normal_type);
    find_length_type();
    for (const Property& property : file.face_properties) {
      if (property.name == "source_face") continue;
      const auto count = static_cast<Eigen::Index>(property.values.size());
      properties_.push_back(&property);
      types_.push_back(narrow_lossless_type(property.type, property.values.data(), count));
    }
  }

  std::string declarations() const {
    std::string text = "element face " + std::to_string(faces_.count()) + "\n" + list_words() +
                       "int vertex_indices\n";
    for (const CornerList& list : lists_)
      text += list_words() + std::string(ply_name(list.type)) + " " + list.name + "\n";
    for (size_t i = 0; i < properties_.size(); ++i) {
      text += "property " + std::string(ply_name(types_[i])) + " " +
              one_line(properties_[i]->name) + "\n";
    }
    return text;
  }

  std::size_t bytes() const {
    const auto faces = static_cast<std::size_t>(faces_.count());
    std::size_t of_corner = sizeof(std::int32_t),
                of_face = size_in_bytes(length_type_) * (1 + lists_.size());
    for (const CornerList& list : lists_)
      of_corner += static_cast<std::size_t>(list.width) * size_in_bytes(list.type);
    for (const ScalarType type : types_) of_face += size_in_bytes(type);
    return of_corner * corners_.size() + of_face * faces;
  }

  void append_to(std::string& bytes) const {
    for (std::int64_t p = 0; p < faces_.count(); ++p) {
      const int degree = faces_.degree(p), first = faces_.starts[p];
      put(bytes, length_type_, degree);
      for (const int v : faces_.polygon(p)) put(bytes, ScalarType::Int32, v);
      for (const CornerList& list : lists_) {
        put(bytes, length_type_, degree * list.width);
        for (int i = first; i < first + degree; ++i) {
          const double* const row = list.values + std::int64_t{corners_[i]} * list.width;
          for (int k = 0; k < list.width; ++k) put(bytes, list.type, row[k]);
        }
      }
      for (size_t i = 0; i < properties_.size(); ++i) {
        put(bytes, types_[i], properties_[i]->values[corners_[first] / 3]);
      }
    }
  }

 private:
  /// A byte, as usual, but where a list is longer than it can say.
  void find_length_type() {
    int longest = 0, width = 1;
    for (std::int64_t p = 0; p < faces_.count(); ++p) longest = std::max(longest, faces_.degree(p));
    for (const CornerList& list : lists_) width = std::max(width, list.width);
    if (std::int64_t{longest} * width > 255) length_type_ = ScalarType::Int32;
  }

  std::string list_words() const {
    return "property list " + std::string(ply_name(length_type_)) + " ";
  }

  const Polygons& faces_;
  ScalarType length_type_ = ScalarType::Uint8;
  std::vector<int> corners_;  // of the triangles, one a corner of the polygons
  std::vector<CornerList> lists_;
  std::vector<const Property*> properties_;
  std::vector<ScalarType> types_;
};

}  // namespace

std::string serialise_polygon_ply(const MeshFile& file, const Polygons& faces) {
  const FaceRecords records(file, faces);
  std::string bytes = ply_up_to_faces(file, records.declarations(), records.bytes());
  records.append_to(bytes);
  return bytes;
}

}  // namespace sphparam
