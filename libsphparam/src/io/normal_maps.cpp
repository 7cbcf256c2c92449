// Red is times the first number of the factor, green times the second too.

#include "sphparam/io/normal_maps.h"

namespace sphparam {

long turn_normal_maps_over(MeshFile& file) {
  long turned = 0;
  for (MaterialChannels& said : file.channels) {
    if (said.normal.image.empty()) continue;
    said.normal.factor[1] = -said.normal.factor[1];
    ++turned;
  }
  return turned;
}

}  // namespace sphparam
