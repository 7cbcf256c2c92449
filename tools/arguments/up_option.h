#pragma once

#include "sphparam/io/up_axis.h"

namespace CLI {
class App;
}

namespace sphparam::cli {

enum class UpAxis { Automatic, Z, Y };

/// --up, the same wherever a mesh is drawn or exported.
void add_up(CLI::App& command, UpAxis& up);

/// The axis asked for, else the one that the file says.
Up up_of(UpAxis asked, const MeshFile& file);

}  // namespace sphparam::cli
