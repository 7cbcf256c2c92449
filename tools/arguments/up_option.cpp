#include "arguments/up_option.h"

#include <CLI/CLI.hpp>

#include "arguments/choice.h"

namespace sphparam::cli {

void add_up(CLI::App& command, std::optional<Up>& up) {
  add_choice<std::optional<Up>>(
      command, "--up", up, {{"auto", std::nullopt}, {"z", Up::Z}, {"y", Up::Y}},
      "The axis of the mesh that points up (default: y where it comes from glTF, else z)");
}

}  // namespace sphparam::cli
