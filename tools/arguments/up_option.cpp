#include "arguments/up_option.h"

#include <CLI/CLI.hpp>

#include "arguments/choice.h"

namespace sphparam::cli {

void add_up(CLI::App& command, UpAxis& up) {
  add_choice<UpAxis>(
      command, "--up", up, {{"auto", UpAxis::Automatic}, {"z", UpAxis::Z}, {"y", UpAxis::Y}},
      "The axis of the mesh that points up (default: y where it comes from glTF, else z)");
}

Up up_of(UpAxis asked, const MeshFile& file) {
  if (asked == UpAxis::Automatic) return up_axis(file);
  return asked == UpAxis::Y ? Up::Y : Up::Z;
}

}  // namespace sphparam::cli
