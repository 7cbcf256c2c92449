// How much of a texture survives a bake: a mesh is drawn with its own texture coordinates and
// texture, and again with the chart's and the baked image, from ten sides, unlit, and the pictures
// compared: PSNR over the pixels of the mesh, 8-bit sRGB. Beside it the same for the source texture
// resampled once, with the texel density that the baked image has on each triangle, and with as
// many texels spread evenly.
//
//   bake_fidelity MESH [TEXTURE] [--size 4096] [--pictures FOLDER]

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <numeric>
#include <string>

#include "bake/bake_rows.h"
#include "bake/fields/base_colour.h"
#include "bake/make_scene.h"
#include "image/image_codec.h"
#include "io/attributes/shading_normals.h"
#include "io/attributes/source_attributes.h"
#include "io/polygons/welding.h"
#include "sphparam/chart/carry_attributes.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/parallel.h"
#include "sphparam/parameterize.h"
#include "srgb_curves.h"
#include "texture/texture_pyramid.h"

using namespace sphparam;

namespace {

constexpr int picture_size = 1024;
constexpr int view_count = 10;

/// What one pixel sees: a face of the chart's mesh, and its weights here, to the right and below.
struct Seen {
  Face face = -1;
  Vector3 weights, right, below;
  double depth = -std::numeric_limits<double>::infinity();
};

/// Directions spread evenly: Fibonacci's spiral.
Eigen::Matrix3d camera(int view) {
  const double z = 1 - (2 * view + 1.0) / view_count, angle = 2.399963229728653 * view;
  const double r = std::sqrt(1 - z * z);
  const Vector3 eye(r * std::cos(angle), r * std::sin(angle), z);
  const Vector3 right = eye.cross(Vector3(0.1, 0.2, 1)).normalized();
  Eigen::Matrix3d axes;
  axes << right, eye.cross(right), eye;
  return axes.transpose();
}

std::vector<Seen> see(const Triangles& triangles, const Points& positions, int view) {
  Points points = positions * camera(view).transpose();
  const Vector3 low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
  const double scale = 0.95 * picture_size / (high - low).head<2>().maxCoeff();
  points = (points.rowwise() - ((low + high) / 2).transpose()) * scale;
  points.leftCols<2>().array() += picture_size / 2.0;
  std::vector<Seen> seen(static_cast<size_t>(picture_size) * picture_size);
  for (Face f = 0; f < triangles.rows(); ++f) {
    const Vector3 a = points.row(triangles(f, 0)), b = points.row(triangles(f, 1)),
                  c = points.row(triangles(f, 2));
    const double det = (b - a).head<2>().x() * (c - a).y() - (b - a).y() * (c - a).x();
    if (!(det > 0)) continue;
    const Vector3 gx(b.y() - c.y(), c.y() - a.y(), a.y() - b.y()),
        gy(c.x() - b.x(), a.x() - c.x(), b.x() - a.x());
    const auto first = [](double x) { return std::max(0, static_cast<int>(std::ceil(x - 0.5))); };
    const auto last = [](double x) {
      return std::min(picture_size - 1, static_cast<int>(std::floor(x - 0.5)));
    };
    for (int y = first(std::min({a.y(), b.y(), c.y()})); y <= last(std::max({a.y(), b.y(), c.y()}));
         ++y) {
      for (int x = first(std::min({a.x(), b.x(), c.x()}));
           x <= last(std::max({a.x(), b.x(), c.x()})); ++x) {
        Vector3 w = ((x + 0.5 - c.x()) * gx + (y + 0.5 - c.y()) * gy) / det;
        w[2] += 1;
        if (w.minCoeff() < 0) continue;
        const double depth = w[0] * a.z() + w[1] * b.z() + w[2] * c.z();
        Seen& pixel = seen[static_cast<size_t>(y) * picture_size + static_cast<size_t>(x)];
        if (depth > pixel.depth) pixel = {f, w, gx / det, gy / det, depth};
      }
    }
  }
  return seen;
}

/// A texture on a mesh: coordinates of the corners, rows downwards.
struct Skin {
  Attributes corners;  // #F·3 × 2
  std::vector<SourceTexture> textures;
  std::vector<int> texture_of;  // a face; empty: the first

