#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/mesh/self_crossings.h"
#include "sphparam/wrap/wrap.h"

namespace sphparam {

/// A surface that was wrapped about a soup. References are to values that outlive the record.
struct WrapRecord {
  std::string input;
  const MeshFile& soup;
  const Wrap& wrap;
  std::vector<std::pair<std::string, std::string>> outputs = {};  // what it is, where it is
  double seconds = 0;
  std::optional<SelfCrossings> crossings = {};  // of the wrap with itself; nothing: none by method
  double closing_distance = 0;  // of a skin, from where on it encloses more; 0: nowhere
};

/// Those of a wrap whose triangles got fewer, or that was drawn in; nothing of others, which the
/// lattice keeps from crossing. Cost: as `find_self_crossings`.
std::optional<SelfCrossings> crossings_of(const Wrap& wrap, int threads = 0);

/// What there is to say of them. Requires: some cross.
std::string crossings_warning(const SelfCrossings& crossings, const Wrap& wrap);

/// As `sphparam wrap --json` tells it.
std::string to_json(const WrapRecord& record);

/// What may be wrong with it, a line each: triangles that cross; a skin where a larger distance
/// makes a body.
std::vector<std::string> warnings_of(const WrapRecord& record);

/// For people, a line each: what stood in the way of one ball and what became of it, what lies
/// outside, how far the wrap is from the soup, volume and areas, what the soup carried and the wrap
/// does not.
std::vector<std::string> to_lines(const WrapRecord& record);

}  // namespace sphparam
