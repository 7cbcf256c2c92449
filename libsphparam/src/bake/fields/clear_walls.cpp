#include "bake/fields/clear_walls.h"

#include <algorithm>

#include "bake/fields/material_fields.h"

namespace sphparam {
namespace {

void add_text(SurfaceField& field, const char* key, const char* value) {
  const bool is_there =
      std::ranges::any_of(field.texts, [&](const auto& text) { return text.first == key; });
  if (!is_there) field.texts.emplace_back(key, value);
}

void add_alpha(SurfaceField& field) {
  field.channels = 4;
  field.evaluate_runs = [colour = std::move(field.evaluate_runs)](std::span<const SurfaceRun> runs,
                                                                  float* values) {
    std::ptrdiff_t count = 0;
    for (const SurfaceRun& run : runs) count += run.count;
    colour(runs, values);
    for (std::ptrdiff_t i = count; i-- > 0;) {  // from the last, in place
      for (std::ptrdiff_t c = 3; c-- > 0;) values[4 * i + c] = values[3 * i + c];
      values[4 * i + 3] = 1;
    }
  };
}

}  // namespace

SurfaceField with_clear_walls(SurfaceField colour) {
  if (!colour.evaluate_runs) return colour;
  if (colour.channels == 3) add_alpha(colour);
  add_text(colour, alpha_text, "mask 0.5");
  add_text(colour, sides_text, "1");
  colour.clear_walls = true;
  return colour;
}

}  // namespace sphparam
