#include "sphparam/io/certified_files.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include "io/files/file_bytes.h"
#include "io/files/read_back.h"
#include "number_text.h"
#include "sphparam/errors.h"
#include "sphparam/io/brain_names.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/io/vertex_data.h"

namespace sphparam {

namespace {

[[noreturn]] void refuse_numbers(const std::string& path, const std::string& what, Eigen::Index at,
                                 std::int64_t count, Eigen::Index all) {
  throw UnmeasurableMesh(path + ": not written: " + what + " of vertex " + std::to_string(at) +
                         (count > 1 ? " and " + std::to_string(count - 1) + " more" : "") + " of " +
                         std::to_string(all) +
                         " would be no finite number; is the mesh very large or small? scale it");
}

/// The polygons of the triangles that are surface, with the numbers that vertices have there.
Polygons surface_polygons(const MappedMesh& mapped) {
  const Polygons& all = *mapped.polygons();
  const Triangulation cut = triangulate(mapped.mesh().positions, all);
  std::vector<char> kept(static_cast<std::size_t>(all.count()), 0);
  for (Eigen::Index t = 0; t < cut.triangles.rows(); ++t) {
    if (!mapped.fillers()[t]) kept[cut.polygon_of(t)] = 1;
  }
  std::vector<int> name(static_cast<std::size_t>(mapped.mesh().vertex_count()), -1);
  for (std::int64_t p = 0; p < all.count(); ++p) {
    if (!kept[p]) continue;
    for (const int v : all.polygon(p)) name[v] = 0;
  }
  int next = 0;
  for (int& v : name) {
    if (v == 0) v = next++;
  }
  Polygons surface;
  for (std::int64_t p = 0; p < all.count(); ++p) {
    if (!kept[p]) continue;
    for (const int v : all.polygon(p)) surface.corners.push_back(name[v]);
    surface.starts.push_back(static_cast<int>(surface.corners.size()));
  }
  return surface;
}

bool holds(const std::string& path, const std::string& bytes) try {
  return std::filesystem::is_regular_file(path) && FileBytes(path, bytes.size()).view() == bytes;
} catch (const ReadError&) {
  return false;
}

/// Nobody named this place: what lies there may be somebody's only copy. The same bytes may stay.
void require_free(const std::string& beside, const std::string& mesh, const VertexData& data,
                  const Points& surface) {
  std::error_code hidden;
  if (!std::filesystem::exists(beside, hidden)) return;
  if (holds(beside, serialise_vertex_data(beside, data, &surface))) return;
  throw WriteError(beside, "is there already, and '" + data.name + "' would replace it, beside " +
                               output_name(mesh) +
                               "; move it away, or give -o another name, or one in .ply, which "
                               "holds data itself");
}

/// The data of a mesh and its file; a measure and a time series of one name would lie in one file
/// of FreeSurfer's, so the second is renamed.
using DataBeside = std::pair<std::string, VertexData>;
std::vector<DataBeside> data_beside(const std::string& mesh, const MeshFile& file) {
  std::vector<DataBeside> all;
  std::set<std::string> taken;
  for (VertexData& data : attached_data(file)) {
    const std::string name = data.name;
    std::string path = data_path(mesh, data);
    for (int number = 2; !taken.insert(path).second; ++number) {
      data.name = name + "_" + std::to_string(number);
      path = data_path(mesh, data);
    }
    all.emplace_back(std::move(path), std::move(data));
  }
  return all;
}

/// The mesh, without the data that lies beside it where its format has it so; `told` says where.
MeshFile with_data_beside(PendingFiles& files, const std::string& path, MeshFile file,
                          std::vector<std::string>& told) {
  if (!has_data_beside(path)) return file;
  for (auto& [beside, data] : data_beside(path, file)) {
    data.triangles = file.mesh.face_count();
    require_free(beside, path, data, file.mesh.positions);
    told.push_back(data.name + " beside it: " + output_name(beside));
    for (const std::string& loss : add_vertex_data(files, beside, data, &file.mesh.positions))
      told.push_back(output_name(beside) + ": " + loss);
  }
  return without_data(std::move(file));
}

std::vector<std::string> add_surface(PendingFiles& files, const std::string& path,
                                     const MappedMesh& mapped, WriteOptions options) {
  std::vector<std::string> losses;
  const MeshFile surface =
      with_data_beside(files, path, without_map(without_fillers(mapped.file())), losses);
  require_numbers(surface, path);
  const Polygons faces =
      mapped.polygons() ? surface_polygons(mapped) : triangles_as_polygons(surface.mesh.triangles);
  options.faces = &faces;
  const auto fillers = std::count(mapped.fillers().begin(), mapped.fillers().end(), 1);
  losses.insert(losses.begin(), "the surface alone, without the map: " +
                                    counted(fillers, "filler", "fillers") + " of holes left out");
  files.add(path, serialise_mesh(path, surface, options), [&](std::string_view written) {
    const ReadBack read = read_back(written, path, surface);
    if (read.file.mesh.triangles != surface.mesh.triangles)
      throw WriteError(path, "as written, it has other triangles");
    for (std::string& loss : losses_of_read_back(surface, read)) losses.push_back(std::move(loss));
  });
  return losses;
}

}  // namespace

std::vector<std::string> paths_beside(const std::string& path, const MeshFile& file) {
  std::vector<std::string> paths;
  if (!has_data_beside(path)) return paths;
  for (DataBeside& one : data_beside(path, file)) paths.push_back(std::move(one.first));
  return paths;
}

void require_numbers(const MeshFile& file, const std::string& path) {
  const Eigen::Index all = file.mesh.vertex_count();
  const auto require = [&](const std::string& what, const auto& is_held) {
    std::int64_t count = 0;
    Eigen::Index first = 0;
    for (Eigen::Index v = all; v-- > 0;) {
      if (is_held(v)) continue;
      ++count;
      first = v;
    }
    if (count > 0) refuse_numbers(path, what, first, count, all);
  };
  require("the position", [&](Eigen::Index v) {
    const auto position = file.mesh.positions.row(v);
    return std::isfinite(position[0]) && std::isfinite(position[1]) && std::isfinite(position[2]);
  });
  for (const Property& property : file.vertex_properties) {
    require("'" + property.name + "'",
            [&](Eigen::Index v) { return std::isfinite(property.values[static_cast<size_t>(v)]); });
  }
}

void add_certified(PendingFiles& files, const std::string& path, std::string bytes,
                   const Topology& topology, int threads) {
  files.add(path, std::move(bytes), [&](std::string_view written) {
    const MeshFile read = read_mesh(written, path, own_file);
    require_certified(certify_read_back(read, read_sphere(read).value(), topology, threads),
                      path + ", as written");
  });
}

void add_certified(PendingFiles& files, const std::string& path, std::string bytes,
                   const Topology& topology, const SphereMap& map, int threads) {
  files.add(path, std::move(bytes), [&](std::string_view written) {
    const MeshFile read = read_mesh(written, path, own_file);
    require_certified(certify_read_back(read, map, topology, threads), path + ", as written");
  });
}

std::vector<std::string> add_mapped(PendingFiles& files, const std::string& path, MeshFile file,
                                    const Polygons& faces, const Topology& topology, int threads,
                                    WriteOptions options) {
  std::vector<std::string> losses;
  file = with_data_beside(files, path, std::move(file), losses);
  require_numbers(file, path);
  const bool has_place = keeps_map(path);
  const std::optional<SphereMap> map = has_place ? std::nullopt : read_sphere(file);
  options.faces = &faces;
  files.add(path, serialise_mesh(path, file, options), [&](std::string_view written) {
    const ReadBack read = read_back(written, path, file);
    const SphereMap rays = has_place ? read_sphere(read.file).value() : map.value();
    require_certified(certify_read_back(read.file, rays, topology, threads), path + ", as written");
    for (std::string& loss : losses_of_read_back(file, read)) losses.push_back(std::move(loss));
  });
  return losses;
}

std::vector<std::string> add_mesh(PendingFiles& files, const std::string& path, MeshFile file,
                                  const WriteOptions& options) {
  std::vector<std::string> losses;
  if (const auto fillers = std::ranges::count(fillers_of(file), 1);
      fillers > 0 && !keeps_map(path)) {
    file = without_fillers(file);
    losses.push_back("the surface alone: " + counted(fillers, "filler", "fillers") +
                     " of holes left out; --keep-holes closes them again");
  }
  file = with_data_beside(files, path, std::move(file), losses);
  require_numbers(file, path);
  files.add(path, serialise_mesh(path, file, options), [&](std::string_view written) {
    ReadOptions reading = own_file;
    reading.repeated_corners = true;
    const ReadBack read = read_back(written, path, file, reading);
    if (read.file.mesh.triangles != file.mesh.triangles)
      throw WriteError(path, "as written, it has other triangles");
    for (std::string& loss : losses_of_read_back(file, read)) losses.push_back(std::move(loss));
  });
  return losses;
}

std::vector<std::string> add_mapped(PendingFiles& files, const std::string& path,
                                    const MappedMesh& mapped, int threads,
                                    const WriteOptions& options, FillersInFile fillers) {
  const bool leaves =
      fillers == FillersInFile::Left || (fillers == FillersInFile::Marked && !keeps_map(path));
  if (leaves && !mapped.fillers().empty()) return add_surface(files, path, mapped, options);
  const Polygons faces =
      mapped.polygons() ? *mapped.polygons() : triangles_as_polygons(mapped.mesh().triangles);
  return add_mapped(files, path, attach_map(mapped.file(), mapped.map(), mapped.provenance()),
                    faces, mapped.topology(), threads, options);
}

}  // namespace sphparam
