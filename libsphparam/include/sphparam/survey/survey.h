#pragma once

#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/progress.h"

namespace sphparam {

/// How far a mesh file comes.
enum class SurveyEnd {
  Maps,          // as it is: its map is certified
  MapsMended,    // after `--repair`, with nothing else asked for
  MapsIfAsked,   // after a repair that takes more than it does unasked: `advice` says which
  CannotMap,     // whatever is repaired: `reasons` say why
  NotCertified,  // it is a closed genus-0 mesh, and its map is not one-to-one
  Unreadable,    // `reasons` says why
};

/// "maps", "maps-mended", …
std::string name_of(SurveyEnd end);

/// What became of one file.
struct SurveyedMesh {
  std::string name;  // its path below the folder
  SurveyEnd end = SurveyEnd::Unreadable;
  std::string format;
  MeshInspection inspection;         // as it was read
  std::vector<std::string> defects;  // that stand in the way of a map as it is
  std::vector<std::string> repairs;  // done, or tried
  std::vector<std::string> reasons;  // why it cannot be mapped even so
  std::string advice;                // options that would mend it: "--repair --component 1"
  std::string picture;               // PNG: the mesh, its defects red; empty: nothing to see
};

struct SurveyOptions {
  int picture_size = 320;  // pixels of a side, 16 to 4096; 0: no pictures
  ReadOptions read = {};
  int threads = 0;  // 0: all cores
  Progress progress = {};
};

struct Survey {
  std::string folder;
  std::vector<SurveyedMesh> meshes;  // by name
  long count(SurveyEnd end) const;
};

/// Tries every mesh file of a folder and the folders in it, told by its name; links to folders are
/// not followed. Each is read, inspected, mended where that is needed, mapped and certified; none
/// is written. A file that stops one step is told with its reason, and the others go on.
/// Throws: ReadError for a folder that cannot be read, or without mesh files; Cancelled.
/// Cost: that of a map each.
Survey survey_folder(const std::string& folder, const SurveyOptions& options = {});

/// The mesh with its defects red, for people to look at: edges with one face or more than two,
/// and the places that the inspection names. Empty where there is no place to show.
std::string picture_of_defects(const MeshFile& file, const MeshInspection& inspection, int size,
                               int threads);

/// A page that needs nothing but itself: what maps, what after repair, what not and why.
std::string survey_page(const Survey& survey);

/// The same as `sphparam survey --json` tells it.
std::string to_json(const Survey& survey, double seconds);

}  // namespace sphparam
