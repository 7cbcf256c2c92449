#include "commands/lengths.h"

#include "mesh/box.h"
#include "number_text.h"

namespace sphparam::cli {

void scale_by(double factor, MeshFile& file, Session& session) {
  if (factor == 1) return;
  file.mesh.positions *= factor;
  for (MaterialChannels& material : file.channels) {
    material.finish.thickness *= factor;
    material.finish.attenuation_distance *= factor;
  }
  const std::string words = "lengths times " + shortest(factor);
  file.comments.push_back(words);
  session.console.note(words);
}

void tell_size(const TriangleMesh& mesh, Session& session) {
  constexpr double large = 100;
  const double size = longest_side(mesh);
  if (size > large)
    session.console.say("  it is " + short_number(size) +
                        " m long in glTF, whose unit is the metre: --scale 0.001 where the file's "
                        "unit is the millimetre");
}

}  // namespace sphparam::cli