  Eigen::Array3f colour(const Seen& pixel) const {
    TextureLine line{{0, 0}, {0, 0}, {0, 0}, 1};
    for (int k = 0; k < 3; ++k) {
      for (int c = 0; c < 2; ++c) {
        const double x = corners(3 * pixel.face + k, c);
        line.first[c] += pixel.weights[k] * x;
        line.step[c] += pixel.right[k] * x;
        line.below[c] += pixel.below[k] * x;
      }
    }
    const int texture = texture_of.empty() ? 0 : texture_of[static_cast<size_t>(pixel.face)];
    float rgba[4];
    sample_texture(textures[static_cast<size_t>(texture)], TextureFilter::Bilinear, line, rgba);
    Eigen::Array3f stored;
    for (int c = 0; c < 3; ++c) {
      stored[c] = std::round(255 * SrgbCurves::get().to_srgb(rgba[c]));
    }
    return stored;
  }
};

struct Comparison {
  double squared = 0;
  long pixels = 0;
  std::vector<double> of_face;
  std::vector<long> pixels_of_face;

  explicit Comparison(size_t faces) : of_face(faces, 0), pixels_of_face(faces, 0) {}

  static double psnr(double error, long count) {
    return 10 * std::log10(255.0 * 255.0 / (error / (3.0 * static_cast<double>(count))));
  }
  double psnr() const { return psnr(squared, pixels); }
  /// Of the faces that are not `left_out`.
  double psnr_without(const std::vector<char>& left_out) const {
    double error = 0;
    long count = 0;
    for (size_t f = 0; f < of_face.size(); ++f) {
      if (left_out[f]) continue;
      error += of_face[f];
      count += pixels_of_face[f];
    }
    return psnr(error, count);
  }
};

/// The faces of the chart at whose vertices the mesh's own texture coordinates disagree: where two
/// pieces of its atlas meet, colours may jump, and no image of texels on both sides can.
std::vector<char> at_seams(const Skin& own, const SphericalChart& chart) {
  std::vector<Eigen::Index> first(static_cast<size_t>(chart.points.rows()), -1);
  std::vector<char> seam(first.size(), 0), faces;
  const auto vertex = [&](Face f, int k) { return static_cast<size_t>(chart.triangles(f, k)); };
  for (Face f = 0; f < chart.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      Eigen::Index& corner = first[vertex(f, k)];
      if (corner < 0) corner = 3 * f + k;
      if ((own.corners.row(corner) - own.corners.row(3 * f + k)).norm() > 1e-6) {
        seam[vertex(f, k)] = 1;
      }
    }
  }
  for (Face f = 0; f < chart.triangles.rows(); ++f) {
    faces.push_back(seam[vertex(f, 0)] || seam[vertex(f, 1)] || seam[vertex(f, 2)]);
  }
  return faces;
}

void compare(const std::vector<Seen>& seen, const Skin& one, const Skin& other, Comparison& sum) {
  for (const Seen& pixel : seen) {
    if (pixel.face < 0) continue;
    const double error =
        static_cast<double>((one.colour(pixel) - other.colour(pixel)).square().sum());
    sum.squared += error;
    sum.of_face[static_cast<size_t>(pixel.face)] += error;
    ++sum.pixels_of_face[static_cast<size_t>(pixel.face)];
    ++sum.pixels;
  }
}

void write_picture(const std::string& path, const std::vector<Seen>& seen, const Skin& skin) {
  Image image(picture_size, picture_size, 3);
  for (size_t i = 0; i < seen.size(); ++i) {
    if (seen[i].face < 0) continue;
    const Eigen::Array3f colour = skin.colour(seen[i]) / 255;
    // Rows go upwards in the camera, downwards in the picture.
    const size_t row = picture_size - 1 - i / picture_size, column = i % picture_size;
    std::copy_n(colour.data(), 3, &image.pixels[3 * (row * picture_size + column)]);
  }
  write_image(path, image);
}

