#pragma once

#include "console/console.h"
#include "sphparam/io/mesh_source.h"

namespace sphparam::cli {

/// Says what the file carries and the mesh file does not, a line each. Every command whose outputs
/// carry what a mesh carries calls it.
void tell_losses(const MeshSource& source, Console& console);
/// The notes that are not told unasked.
std::vector<std::string> quiet_notes(const std::vector<std::string>& notes);
/// That, and in detail what else reading it noted.
void tell_notes(const MeshSource& source, Console& console);
/// What vertices have, and is no map, under the names that a map's have, which replace it.
void add_replaced(std::vector<std::string>& losses, const MeshFile& file);
/// Says that of a mesh whose map is written on.
void tell_replaced(const MeshSource& source, Console& console);
/// Says, where vertices are asked for by their numbers, that these are not rows of the file
/// (`other_numbers_note`), if so.
void tell_other_numbers(const MeshSource& source, Console& console);
/// The losses among the notes of a reader, and how rough coordinates are, as a warning.
void tell_losses_of_reading(const std::string& path, const std::vector<std::string>& notes,
                            Console& console);

/// The same of a file that was written: what its format has no place for.
void tell_losses(const std::string& path, const std::vector<std::string>& losses, Console& console);

}  // namespace sphparam::cli
