#include "gltf/export_domain.h"

#include <stdexcept>

#include "option_domain.h"

namespace sphparam {
namespace {

constexpr int least_width = 16, greatest_width = 16384;  // of images that are made here
constexpr int quarters = 4;                              // conventions are turned by these

void require_chart_domain(const ExportOptions& options) {
  require_one_of("convention", options.convention, Convention::Blender);
  require_between("refine_poles", options.refine_poles, 1, 1024);
}

}  // namespace

void require_look_domain(const ExportOptions& options) {
  const LookOptions& look = options.look;
  require_chart_domain(options);
  require_between("image_width", look.image_width, least_width, greatest_width);
  if (look.image_width % quarters != 0)
    refuse_option("image_width", look.image_width, "a multiple of 4");
  require_one_of("textures", look.textures, TextureFormat::WebpLossless);
  require_between("webp_quality", look.webp_quality, 1, 100);
}

void require_export_domain(const ExportOptions& options) {
  require_chart_domain(options);
  require_one_of("shape", options.shape, ShapeKind::Flat);
  require_one_of("morph", options.morph, Morph::Flat);
  if (options.morph != Morph::None && options.shape != ShapeKind::Mesh)
    throw std::invalid_argument("morph starts from the mesh: shape must be ShapeKind::Mesh");
  if (options.keep_topology && options.refine_poles > 1)
    throw std::invalid_argument("refined poles need new vertices, which keep_topology forbids");
}

}  // namespace sphparam
