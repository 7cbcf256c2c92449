#pragma once

#include <optional>
#include <string>
#include <vector>

#include "arguments/remesh_arguments.h"
#include "sphparam/io/safe_file.h"

namespace sphparam::cli {

/// An image of `what` a vertex has: "position", "normal", "color" or a property.
struct ImageRequest {
  std::string what;
  std::string path;
};
std::vector<ImageRequest> images_asked_for(const RemeshArguments& arguments);

/// Throws UsageMistake: for a grid that is no image (none: a file's), for formats that do not hold
/// the depth.
void check_images(const RemeshArguments& arguments, const std::optional<GridSpec>& spec);

/// Throws UsageMistake for what the mesh has not, or the depth cannot hold.
void add_images(PendingFiles& files, const RemeshArguments& arguments, const GridSpec& spec,
                const Remeshed& result);

}  // namespace sphparam::cli
