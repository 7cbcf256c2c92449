// Reads mesh files, gives them more to carry, writes them in every format, and prints 64 bits of
// what came and went: what machines of another order of bytes must agree on. `big_endian` runs it.
//
//     same_files FOLDER FILE…     what is written stays in FOLDER
//
// A line a result: the file, "holds" or "is", the bits. What is refused says so in place of them.

#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/vertex_data.h"

using namespace sphparam;

namespace {

constexpr const char* mesh_endings[] = {".ply", ".obj", ".off",   ".vtk",   ".vtp",
                                        ".gii", ".mz3", ".white", ".ply.gz"};
constexpr const char* metric_endings[] = {".curv", ".mgh", ".mgz", ".shape.gii"};
constexpr const char* label_endings[] = {".annot", ".label.gii"};

/// FNV-1a, of a text that says every number to the bit.
class Digest {
 public:
  void add(std::string_view text) {
    for (const char c : text) bits_ = (bits_ ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  }
  void add(double number) {
    char text[40];
    add({text, static_cast<std::size_t>(std::snprintf(text, sizeof text, "%a ", number))});
  }
  template <class Numbers>
  void add_all(const Numbers& numbers) {
    for (const double number : numbers) add(number);
  }
  template <class Table>
  void add_table(const Table& table) {
    add_all(table.template reshaped<Eigen::RowMajor>().template cast<double>());
  }

  std::uint64_t bits() const { return bits_; }

 private:
  std::uint64_t bits_ = 0xcbf29ce484222325;
};

std::uint64_t bits_of(std::string_view bytes) {
  Digest digest;
  digest.add(bytes);
  return digest.bits();
}

/// Normals of a node that is turned are worked out when read, and Eigen rounds their lengths in
/// another order on another machine: they are compared as the floats that files have.
bool is_normal(const Property& property) {
  return property.name == "nx" || property.name == "ny" || property.name == "nz";
}

std::uint64_t bits_of(const MeshFile& file) {
  Digest digest;
  digest.add_table(file.mesh.positions);
  digest.add_table(file.mesh.triangles);
  for (const auto* properties : {&file.vertex_properties, &file.face_properties}) {
    for (const Property& property : *properties) {
      digest.add(property.name);
      for (const double value : property.values) {
        digest.add(is_normal(property) ? double(float(value)) : value);
      }
    }
  }
  if (file.corner_texcoords) digest.add_table(*file.corner_texcoords);
  if (file.corner_normals) digest.add_table(*file.corner_normals);
  for (const std::string& comment : file.comments) digest.add(comment);
  return digest.bits();
}

std::uint64_t bits_of(const VertexData& data) {
  Digest digest;
  for (const DataColumn& column : data.columns) digest.add_all(column.values);
  for (const Label& label : data.labels) {
    digest.add(label.key);
    digest.add(label.name);
  }
  return digest.bits();
}

void tell(const std::string& file, const char* verb, const std::function<std::uint64_t()>& make) {
  try {
    std::printf("%s %s %016llx\n", file.c_str(), verb, static_cast<unsigned long long>(make()));
  } catch (const std::exception& e) {
    std::printf("%s %s refused: %s\n", file.c_str(), verb, e.what());
  }
}

std::vector<double> counted(Eigen::Index count, double step) {
  std::vector<double> values(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = step * static_cast<double>(i % 200);
  return values;
}

/// The mesh, with a number of every type and coordinates at the corners.
MeshFile dressed(const MeshFile& file) {
  MeshFile more{.mesh = file.mesh, .position_type = file.position_type};
  const Eigen::Index vertices = file.mesh.vertex_count(), faces = file.mesh.face_count();
  more.set_vertex_property({"small", ScalarType::Uint8, counted(vertices, 1)});
  more.set_vertex_property({"whole", ScalarType::Int32, counted(vertices, -100000)});
  more.set_vertex_property({"single", ScalarType::Float32, counted(vertices, 0.25)});
  more.set_vertex_property({"double", ScalarType::Float64, counted(vertices, 0.1)});
  more.set_face_property({"kind", ScalarType::Int16, counted(faces, -3)});
  more.corner_texcoords = CornerTexcoords(3 * faces, 2);
  for (Eigen::Index i = 0; i < 3 * faces; ++i) {
    more.corner_texcoords->row(i) << 0.125 * double(i % 7), 0.1 * double(i % 11);
  }
  more.comments = {"made by same_files"};
  return more;
}

class Files {
 public:
  explicit Files(std::string folder) : folder_(std::move(folder)) {}

  void write_all(const std::string& name, const MeshFile& file) const {
    for (const char* ending : mesh_endings) {
      const std::string bytes = written(
          name + ending, [&](const std::string& path) { return serialise_mesh(path, file); });
      tell(name + ending, "holds", [&] { return bits_of(read_mesh(bytes, name + ending, {})); });
    }
    const Eigen::Index vertices = file.mesh.vertex_count();
    for (const char* ending : metric_endings) {
      write_data(
          name + ending,
          {.name = name, .columns = {{"depth", ScalarType::Float32, counted(vertices, 0.1)}}});
    }
    std::vector<double> keys = counted(vertices, 1);
    for (double& key : keys) key = key < 100 ? 1 : 258;
    for (const char* ending : label_endings) {
      write_data(name + ending,
                 {.name = name,
                  .kind = DataKind::Labels,
                  .columns = {{"parts", ScalarType::Int32, keys}},
                  .labels = {{1, {{1, 0, 0, 1}}, "left"}, {258, {{0, 0.5F, 1, 1}}, "right"}}});
    }
  }

 private:
  void write_data(const std::string& name, const VertexData& data) const {
    const std::string bytes =
        written(name, [&](const std::string& path) { return serialise_vertex_data(path, data); });
    tell(name, "holds", [&] { return bits_of(read_vertex_data(bytes, name)); });
  }

  template <class Serialise>
  std::string written(const std::string& name, const Serialise& serialise) const {
    std::string bytes;
    tell(name, "is", [&] {
      bytes = serialise(name);
      std::ofstream(folder_ + "/" + name, std::ios::binary) << bytes;
      return bits_of(bytes);
    });
    return bytes;
  }

  std::string folder_;
};

/// Numbers a vertex, and no surface.
bool holds_data(const std::filesystem::path& path) {
  const std::string middle = path.stem().extension();
  return path.extension() == ".gii" && (middle == ".shape" || middle == ".label");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return std::puts("same_files FOLDER FILE…"), 2;
  const Files files(argv[1]);
  for (int i = 2; i < argc; ++i) {
    const std::filesystem::path path = argv[i];
    MeshFile file;
    tell(path.filename(), "holds", [&] {
      if (holds_data(path)) return bits_of(read_vertex_data(path.string()));
      file = read_mesh(path.string());
      return bits_of(file);
    });
    if (file.mesh.face_count() > 0) files.write_all(path.filename(), dressed(file));
  }
  return 0;
}
