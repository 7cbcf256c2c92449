#pragma once

#include <string>
#include <vector>

#include "sphparam/io/read_options.h"
#include "sphparam/progress.h"

namespace sphparam {

/// How far a mesh file comes.
enum class SurveyEnd {
  Maps,          // as it is: its map is certified
  MapsMended,    // after `--repair`, with nothing else asked for
  MapsIfAsked,   // after a repair that takes more than it does unasked: `ways` say which
  CannotMap,     // whatever is repaired: `reasons` say why
  NotCertified,  // a closed genus-0 mesh can be made of it, but its map is not one-to-one
  Unreadable,    // `reasons` say why
  Stopped,       // it took too long or too much memory, ended the process that tried it, or there
                 // is no image module for its pictures
};

/// "maps", "maps-mended", …
std::string name_of(SurveyEnd end);

/// A picture, and what it shows.
struct SurveyPicture {
  std::string caption, png;
};

/// Options of `map` that a mesh needs, tried out.
struct SurveyedWay {
  std::string options;     // "--repair --component 1"
  bool certified = false;  // it ended with a certified map; of all components, where they are
                           // wanted, but for specks
  std::string told;  // "kept 99.7 % of the area …", "12 of 13 components map; …", or why it is
                     // not certified; may be empty
  double area_share = 1;  // that it keeps of the surface
  /// More is left out than specks.
  bool drops_much() const;
};

/// What became of one file.
struct SurveyedMesh {
  std::string name;  // its path below the folder
  SurveyEnd end = SurveyEnd::Unreadable;
  std::string format;
  long vertices = 0, triangles = 0, components = 0, boundaries = 0;  // as it was read
  long genus = -1;                      // of the one component; −1 where it has no meaning
  std::vector<std::string> defects;     // that stand in the way of a map as it is
  std::vector<std::string> oddities;    // that do not: it is inside out, faces have no area, …
  std::vector<SurveyedWay> ways;        // around them: the first is what `repairs` tell of
  std::vector<std::string> repairs;     // that were done, or tried in vain
  std::vector<std::string> reasons;     // why there is no map even so
  std::vector<SurveyPicture> pictures;  // of its defects, and of the mended mesh
  /// The way to go: of those that are certified the one that keeps most, the first of equals; null
  /// where none is.
  const SurveyedWay* best_way() const;
};

struct SurveyOptions {
  int picture_size = 320;  // pixels of a side, 16 to 4096; 0: no pictures
  ReadOptions read = {};
  /// Each file is tried in a process forked from this one, which must have no other thread then:
  /// whatever ends that process ends nothing else.
  bool isolated = false;
  double longest = 0;        // seconds for a file, where files are isolated; 0: as long as it takes
  std::string records = {};  // a folder that keeps what is found, for the next time; empty: none
  int threads = 0;           // 0: all cores
  Progress progress = {};
};

struct Survey {
  std::string folder;
  std::vector<SurveyedMesh> meshes;  // by name
  long count(SurveyEnd end) const;
};

/// Tries every mesh file of a folder and the folders in it, told by its name; links are followed, a
/// folder is looked into once, and a link to nothing is a file that cannot be read; data of
/// vertices (.shape.gii, .func.gii, .label.gii) are no meshes. Each is read,
/// inspected, mended where that is needed, mapped and certified; none is written. Of open meshes
/// also the way that keeps the holes is tried, and of meshes with several components each as a
/// mesh; what stops one of these two ways is told as that way's. A file that stops one step is told
/// with its reason, and the others go on.
///
/// With `records`, a survey that was stopped or killed goes on where it was: a record is that of a
/// file's bytes and of those beside it that it names, as a glTF its buffers, of its name, of the
/// program's bytes, and of what was asked for. Files that are stopped or cannot be read are tried
/// again.
/// Throws: ReadError for a folder that cannot be read, or without mesh files; WriteError for
/// records that cannot be written; Cancelled; std::invalid_argument for `picture_size` and
/// `longest` out of their domains. Ensures: the same for any number of threads, as long as no file
/// is stopped. Cost: that of a map for each way.
Survey survey_folder(const std::string& folder, const SurveyOptions& options = {});

/// A page that needs nothing but itself: what maps, what after repair, what not and why.
std::string survey_page(const Survey& survey);

/// The same as `sphparam survey --json` tells it, without the pictures.
std::string to_json(const Survey& survey, double seconds);

}  // namespace sphparam
