#pragma once

#include <string>

#include "console/places.h"
#include "console/session.h"
#include "sphparam/io/vertex_place.h"

namespace sphparam::cli {

/// Says how far points of a file are from the vertices that they were taken for; a warning where
/// that is far.
inline void tell_snapped(const std::string& path, const SnappedPoints& snapped, Session& session) {
  const std::string words = snapped.words();
  if (words.empty()) return;
  const std::string line = display_name(path) + ": " + words;
  if (snapped.is_far())
    session.warn({line + ": are they in the coordinates of these meshes?"});
  else
    session.console.say("  " + line);
}

}  // namespace sphparam::cli