std::unique_ptr<BakeScene> read_scene(const std::string& mesh, const std::string& texture) {
  MeshFile file = prepare_for_mapping(read_mesh(mesh));
  SphereMap map = parameterize(file.mesh).map;
  const MappedMesh mapped({.file = std::move(file), .map = std::move(map)});
  std::vector<SourceTexture> textures;
  if (texture.empty()) {
    textures = read_textures(mapped.file(), 0);
  } else {
    textures = {read_texture(mapped.file(), texture, TextureWrap::Repeat, 0)};
  }
  return std::unique_ptr<BakeScene>(new BakeScene{
      {mapped, shading_normals(mapped.file()), textures}, make_target(mapped, true, 0), {}, 0});
}

Skin own_skin(const BakeScene& scene) {
  const MeshFile& file = scene.source.file();
  const SphericalChart& chart = scene.target.chart;
  Skin skin{carry_corner_attribute(chart, file.mesh.triangles, texcoords_of(file).value()),
            scene.source.textures,
            {}};
  skin.corners.col(1) = 1 - skin.corners.col(1).array();
  if (const Property* material = file.find_face_property("material");
      material && !scene.source.one_texture_for_all) {
    for (const Face f : chart.source_faces) {
      skin.texture_of.push_back(static_cast<int>(material->values[static_cast<size_t>(f)]));
    }
  }
  return skin;
}

/// The baked image as a file of 8 bits would have it.
Image bake_image(const BakeScene& scene, int width) {
  Image image(width, width / 2, 3);
  const SurfaceField field = make_base_colour(scene, "");
  const std::vector<SurfaceField> fields = {field};
  bake(scene, fields, {.width = width, .height = width / 2},
       [&](size_t, int first_row, int rows, const float* values) {
         for (int i = 0; i < rows * width; ++i) {
           for (int c = 0; c < 3; ++c) {
             image.pixels[3 * (static_cast<size_t>(first_row) * static_cast<size_t>(width) +
                               static_cast<size_t>(i)) +
                          static_cast<size_t>(c)] =
                 std::round(255 * SrgbCurves::get().to_srgb(values[i * field.channels + c])) / 255;
           }
         }
       });
  return image;
}

Skin baked_skin(const BakeScene& scene, int width) {
  const SphericalChart& chart = scene.target.chart;
  Skin skin;
  skin.corners.resize(chart.wedges.size(), 2);
  for (Face f = 0; f < chart.wedges.rows(); ++f) {
    for (int k = 0; k < 3; ++k) skin.corners.row(3 * f + k) = chart.uv.row(chart.wedges(f, k));
  }
  skin.textures = {{.image = std::make_shared<const TexturePyramid>(bake_image(scene, width)),
                    .wrap_s = TextureWrap::Repeat,
                    .wrap_t = TextureWrap::Clamp}};
  return skin;
}

/// The area of a face's triangle in a texture.
double area_in(const Skin& skin, size_t f) {
  const auto row = static_cast<Eigen::Index>(3 * f);
  const Eigen::RowVector2d a = skin.corners.row(row + 1) - skin.corners.row(row),
                           b = skin.corners.row(row + 2) - skin.corners.row(row);
  return std::abs(a[0] * b[1] - a[1] * b[0]) / 2;
}

/// A texture sampled once more, by so many texels.
SourceTexture resampled(const SourceTexture& texture, int width, int height) {
  Image image(width, height, 3);
  SourceTexture plain = texture;
  plain.factor = {1, 1, 1, 1};
  std::vector<float> row(4 * static_cast<size_t>(width));
  for (int y = 0; y < height; ++y) {
    sample_texture(plain, TextureFilter::Bilinear,
                   {{0.5 / width, (y + 0.5) / height}, {1.0 / width, 0}, {0, 1.0 / height}, width},
                   row.data());
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        image.pixel(x, y)[c] =
            std::round(255 * SrgbCurves::get().to_srgb(row[static_cast<size_t>(4 * x + c)])) / 255;
      }
    }
  }
  SourceTexture result = texture;
  result.image = std::make_shared<const TexturePyramid>(image);
  return result;
}

