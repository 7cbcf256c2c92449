// The polygons of a control mesh, with what its subdivision is and is not to smooth.

#include <vector>

#include "gltf/chart_surface.h"
#include "gltf/side_files.h"
#include "gltf/usd/usd_check.h"
#include "gltf/usd/usd_head.h"
#include "io/attributes/remarks.h"
#include "io/files/stored_zip.h"
#include "number_text.h"
#include "sphparam/gltf/usd_writer.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/polygons.h"
#include "sphparam/io/up_axis.h"

namespace sphparam {

namespace {

struct Cage {
  UsdArrays arrays;
  Eigen::RowVector3d origin;
};

Cage cage_of(const MappedMesh& mapped) {
  const MeshFile& file = mapped.file();
  const TriangleMesh& mesh = file.mesh;
  const Polygons faces =
      mapped.polygons() ? *mapped.polygons() : triangles_as_polygons(mesh.triangles);
  const Points upright = mesh.positions * upright_rotation(upright_axes(file)).transpose();
  Cage cage{{}, origin_for_float32(upright)};
  cage.arrays.points = (upright.rowwise() - cage.origin).cast<float>();
  cage.arrays.indices.assign(faces.corners.begin(), faces.corners.end());
  for (std::int64_t p = 0; p < faces.count(); ++p)
    cage.arrays.counts.push_back(static_cast<std::uint32_t>(faces.degree(p)));
  if (!file.corner_texcoords) return cage;
  const std::vector<int> corners = corners_in(mesh.triangles, faces);
  cage.arrays.st.resize(std::ssize(corners), 2);
  for (Eigen::Index i = 0; i < cage.arrays.st.rows(); ++i)
    cage.arrays.st.row(i) =
        file.corner_texcoords->row(corners[static_cast<std::size_t>(i)]).cast<float>();
  return cage;
}

Asset said_of(const MappedMesh& mapped, const std::string& path) {
  Asset said{.name = stem_of_export(path)};
  for (const auto& [key, value] : mapped.provenance())
    said.extras.emplace_back("map_" + key, value);
  if (!mapped.file().comments.empty())
    said.extras.emplace_back("comments", joined(mapped.file().comments, "\n"));
  return said;
}

std::string layer_of(const Cage& cage, const Asset& said, bool is_loop) {
  const UsdArrays& arrays = cage.arrays;
  constexpr std::size_t bytes_of_corner = 40, bytes_of_rest = 16'384;
  LayerText text(bytes_of_rest + bytes_of_corner * (arrays.indices.size() + arrays.counts.size()));
  put_head(text, said);
  text.line("");
  text.open("def Xform \"%\" (", {usd_name(said.name)});
  text.line("kind = \"component\"");
  text.close(")");
  text.open("{");
  text.line("def Mesh \"mesh\"");
  text.open("{");
  FloatRows extent(2, 3);
  extent << arrays.points.colwise().minCoeff(), arrays.points.colwise().maxCoeff();
  text.rows("float3[] extent", extent);
  text.line("uniform token faceVaryingLinearInterpolation = \"all\"");
  text.numbers("int[] faceVertexCounts", arrays.counts);
  text.numbers("int[] faceVertexIndices", arrays.indices);
  text.rows("point3f[] points", arrays.points);
  if (arrays.st.size() > 0) text.varying_rows("texCoord2f[] primvars:st", "faceVarying", arrays.st);
  text.line("uniform token subdivisionScheme = \"%\"", {is_loop ? "loop" : "catmullClark"});
  put_origin(text, cage.origin);
  text.close();
  text.close();
  return text.take();
}

}  // namespace

std::vector<std::string> add_usd_cage(PendingFiles& files, const std::string& path,
                                      const MappedMesh& cage, bool is_loop) {
  const Cage made = cage_of(cage);
  std::string bytes = layer_of(made, said_of(cage, path), is_loop);
  constexpr std::size_t alignment = 64;
  if (extension_of(path) == ".usdz") bytes = stored_zip({{usdz_layer, bytes}}, alignment);
  files.add(path, std::move(bytes), [&](std::string_view on_disk) {
    check_written_usd(on_disk, output_name(path), made.arrays);
  });
  std::vector<std::string> lines;
  if (const auto words = numbers_not_shown(cage.file()); !words.empty())
    add_loss(lines, joined(words, " and ") + ": .ply has room for that");
  if (!cage.fillers().empty()) add_loss(lines, "which faces close holes: .ply has room for that");
  return lines;
}

}  // namespace sphparam
