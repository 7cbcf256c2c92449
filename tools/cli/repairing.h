#pragma once

#include <string>

#include "cli/source.h"
#include "sphparam/mesh/mesh_repair.h"

namespace sphparam::tools {

/// A mesh that cannot be mapped, with what the user can do about it, or that nothing can be done.
class MeshRefusal : public MeshError {
 public:
  MeshRefusal(const Source& source, std::string advice);
  const std::string& advice() const { return advice_; }  // several lines

 private:
  std::string advice_;
};

/// The mesh mended, with the inspection of what it is then; `repairs` and `notes` say what was
/// done, by the numbers of the file.
/// Throws: UsageMistake when there is no such component.
Source repaired(Source source, const RepairOptions& options);

/// What `--repair` would do to a mesh, tried out.
struct RepairTrial {
  std::vector<RepairAction> actions;  // by the numbers of the file
  std::vector<MeshDefect> remaining;  // those that stand in the way even then
  bool mends() const { return remaining.empty(); }
};
RepairTrial try_repair(const Source& source);

/// Several lines for people: what it would do, or that it cannot help and why.
std::string words_of(const RepairTrial& trial);

/// Throws MeshRefusal unless the mesh can be mapped. Only then is a repair tried out.
void require_mappable(const Source& source);

}  // namespace sphparam::tools
