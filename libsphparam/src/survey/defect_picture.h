#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sphparam/io/mesh_source.h"
#include "sphparam/survey/survey.h"

namespace sphparam {

/// A picture that cannot be made here, as there is no image module: of this machine, no mesh is to
/// blame for it.
class PictureError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct DefectPicture {
  std::string png;              // empty where there is nothing to draw
  std::optional<Vector3> from;  // where the eye is; nothing: as `draw_png` has it
};

/// The mesh with its defects red, from the side where most of them are: edges with one face or more
/// than two, the places that the inspection names, the loops about its handles; components beside
/// the largest are orange. Throws: PictureError.
DefectPicture picture_of_defects(const MeshSource& source, const std::vector<HandleLoop>& handles,
                                 const SurveyOptions& options);

/// The mended mesh from there, with red lines about what repair has closed. A PNG, or empty.
/// Throws: PictureError.
std::string picture_of_mended(const MeshFile& file, const std::optional<Vector3>& from,
                              const SurveyOptions& options);

}  // namespace sphparam
