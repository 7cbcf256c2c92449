#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/methods.h"
#include "report/page.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/distortion.h"

namespace sphparam {

/// One map of a mesh among others, with all that is compared.
struct Entry {
  std::string name;                              // of the method or the file
  std::string source;                            // authors and year; of files: the file's name
  std::optional<double> seconds = std::nullopt;  // wall time of this process; not of files
  int iterations = 0;
  std::string statement = {};  // why it ended, or what is odd about it
  SphereMap map = {};          // unit rays; no rows: there is none
  Certificate certificate = {};
  std::optional<Distortion> distortion = std::nullopt;  // of a map whose points are all usable
  std::optional<DistortionSummary> figures = std::nullopt;
  std::vector<StageRecord> stages = {};

  bool has_map() const { return map.points.rows() > 0; }
};

/// Maps the mesh; of `options`, see `run_method`. Throws: as there.
Entry entry_of_method(AnyMethod method, const TriangleMesh& mesh,
                      const ParameterizeOptions& options);

/// A map made elsewhere: certified as it is, measured on rays of unit length.
/// Requires: one ray a vertex.
Entry entry_of_map(std::string name, std::string source, const TriangleMesh& mesh,
                   const SphereMap& map, int threads);

/// Takes the fillers of the mesh, if it has any, out of the distortion and its figures.
void measure_surface(Entry& entry, const MeshFile& file, int threads);

/// "one-to-one", "12 folds", "degree 2", "no map".
std::string short_verdict(const Entry& entry);

/// All entries of a mesh, a row each: time, folds, degree, verdict, distortion.
PageTable comparison_table(const std::vector<Entry>& entries);

}  // namespace sphparam