/// The own textures resampled once, each triangle at the density that it has in the baked image, to
/// half an octave; `evenly`: as many texels, but the same density everywhere.
Skin resampled(const Skin& own, const Skin& baked, int size, bool evenly) {
  constexpr int most = 4096;  // beyond, nothing more is lost
  const double texels = 0.5 * size * size;
  const auto faces = static_cast<size_t>(own.corners.rows() / 3);
  double used = 0;
  for (size_t f = 0; f < faces; ++f) used += area_in(own, f);
  Skin skin{own.corners, {}, {}};
  std::map<std::pair<int, int>, int> known;
  for (size_t f = 0; f < faces; ++f) {
    const double share = evenly ? 1 / used : area_in(baked, f) / std::max(area_in(own, f), 1e-12);
    const int octave = static_cast<int>(std::lround(2 * std::log2(std::sqrt(texels * share) + 1)));
    const int texture = own.texture_of.empty() ? 0 : own.texture_of[f];
    const auto [at, is_new] = known.try_emplace({texture, octave}, static_cast<int>(known.size()));
    if (is_new) {
      const SourceTexture& source = own.textures[static_cast<size_t>(texture)];
      if (!source.image) {
        skin.textures.push_back(source);
        skin.texture_of.push_back(at->second);
        continue;
      }
      const double across = std::exp2(octave / 2.0);
      const auto& finest = source.image->levels().front();
      const double aspect = std::sqrt(static_cast<double>(finest.width) / finest.height);
      const auto side = [&](double x) { return std::clamp(static_cast<int>(x), 1, most); };
      skin.textures.push_back(resampled(source, side(across * aspect), side(across / aspect)));
    }
    skin.texture_of.push_back(at->second);
  }
  return skin;
}

void name_costly(const BakeScene& scene, const Comparison& comparison) {
  std::vector<size_t> order(comparison.of_face.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::sort(order, std::greater{}, [&](size_t f) { return comparison.of_face[f]; });
  std::printf("  triangles that cost most (of the chart; of the source; share of the error):\n");
  for (size_t i = 0; i < std::min<size_t>(8, order.size()); ++i) {
    std::printf(
        "    %7zu %7d  %5.2f %%  %s\n", order[i], scene.target.chart.source_faces[order[i]],
        100 * comparison.of_face[order[i]] / comparison.squared,
        scene.target.chart.pole_corner(static_cast<Face>(order[i])) >= 0 ? "at a pole" : "");
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::string mesh, texture, pictures;
  int size = 4096;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--size" && i + 1 < argc) {
      size = std::atoi(argv[++i]);
    } else if (word == "--pictures" && i + 1 < argc) {
      pictures = argv[++i];
    } else {
      (mesh.empty() ? mesh : texture) = word;
    }
  }
  if (mesh.empty() || size < 2) {
    std::fprintf(stderr, "bake_fidelity MESH [TEXTURE] [--size N] [--pictures FOLDER]\n");
    return 2;
  }
  const auto scene = read_scene(mesh, texture);
  const Skin own = own_skin(*scene), baked = baked_skin(*scene, size);
  const Skin evenly = resampled(own, baked, size, true), again = resampled(own, baked, size, false);
  const auto faces = static_cast<size_t>(scene->target.chart.triangles.rows());
  Comparison bake_loss(faces), even_loss(faces), again_loss(faces);
  for (int view = 0; view < view_count; ++view) {
    const std::vector<Seen> seen =
        see(scene->target.chart.triangles, scene->target.positions, view);
    compare(seen, own, baked, bake_loss);
    compare(seen, own, evenly, even_loss);
    compare(seen, own, again, again_loss);
    if (pictures.empty()) continue;
    const std::string number = std::to_string(view);
    write_picture(pictures + "/own_" + number + ".png", seen, own);
    write_picture(pictures + "/baked_" + number + ".png", seen, baked);
  }
  std::printf("%s, %d × %d, %ld pixels in %d views\n", mesh.c_str(), size, size / 2,
              bake_loss.pixels, view_count);
  const std::vector<char> seams = at_seams(own, scene->target.chart);
  const auto line = [&](const char* what, const Comparison& loss) {
    std::printf("  %-44s %6.2f dB, without seams of the atlas %6.2f dB\n", what, loss.psnr(),
                loss.psnr_without(seams));
  };
  line("baked", bake_loss);
  line("texture resampled, density of the bake", again_loss);
  line("texture resampled, as many texels, evenly", even_loss);
  name_costly(*scene, bake_loss);
}
