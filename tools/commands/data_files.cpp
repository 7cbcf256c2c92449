#include "commands/data_files.h"

#include <stdexcept>

#include "arguments/limits.h"
#include "console/exit_codes.h"
#include "reports/told_losses.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"

namespace sphparam::cli {

namespace {

/// With those of the map, and some to spare.
constexpr std::size_t most_properties = 240;

/// Whoever names a file of the other hemisphere has mistaken it; both have as many vertices on the
/// meshes of templates.
void tell_structures(const MeshFile& file, const std::string& surface, const VertexData& data,
                     const std::string& path, Session& session) {
  const std::string of_surface = structure_of(file, surface);
  if (of_surface.empty() || data.structure.empty() || data.structure == of_surface) return;
  session.console.warning(display_name(path) + " is of " + data.structure + ", and " +
                          display_name(surface) + " is of " + of_surface);
}

Words attach(MeshFile& file, const std::string& surface, const std::string& path,
             MissingValues missing, Session& session) {
  VertexData data = read_vertex_data(path, vertices_of_file(file), input_limits());
  tell_structures(file, surface, data, path, session);
  std::vector<std::string> losses = losses_among(data.notes);
  const std::size_t columns = data.columns.size();
  if (missing != MissingValues::Kept) data = without_missing(std::move(data), losses);
  if (missing == MissingValues::Refused && data.columns.size() < columns)
    throw UsageMistake("--write-data: " + display_name(path) +
                       " has values that are no finite numbers, which meshes, tables and images "
                       "do not hold: write it in a run without those, or with -o NAME.surf.gii");
  for (const std::string& loss : losses)
    session.console.say("  " + display_name(path) + ": " + loss);
  const std::size_t properties = file.vertex_properties.size() + data.columns.size();
  if (missing != MissingValues::Kept && properties > most_properties) {
    throw UsageMistake(
        "--data: " + display_name(path) + " has " + std::to_string(data.columns.size()) +
        " columns, and a mesh file holds " + std::to_string(most_properties) +
        " properties; `sphparam remesh` --data resamples all of them to a .surf.gii");
  }
  try {
    return attach_data(file, data);
  } catch (const std::invalid_argument& error) {
    throw ReadError(path, error.what());
  }
}

}  // namespace

std::vector<std::string> attach_data_files(MeshFile& file, const std::string& surface,
                                           const Words& words, MissingValues missing,
                                           Session& session) {
  const Words files = split_all(words);
  keep_from_outputs(files);
  std::vector<std::string> properties;
  for (const std::string& path : files)
    for (std::string& name : attach(file, surface, path, missing, session))
      properties.push_back(std::move(name));
  return properties;
}

}  // namespace sphparam::cli
