#pragma once

#include <string>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// Who made an asset and on what terms, as glTF says it of itself. Comments keep it, so that it
/// goes with the mesh through every format that has comments.
struct Authorship {
  std::string copyright;  // one line; empty: nothing is said
  std::string extras;  // a JSON object, in one line; empty: none. As Sketchfab has author, license

  bool operator==(const Authorship&) const = default;
};

/// Instead of what the file says already. Requires: `extras` as `plain_extras` makes them.
void note_authorship(MeshFile& file, const Authorship& author);

Authorship noted_authorship(const MeshFile& file);

/// Takes what the other file says, also where that is nothing.
void take_authorship(MeshFile& file, const MeshFile& other);

/// The text where it is a JSON object of at most 64 KiB that is nested no deeper than 32, in one
/// line and without the member `sphparam`, which is ours; else empty, as for an empty object.
std::string plain_extras(const std::string& json);

}  // namespace sphparam
