#pragma once

#include <optional>
#include <vector>

#include "bake/bake_rows.h"
#include "bake/bake_scene.h"
#include "bake/baked_file.h"
#include "sphparam/bake/bake.h"
#include "texture/test_images.h"

namespace sphparam {

/// An image on its way: what is in it, and how it will be stored.
struct PlannedImage {
  BakeRequest request;
  SurfaceField field;
  std::optional<TestImage> drawn;  // not baked
  BakedFileOptions file;           // but for its metadata
};

/// The field of this name, with coverage where the source has fillers. Throws: FieldError.
SurfaceField make_covered_field(const std::string& name, const BakeScene& scene);

/// Throws: FieldError where the scene has not what the field needs; BakeSettingError where the file
/// cannot hold the field's values.
PlannedImage plan_image(const BakeRequest& request, BakeScene& scene, const BakeSettings& settings);

/// Finds what 0 and 1 of integers stand for where fields cannot say: they are baked for it.
void find_ranges(std::vector<PlannedImage>& images, const BakeScene& scene,
                 const BakeSettings& settings);

/// What floats lose of a field that is far from 0; empty where that is next to nothing.
std::string rounding_line(const SurfaceField& field, const BakeScene& scene);

/// What of the images is not as one might think: numbers that are rounded far from the origin, and
/// those that heat has no colours for.
std::vector<std::string> warnings_of(const std::vector<PlannedImage>& images,
                                     const BakeScene& scene, const BakeSettings& settings);

/// The settings as the engine takes them, its progress told as this stage.
BakeOptions engine_options(const BakeSettings& settings, const char* stage);

}  // namespace sphparam
