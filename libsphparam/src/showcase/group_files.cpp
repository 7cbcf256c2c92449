#include "sphparam/records/group_files.h"

#include <filesystem>
#include <utility>

#include "io/data_comments.h"
#include "mesh/vertex_normals.h"
#include "sphparam/gltf/export.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/render/coloured_values.h"

namespace sphparam {
namespace {

constexpr double shown_deviations = 2;  // from the mean, of modes

std::vector<double> as_list(const VectorX& values) { return {values.begin(), values.end()}; }

std::vector<std::string> names_of_vertices(const MeshFile& file) {
  std::vector<std::string> names;
  for (const Property& property : file.vertex_properties) names.push_back(property.name);
  return names;
}

/// The mesh with its map, and other things at its vertices.
MappedMesh with_file(const MappedMesh& mesh, MeshFile file) {
  return MappedMesh({.file = std::move(file),
                     .map = mesh.map(),
                     .provenance = mesh.provenance(),
                     .topology = mesh.topology(),
                     .name = mesh.name()},
                    1);
}

class GroupWriter {
 public:
  GroupWriter(PendingFiles& files, const std::string& folder, const GroupRecord& record,
              const GroupFileOptions& options)
      : files_(files), folder_(folder), record_(record), options_(options) {}

  std::vector<std::string> run() {
    add("index.html", group_page(record_, options_));
    add_mean();
    for (size_t k = 0; k < group().modes.modes.size(); ++k) add_mode(static_cast<int>(k));
    for (size_t i = 0; i < record_.names.size(); ++i) add_shape(i);
    add("shapes.tsv", shapes_table(record_));
    add("distances.tsv", distances_table(record_));
    add("vertices.tsv", vertices_table(record_));
    if (!record_.landmarks.empty()) add("landmarks.tsv", landmarks_table(record_));
    return std::move(names_);
  }

 private:
  const Group& group() const { return record_.group; }

  std::string path_of(const std::string& name) {
    names_.push_back(name);
    return (std::filesystem::path(folder_) / name).string();
  }
  void add(const std::string& name, std::string bytes) {
    files_.add(path_of(name), std::move(bytes));
  }
  void add_mesh_with_map(const std::string& name, const MappedMesh& mapped) {
    add_mapped(files_, path_of(name), mapped, options_.threads);
  }

  void add_mean() {
    MeshFile file = with_coloured_values(group().mean.file(), "deviation", group().deviation,
                                         "standard deviation of the shapes");
    file.set_vertex_property(
        {"normal_deviation", ScalarType::Float64, as_list(group().normal_deviation)});
    file.set_vertex_property({"weight", ScalarType::Float64, as_list(group().weights)});
    for (const GroupScalar& scalar : group().scalars) {
      const std::string name = carried_name(group(), scalar.name);
      file.set_vertex_property({name + "_mean", ScalarType::Float64, as_list(scalar.mean)});
      file.set_vertex_property(
          {name + "_deviation", ScalarType::Float64, as_list(scalar.deviation)});
    }
    const MappedMesh mean = with_file(group().mean, std::move(file));
    add_mesh_with_map("mean.sph.ply", mean);
    add_glb("mean.glb", mean, {});
  }

  void add_glb(const std::string& name, const MappedMesh& mesh, std::vector<OtherShape> others) {
    const Asset asset = make_asset(mesh, {.name = std::filesystem::path(name).stem().string(),
                                          .others = std::move(others),
                                          .up = options_.up,
                                          .threads = options_.threads,
                                          .progress = options_.progress});
    add_asset(files_, path_of(name), asset);
  }

  /// Coloured by how far the mode moves it.
  MappedMesh coloured(const MappedMesh& mesh, int mode) const {
    const VectorX lengths =
        shown_deviations * group().modes.modes[static_cast<size_t>(mode)].rowwise().norm();
    return with_file(mesh, with_coloured_values(mesh.file(), "displacement", lengths,
                                                "by two standard deviations"));
  }

  void add_mode(int mode) {
    const std::string name = "mode" + std::to_string(mode + 1);
    std::vector<OtherShape> others;
    for (const auto& [side, deviations] :
         {std::pair("minus", -shown_deviations), {"plus", shown_deviations}}) {
      const MappedMesh end = group_shape(group(), mode, deviations);
      add_glb(name + "_" + side + ".glb", coloured(end, mode), {});
      others.push_back({side, end.mesh().positions, vertex_normals(end.mesh())});
    }
    add_glb(name + ".glb", coloured(group().mean, mode), std::move(others));
  }

  void add_shape(size_t i) {
    add_mesh_with_map("map_" + record_.names[i] + ".sph.ply", group().members[i].mapped);
    const MappedMesh shape = aligned_shape(group(), i);
    const TriangleMesh& mean = group().mean.mesh();
    const VectorX along = (shape.mesh().positions - mean.positions)
                              .cwiseProduct(vertex_normals(mean))
                              .rowwise()
                              .sum();
    MeshFile file = shape.file();
    for (const std::string& name : names_of_vertices(file))
      rename_vertex_property(file, name, carried_name(group(), name));
    file.set_vertex_property({"normal_displacement", ScalarType::Float64, as_list(along)});
    const Growth growth = growth_from_mean(group(), i);
    file.set_vertex_property({"growth", ScalarType::Float64, as_list(growth.vertices)});
    file.set_face_property({"growth", ScalarType::Float64, as_list(growth.faces)});
    add_mesh_with_map("shape_" + record_.names[i] + ".sph.ply", with_file(shape, std::move(file)));
  }

  PendingFiles& files_;
  const std::string& folder_;
  const GroupRecord& record_;
  const GroupFileOptions& options_;
  std::vector<std::string> names_;
};

}  // namespace

std::vector<std::string> add_group(PendingFiles& files, const std::string& folder,
                                   const GroupRecord& record, const GroupFileOptions& options) {
  return GroupWriter(files, folder, record, options).run();
}

}  // namespace sphparam
