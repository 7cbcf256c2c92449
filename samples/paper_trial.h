#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/entry.h"
#include "sphparam/io/mesh_file.h"

/// The evaluation of "Curvilinear Spherical Parameterization" made again: what is measured.
namespace sphparam::samples {

/// What the paper reports of a model, in the captions of its figures. Two of them are a gargoyle.
struct PaperModel {
  const char* name;            // of the file here
  const char* figures;         // where it is shown
  double thousand_triangles;   // 0: not told
  double seconds;              // 0: not told
  double seconds_hemispheres;  // by the method of its reference [17]; 0: not told
};
const std::vector<PaperModel>& paper_models();

/// A stage of the paper's method as printed.
struct PaperStep {
  std::string name;
  long planar_folds;  // triangles not positive in (θ, ϕ)
  long folds;         // triangles not positive on the sphere
  DistortionSummary figures;
  double patch_angle, patch_area;  // mean |ln ratio| of the triangles around the date line
  SphereMap map;                   // kept only where it is drawn
};

/// The paper's method on a mesh, with automatic poles.
struct PaperSteps {
  std::vector<PaperStep> printed;  // initial, three iterations, smoothing
  std::vector<PaperStep> further;  // initial and ten iterations, without smoothing
  std::vector<Face> patch;         // triangles within five rings of the date line
  Vector3 date_line_middle;        // a point of the mesh there
};

/// Everything that is measured on a mesh.
struct Trial {
  std::string name;
  sphparam::MeshFile file;
  std::vector<sphparam::Entry> entries;  // all methods
  std::optional<PaperSteps> steps;       // nothing where the paper's method does not apply

  const sphparam::Entry& by(const std::string& method) const;
};

/// Runs all of it. Maps and distortions are kept only with `keep_maps`: figures need them, tables
/// do not. Throws: MeshError.
Trial try_mesh(std::string name, sphparam::MeshFile file, bool keep_maps);

}  // namespace sphparam::samples
