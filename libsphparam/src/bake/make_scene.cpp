#include "bake/make_scene.h"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "image/image_codec.h"
#include "io/attributes/hard_edges.h"
#include "io/attributes/shading_normals.h"
#include "io/formats/gltf/gltf_files.h"
#include "sphparam/chart/carry_attributes.h"
#include "sphparam/chart/refine_poles.h"
#include "sphparam/chart/tangent_frame.h"
#include "sphparam/io/paths.h"
#include "texture/texture_pyramid.h"

namespace sphparam {
namespace {

constexpr std::uint64_t most_image_bytes = std::uint64_t{2} << 30;

TextureWrap wrap_of(Wrapping wrapping) {
  if (wrapping == Wrapping::Clamp) return TextureWrap::Clamp;
  return wrapping == Wrapping::Mirror ? TextureWrap::Mirror : TextureWrap::Repeat;
}

std::vector<char> bytes_of(const BaseColour& colour) {
  if (colour.bytes) return *colour.bytes;
  const std::vector<unsigned char> read = read_below(colour.folder, colour.path, most_image_bytes);
  return {read.begin(), read.end()};
}

/// Throws ImageError.
std::shared_ptr<const TexturePyramid> decode(const BaseColour& colour, const std::string& what,
                                             int threads) {
  if (!colour.problem.empty()) throw ImageError(what + ": " + colour.problem);
  std::vector<char> bytes;
  try {
    bytes = bytes_of(colour);
  } catch (const std::runtime_error& error) {
    throw ImageError(what + " cannot be read: " + error.what());
  }
  return std::make_shared<const TexturePyramid>(decode_image(bytes, what), false, threads);
}

}  // namespace

BakeTarget make_target(const MeshFile& file, const Topology& topology, const SphereMap& map,
                       bool is_source, int threads, int pole_wedges, const Progress& progress) {
  BakeTarget target{.chart = spherical_chart(file.mesh, topology, map, threads, progress),
                    .positions = {},
                    .normals = {},
                    .is_source = is_source};
  const Triangles& triangles = file.mesh.triangles;
  if (pole_wedges > 1 && target.chart.certificate.one_to_one())
    target.chart = refine_poles(std::move(target.chart), triangles, pole_wedges, threads);
  target.wedge_normals = split_at_hard_edges(target.chart, file, threads);
  target.positions = carry_vertex_attribute(target.chart, triangles, file.mesh.positions, threads);
  target.normals = carry_normals(target.chart, triangles, shading_normals(file), threads);
  return target;
}

BakeTarget make_target(const MappedMesh& mapped, bool is_source, int threads, int pole_wedges,
                       const Progress& progress) {
  return make_target(mapped.file(), mapped.topology(), mapped.map(), is_source, threads,
                     pole_wedges, progress);
}

BakeSource make_source(const MappedMesh& mapped) {
  return {.mapped = mapped, .normals = shading_normals(mapped.file()), .textures = {}};
}

SourceTexture read_texture(const std::string& path, TextureWrap wrap, int threads) {
  const bool linear = extension_of(path) == ".exr";
  return {.image = std::make_shared<const TexturePyramid>(read_image(path), linear, threads),
          .wrap_s = wrap,
          .wrap_t = wrap};
}

std::vector<SourceTexture> read_textures(const MeshFile& file, int threads) {
  std::vector<SourceTexture> textures;
  std::map<std::string, std::shared_ptr<const TexturePyramid>> decoded;
  for (size_t i = 0; i < file.base_colours.size(); ++i) {
    const BaseColour& colour = file.base_colours[i];
    SourceTexture texture{
        .image = nullptr, .wrap_s = wrap_of(colour.wrap_s), .wrap_t = wrap_of(colour.wrap_t)};
    std::ranges::transform(colour.factor, texture.factor.begin(),
                           [](double x) { return static_cast<float>(x); });
    if (!colour.image.empty()) {
      auto& image = decoded[colour.image];
      const std::string what = "material " + file.materials[i] + ", " + colour.image;
      if (!image) image = decode(colour, what, threads);
      texture.image = image;
    }
    textures.push_back(std::move(texture));
  }
  return textures;
}

}  // namespace sphparam
