#pragma once

#include <string>
#include <vector>

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

/// The mesh mended, with the inspection of what it is then; `repairs`, `parts` and `notes` say what
/// was done, by the numbers of the file.
/// Throws: UsageMistake when there is no such component; MeshRefusal where it cannot be mapped even
/// then.
Source repaired(Source source, const RepairOptions& options);

/// What `--repair` would do to a mesh, tried out: alone; where that is not enough, with the
/// component and the holes that it does not take unasked.
struct RepairTrial {
  std::string further;                // " --component 1 --max-hole 1055"; empty: nothing further
  std::vector<RepairAction> actions;  // by the numbers of the file
  std::vector<MeshDefect> remaining;  // those that stand in the way even then
  KeptParts parts;                    // those that can be chosen from; so numbered too
  bool can_mend() const { return remaining.empty(); }
  bool mends() const { return can_mend() && further.empty(); }  // --repair alone
};
RepairTrial try_repair(const Source& source);

/// Several lines for people: what it would do and what to type, or that it cannot help and why.
std::string words_of(const RepairTrial& trial, const std::string& path);

/// "kept 99.7 % of the area and 98 % of the faces, lost 0.3 % and 2 %"; empty where no component
/// was dropped.
std::string line_of(const KeptParts& parts);

/// Throws MeshRefusal unless the mesh can be mapped. Only then is a repair tried out.
void require_mappable(const Source& source);

}  // namespace sphparam::tools
