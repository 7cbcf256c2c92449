#include "io/attributes/left_out_image.h"

#include "io/attributes/specular_glossiness.h"

namespace sphparam {

void leave_out_image(MaterialTexture& texture, const MaterialChannels& channels) {
  texture.image.clear();
  if (texture.made_of) leave_factors(texture);
  if (&texture == &channels.emission) texture.factor = {0, 0, 0, 1};
}

}  // namespace sphparam
