#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "report/page.h"

namespace sphparam {

/// The script that shows glTF models in a page, and its licence. It is somebody else's,
/// `@google/model-viewer`, taken from npm when this program was built.
struct ViewerScript {
  std::string code;
  std::string licence;
};

/// The option of CMake that brings it to builds without network, as it is told to people.
inline constexpr char viewer_option[] =
    "-DSPHPARAM_VIEWER=FOLDER (the npm package @google/model-viewer, unpacked)";

/// Where it belongs: ../share/sphparam as seen from the program, so that it moves with it.
/// Empty where nobody can tell where the program is.
std::string viewer_folder();

/// Nothing where it is not there. Throws: ReadError.
std::optional<ViewerScript> installed_viewer();

/// What a page without it says; `is_missing`: it was wanted.
std::string words_without_viewer(bool is_missing);

/// A model to be looked at.
struct ViewedModel {
  std::string name;     // below it; may be empty
  std::string alt;      // for those who do not see it
  std::string glb;      // the bytes of the file; empty: only the picture can be shown
  std::string picture;  // of the model, PNG, for when it is not shown (yet)
};

/// What is painted on the models: a variant of their materials, and the words for it.
struct ViewedSurface {
  std::string variant;
  std::string label;
};

/// What a model is before it morphs and after, in words for people.
struct MorphEnds {
  std::string from = "Mesh", to = "Sphere";
};

struct ViewerOptions {
  MorphEnds ends = {};
  bool turns = false;  // slowly, until it is touched, unless the user wants less motion
  /// A picture that is dropped on a model, or chosen, is shown on it as its base colour.
  bool takes_pictures = false;
};

/// Models side by side that turn and morph together: a slider from one end to the other, which
/// sets the time of the animation that `write_gltf` makes of the first morph target, and a choice
/// of surfaces, all by keyboard too. Nothing moves before it is asked to, but what `turns`.
/// Without `script`, or in a browser without scripts or WebGL, their pictures are shown.
void add_viewer(Page& page, const std::vector<ViewedModel>& models,
                const std::vector<ViewedSurface>& surfaces,
                const std::optional<ViewerScript>& script, const ViewerOptions& options = {});

}  // namespace sphparam
