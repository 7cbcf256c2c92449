#pragma once

#include <string>
#include <vector>

#include "batch/record.h"

namespace sphparam {

/// The small picture of an item's map, as pictures/ID-HASH.png below the folder of the batch; drawn
/// where it is not there yet. HASH: of the map, so that it is never that of another. Empty where
/// there is no map, or none that can be read. Throws: WriteError. Cost: some 15 ms once.
std::string picture_of(const std::string& folder, const std::string& id,
                       const std::vector<BatchFile>& files);

}  // namespace sphparam
