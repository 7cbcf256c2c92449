// What a bake costs, beside the encoder of its image and beside the way that knows no chart: one
// ray a texel from the centre of the sphere. Ratios of one run, on two threads.
//
//   bench_bake                     a geodesic sphere of 82 k triangles, 8192 × 4096
//   bench_bake MESH TEXTURE        another mesh, with texture coordinates
//   bench_bake --large             1.3 million triangles at 16384 × 8192

#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>

#include "bake/bake_rows.h"
#include "bake/fields/base_colour.h"
#include "bake/make_scene.h"
#include "image/image_writer.h"
#include "io/attributes/shading_normals.h"
#include "io/polygons/welding.h"
#include "rays/ray_scene.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/parallel.h"
#include "sphparam/parameterize.h"
#include "sphparam/sphere/spherical_coordinates.h"
#include "sphparam/stopwatch.h"
#include "srgb_curves.h"
#include "support/test_meshes.h"
#include "texture/texture_pyramid.h"

using namespace sphparam;

namespace {

constexpr int threads = 2;

/// Blobs and fine noise: what a codec finds in a painted texture.
Image noise_texture(int size) {
  Image image(size, size, 3);
  std::uint32_t state = 1;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      state = 1664525 * state + 1013904223;
      const double grain = static_cast<double>(state >> 24) / 2550;
      for (int c = 0; c < 3; ++c) {
        image.pixel(x, y)[c] = static_cast<float>(
            0.45 + 0.4 * std::sin(0.02 * x * (c + 1)) * std::cos(0.017 * y) + grain);
      }
    }
  }
  return image;
}

struct Subject {
  MeshFile file;
  SphereMap map;
  Image texture;
};

/// Two charts, the upper and the lower half seen from ±z.
Subject geodesic(int level) {
  Subject subject;
  subject.file.mesh = tests::icosphere(level);
  subject.map = {subject.file.mesh.positions};
  const TriangleMesh& mesh = subject.file.mesh;
  CornerTexcoords corners(mesh.triangles.size(), 2);
  for (Face f = 0; f < mesh.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const Vector3 x = mesh.position(mesh.triangles(f, k));
      corners.row(3 * f + k) << 0.5 + 0.45 * x[0], 0.5 + 0.45 * x[1];
    }
  }
  subject.file.corner_texcoords = corners;
  subject.texture = noise_texture(2048);
  return subject;
}

Subject read_subject(const char* mesh, const char* texture) {
  Subject subject;
  subject.file = prepare_for_mapping(read_mesh(mesh));
  subject.map = parameterize(subject.file.mesh).map;
  subject.texture = read_image(texture);
  return subject;
}

std::unique_ptr<BakeScene> scene_of(const Subject& subject) {
  const MappedMesh mapped({.file = subject.file, .map = subject.map}, threads);
  BakeTarget target = make_target(mapped, true, threads);
  const SourceTexture texture{
      .image = std::make_shared<const TexturePyramid>(subject.texture, false, threads)};
  return std::unique_ptr<BakeScene>(new BakeScene{
      {mapped, shading_normals(subject.file), {texture}}, std::move(target), {}, threads});
}

struct Timed {
  double seconds;
  std::vector<std::uint8_t> pixels;
};

Timed bake_colour(const BakeScene& scene, int width, bool keep) {
  const std::vector<SurfaceField> fields = {make_base_colour(scene, "")};
  Timed result{0, {}};
  const SrgbCurves& curves = SrgbCurves::get();
  double encoding = 0;
  const Stopwatch all;
  bake(scene, fields, {.width = width, .height = width / 2, .threads = threads},
       [&](size_t, int, int rows, const float* values) {
         if (!keep) return;
         const Stopwatch stopwatch;
         const auto count = 3 * static_cast<size_t>(rows) * static_cast<size_t>(width);
         for (size_t i = 0; i < count; ++i) {
           result.pixels.push_back(
               static_cast<std::uint8_t>(255 * curves.to_srgb(values[i]) + 0.5F));
         }
         encoding += stopwatch.seconds();
       });
  result.seconds = all.seconds() - encoding;
  return result;
}

double encode_png(const std::vector<std::uint8_t>& pixels, int width) {
  const Stopwatch stopwatch;
  std::vector<char> bytes;
  ImageWriter writer({.width = width, .height = width / 2, .channels = 3}, in_memory(bytes));
  constexpr int rows = 32;
  for (int row = 0; row < width / 2; row += rows) {
    writer.write_rows(&pixels[3 * static_cast<size_t>(row) * static_cast<size_t>(width)],
                      std::min(rows, width / 2 - row));
  }
  writer.close();
  return stopwatch.seconds();
}

/// Finds the triangle of every texel by a ray, and nothing else.
double cast_rays(const Subject& subject, int width) {
  const TriangleMesh sphere{subject.map.points, subject.file.mesh.triangles};
  const RayScene scene(sphere);
  const int height = width / 2;
  std::vector<long> missed(static_cast<size_t>(height), 0);
  const Stopwatch stopwatch;
  parallel_for(height, 16, threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t row = first; row < last; ++row) {
      for (int column = 0; column < width; ++column) {
        const double theta = 2 * std::numbers::pi * (column + 0.5) / width,
                     phi = std::numbers::pi * (static_cast<double>(row) + 0.5) / height;
        const RayHit hit = scene.first_hit(Vector3::Zero(), to_cartesian({theta, phi}), 10);
        missed[static_cast<size_t>(row)] += hit.face < 0;
      }
    }
  });
  const double seconds = stopwatch.seconds();
  long all = 0;
  for (const long m : missed) all += m;
  if (all > 0) std::printf("  (%ld rays met nothing)\n", all);
  return seconds;
}

void compare(const Subject& subject, int width) {
  Stopwatch stopwatch;
  const auto scene = scene_of(subject);
  const double preparing = stopwatch.seconds();
  const double texels = 0.5 * width * width;
  bake_colour(*scene, width / 4, false);  // warms what is warmed once
  const Timed baked = bake_colour(*scene, width, true);
  const double png = encode_png(baked.pixels, width), rays = cast_rays(subject, width);
  std::printf("%ld triangles, %d × %d\n", static_cast<long>(subject.file.mesh.face_count()), width,
              width / 2);
  std::printf("  chart and texture          %8.2f s\n", preparing);
  std::printf("  rasterise and sample       %8.2f s  %6.1f ns a texel\n", baked.seconds,
              1e9 * baked.seconds / texels);
  std::printf("  encode as PNG              %8.2f s  %6.2f × the bake (wanted: at least 2)\n", png,
              png / baked.seconds);
  std::printf("  one ray a texel            %8.2f s  %6.2f × the bake (wanted: at least 5)\n", rays,
              rays / baked.seconds);
}

/// Cost a texel and a triangle: linear if the columns are level.
void grow() {
  std::printf("triangles    size         bake       ns/texel\n");
  for (const auto& [level, width] :
       {std::pair(4, 2048), {4, 4096}, {4, 8192}, {6, 4096}, {8, 4096}, {8, 16384}}) {
    const Subject subject = geodesic(level);
    const auto scene = scene_of(subject);
    const double seconds = bake_colour(*scene, width, false).seconds;
    std::printf("%9ld %6d × %-6d %8.2f s %8.1f\n",
                static_cast<long>(subject.file.mesh.face_count()), width, width / 2, seconds,
                1e9 * seconds / (0.5 * width * width));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], "--large") == 0) {
    grow();
  } else {
    compare(argc == 3 ? read_subject(argv[1], argv[2]) : geodesic(6), 8192);
  }
}
