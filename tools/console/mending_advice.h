#pragma once

#include "arguments/words.h"
#include "sphparam/io/mesh_source.h"

namespace sphparam::cli {

/// Several lines: what would mend a mesh that this command line was refused for, and how the same
/// command line, its own options and outputs kept, is typed then. words: the subcommand first.
std::string advice_for(const Words& words, const MeshRefusal& refusal);

/// What a file of this command line was refused for as it was read; where that says to mend it
/// (read_options.h), with the file, so that it can be typed.
std::string told_refusal(const Words& words, const std::string& refusal);

}  // namespace sphparam::cli
