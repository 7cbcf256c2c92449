#include "arguments/mesh_names.h"

#include <algorithm>

#include "console/exit_codes.h"
#include "number_text.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {

void require_mesh_name(const std::string& option, const std::string& what, const std::string& path,
                       const Words& more) {
  if (path.empty() || is_stream(path)) return;
  if (std::ranges::find(more, extension_of(path)) != more.end()) return;
  if (!inner_extension_of(path).empty() && is_written(path)) return;
  const std::string others = more.empty() ? "" : joined(more) + ", ";
  throw UsageMistake(option + ": " + what + " is written as " + others + written_extensions() +
                     ", .gz after it for gzip, not as " + output_name(path));
}

}  // namespace sphparam::cli
