#include "arguments/mesh_names.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "console/exit_codes.h"
#include "number_text.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {
namespace {

std::string writer_of(const std::string& path) {
  constexpr std::array<std::string_view, 4> of_export = {".glb", ".gltf", ".usda", ".usdz"};
  if (std::ranges::count(of_export, extension_of(path)) == 0) return "";
  return ": `sphparam export` writes that, of a mapped mesh";
}

}  // namespace

void require_mesh_name(const std::string& option, const std::string& what, const std::string& path,
                       const Words& more) {
  if (path.empty() || is_stream(path)) return;
  if (std::ranges::find(more, extension_of(path)) != more.end()) return;
  if (!inner_extension_of(path).empty() && is_written(path)) return;
  const std::string others = more.empty() ? "" : joined(more) + ", ";
  throw UsageMistake(option + ": " + what + " is written as " + others + written_extensions() +
                     ", .gz after it for gzip, not as " + output_name(path) + writer_of(path));
}

char table_separator(const std::string& option, const std::string& path) {
  constexpr std::array<std::string_view, 5> others = {".json", ".xlsx", ".xls", ".ods", ".html"};
  const std::string extension = is_stream(path) ? "" : extension_of(path);
  if (std::ranges::count(others, extension) > 0)
    throw UsageMistake(option + ": the table is written as .csv or .tsv, not as " + extension);
  return extension == ".tsv" ? '\t' : ',';
}

}  // namespace sphparam::cli
