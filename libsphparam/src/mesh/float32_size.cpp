// Numbers of 32 bits have their 24 of mantissa from 2⁻¹²⁶ on. Where a mesh is 2⁻¹⁰³ long (1e-31),
// what is below that is 2⁻²³ of its length: the rounding of coordinates of one that is 1 long.

#include "mesh/float32_size.h"

#include "mesh/box.h"
#include "number_text.h"
#include "sphparam/errors.h"

namespace sphparam {
namespace {

[[noreturn]] void refuse(const std::string& what, const char* how, double size,
                         const std::string& wanted) {
  throw UnmeasurableMesh(what + ": the mesh is too " + how +
                         " for numbers of 32 bits, its extent is " + short_number(size) +
                         " and not " + wanted + "; scale it");
}

}  // namespace

void require_float32_least(const Points& positions, const std::string& what, double least) {
  const double size = box_of(positions).longest_side();
  if (size > 0 && size < least) refuse(what, "small", size, "at least " + short_number(least));
}

void require_float32_size(const Points& positions, const std::string& what, double least) {
  require_float32_least(positions, what, least);
  const double size = box_of(positions).longest_side(), greatest = 1 / least;
  if (size > greatest) refuse(what, "large", size, "at most " + short_number(greatest));
}

}  // namespace sphparam
