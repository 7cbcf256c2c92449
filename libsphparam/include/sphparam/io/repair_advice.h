#pragma once

#include <optional>
#include <string>
#include <utility>

#include "sphparam/io/components.h"
#include "sphparam/io/mesh_source.h"

namespace sphparam {

/// `try_repair` where repairs were wanted that are not enough: the component, the kind of hole, the
/// weld and the kind of handle that were chosen stay so. A weld that nobody chose is tried where
/// pieces are so near that they belong together, and where it spares much of what else would be put
/// in or dropped. Throws: NoSuchComponent.
RepairTrial try_repair_beyond(const MeshSource& source, const RepairOptions& wanted);

/// What repair does unasked, and what it makes: none where that is not enough.
struct UnaskedRepair {
  RepairTrial trial;
  std::optional<MeshSource> mended;  // a closed surface of genus 0
};

/// No more than what repair does unasked, once: whether that is enough.
UnaskedRepair try_repair_unasked(const MeshSource& source);

/// A weld that `try_repair_beyond` may choose, of a mesh that rounding keeps in pieces, and what it
/// makes: none where no weld makes it whole with no more besides than repair does unasked.
UnaskedRepair try_weld(const MeshSource& source);

/// Whether repair mends the mesh unasked, as its trial may not tell: one that welds may only spare
/// what is put in and dropped otherwise. Cost: then one more repair.
bool mends_unasked(const MeshSource& source, const RepairTrial& trial);

/// "--repair --all-components --max-handle 46.1%": what `map` is given to mend and map each part.
std::string all_components_line(const RepairOptions& options);

/// Of the area, what the mended mesh would have of what was there; nothing where that is all.
std::optional<double> kept_share(const RepairTrial& trial);

/// Whether a wrap about the mesh keeps more than the repair that was tried: all of it.
bool wrap_keeps_more(const RepairTrial& trial);

/// Several lines for people: what repair would do to the mesh of this file and what to type, or
/// that it cannot help and why. `command`: what to type; empty: a plain `sphparam map`. `parts`:
/// where the mesh is in several that must be chosen from.
std::string repair_advice(const RepairTrial& trial, const std::string& path,
                          const std::string& command = "",
                          const std::optional<PartsTrial>& parts = std::nullopt);

/// The same of a mesh that was refused, and what had been done to it before.
std::string repair_advice(const MeshRefusal& refusal, const std::string& command = "");

/// "what was put in is 0.4 % of the area, and has the texture of what is beside it"; empty where
/// repairs put in nothing.
std::string added_line(const MeshSource& source);

/// "--repair --weld 2e-05% puts in and drops 0 % of the area, not 11.1 %: …", as the notes have it;
/// empty where a weld would spare little of what repairs did.
std::string weld_line(const MeshSource& source);

}  // namespace sphparam
