#include "commands/data_files.h"

#include <stdexcept>

#include "arguments/limits.h"
#include "console/exit_codes.h"
#include "reports/told_losses.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"

namespace sphparam::cli {

namespace {

/// With those of the map, and some to spare.
constexpr std::size_t most_properties = 240;

/// A FreeSurfer label needs to be told how many vertices there are; where some were welded or
/// dropped on reading, nobody knows.
Eigen::Index vertices_of_file(const MeshSource& source) {
  const bool renumbered = source.file.find_vertex_property("source_vertex") != nullptr;
  return renumbered ? 0 : source.file.mesh.vertex_count();
}

void attach(MeshSource& source, const std::string& path, MissingValues missing, Session& session) {
  VertexData data = read_vertex_data(path, vertices_of_file(source), input_limits());
  std::vector<std::string> losses = losses_among(data.notes);
  const std::size_t columns = data.columns.size();
  if (missing != MissingValues::Kept) data = without_missing(std::move(data), losses);
  if (missing == MissingValues::Refused && data.columns.size() < columns)
    throw UsageMistake("--write-data: " + display_name(path) +
                       " has values that are no finite numbers, which meshes, tables and images "
                       "do not hold: write it in a run without those, or with -o NAME.surf.gii");
  for (const std::string& loss : losses)
    session.console.say("  " + display_name(path) + ": " + loss);
  const std::size_t properties = source.file.vertex_properties.size() + data.columns.size();
  if (missing != MissingValues::Kept && properties > most_properties) {
    throw UsageMistake(
        "--data: " + display_name(path) + " has " + std::to_string(data.columns.size()) +
        " columns, and a mesh file holds " + std::to_string(most_properties) +
        " properties; `sphparam remesh` --data resamples all of them to a .surf.gii");
  }
  try {
    attach_data(source.file, data);
  } catch (const std::invalid_argument& error) {
    throw ReadError(path, error.what());
  }
}

}  // namespace

void attach_data_files(MeshSource& source, const Words& words, MissingValues missing,
                       Session& session) {
  const Words files = split_all(words);
  keep_from_outputs(files);
  for (const std::string& path : files) attach(source, path, missing, session);
}

}  // namespace sphparam::cli
