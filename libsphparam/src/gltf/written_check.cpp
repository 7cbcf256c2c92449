#include "gltf/written_check.h"

#include <limits>
#include <stdexcept>

#include "gltf/format/packing.h"
#include "io/files/read_back.h"
#include "io/formats/gltf/gltf_reader.h"
#include "sphparam/io/mesh_reader.h"

namespace sphparam {
namespace {

[[noreturn]] void fail(const std::string& name, const std::string& what) {
  throw std::runtime_error(name + ", read back: " + what);
}

/// Decoders of compressed triangles may begin with another corner.
bool same_triangle(const Triangles::ConstRowXpr& read, Vertex a, Vertex b, Vertex c,
                   bool any_first) {
  const auto is = [&](int k) {
    return read[k] == a && read[(k + 1) % 3] == b && read[(k + 2) % 3] == c;
  };
  return is(0) || (any_first && (is(1) || is(2)));
}

void compare_triangles(const MeshFile& file, const Surface& surface, bool any_first,
                       const std::string& name) {
  if (file.mesh.vertex_count() != surface.positions.rows()) fail(name, "other vertices");
  if (file.mesh.triangles.size() != static_cast<Eigen::Index>(surface.indices.size()))
    fail(name, "other triangles");
  for (Face f = 0; f < file.mesh.face_count(); ++f) {
    const auto row = [&](int k) { return static_cast<Vertex>(surface.indices[size_t(3 * f + k)]); };
    if (!same_triangle(file.mesh.triangles.row(f), row(0), row(1), row(2), any_first))
      fail(name, "triangle " + std::to_string(f) + " differs");
  }
}

void compare_positions(const MeshFile& file, const Surface& surface, bool quantised,
                       const std::string& name) {
  // Half a step, and the rounding of the node's transform.
  constexpr double share_of_step = 0.5 + 1e-6;
  const double tolerance = quantised ? share_of_step * quantisation_of(surface.positions).scale : 0;
  const Points stored = surface.positions.cast<double>().rowwise() + surface.origin;
  const double size = stored.cwiseAbs().maxCoeff();
  const double rounding = quantised ? 4 * std::numeric_limits<double>::epsilon() * size : 0;
  if ((file.mesh.positions - stored).cwiseAbs().maxCoeff() > tolerance + rounding)
    fail(name, "positions differ");
}

void compare_uv(const MeshFile& file, const Surface& surface, bool quantised,
                const std::string& name) {
  if (surface.texcoords.empty()) return;
  const FloatRows& uv = surface.texcoords.front();
  const bool sixteen_bits = quantised && fits_integers(uv);
  const Property* s = file.find_vertex_property("s");
  const Property* t = file.find_vertex_property("t");
  if (!s || !t) fail(name, "no texture coordinates");
  for (Eigen::Index i = 0; i < uv.rows(); ++i) {
    double u = uv(i, 0), v = uv(i, 1);
    if (sixteen_bits) {
      u = to_unsigned16(u) / 65535.0;
      v = to_unsigned16(v) / 65535.0;
    }
    if (s->values[static_cast<size_t>(i)] != u || t->values[static_cast<size_t>(i)] != 1 - v)
      fail(name, "the texture coordinates of vertex " + std::to_string(i) + " differ");
  }
}

std::vector<Face> written_faces(const SphericalChart& chart, const FillerMarks& fillers) {
  std::vector<Face> faces;
  for (Face f = 0; f < chart.triangles.rows(); ++f) {
    if (fillers.empty() || !fillers[static_cast<size_t>(f)]) faces.push_back(f);
  }
  return faces;
}

/// Vertices that these faces use have the numbers from 0, in their order.
Triangles written_triangles(const SphericalChart& chart, const std::vector<Face>& faces) {
  std::vector<Vertex> name(static_cast<size_t>(chart.points.rows()), -1);
  for (const Face f : faces) {
    for (int k = 0; k < 3; ++k) name[static_cast<size_t>(chart.triangles(f, k))] = 0;
  }
  Vertex next = 0;
  for (Vertex& v : name) {
    if (v == 0) v = next++;
  }
  Triangles triangles(std::ssize(faces), 3);
  for (Eigen::Index i = 0; i < triangles.rows(); ++i) {
    for (int k = 0; k < 3; ++k) {
      triangles(i, k) =
          name[static_cast<size_t>(chart.triangles(faces[static_cast<size_t>(i)], k))];
    }
  }
  return triangles;
}

}  // namespace

void check_written(std::string_view glb, const std::string& name, const Asset& asset,
                   const GltfOptions& options) {
  const MeshFile file = read_gltf(glb, name, std::nullopt, own_file);
  const Surface& surface = asset.levels.front();
  compare_triangles(file, surface, options.compress, name);
  compare_positions(file, surface, options.quantise, name);
  compare_uv(file, surface, options.quantise, name);
}

ChartCertificate certify_written(std::string_view bytes, const std::string& name,
                                 const ExportChart& exported, const FillerMarks& fillers,
                                 int threads) {
  const MeshFile file = read_mesh(bytes, name, own_file);
  SphericalChart chart = exported.chart;
  const std::vector<Face> written = written_faces(chart, fillers);
  if (file.mesh.triangles != written_triangles(chart, written)) fail(name, "triangles differ");
  if (!file.corner_texcoords) fail(name, "no texture coordinates");
  for (Eigen::Index i = 0; i < file.mesh.face_count(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const auto st = file.corner_texcoords->row(3 * i + k);
      chart.uv.row(chart.wedges(written[static_cast<size_t>(i)], k))
          << (exported.mirrored ? 1 - st[0] : st[0]),
          1 - st[1];
    }
  }
  ChartCertificate certificate = certify_chart(chart, threads);
  certificate.around_pole = exported.chart.certificate.around_pole;  // what only the rays can tell
  return certificate;
}

}  // namespace sphparam
