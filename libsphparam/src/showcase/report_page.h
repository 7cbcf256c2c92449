#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/pictures.h"
#include "report/viewer.h"
#include "showcase/page_entry.h"
#include "sphparam/progress.h"
#include "sphparam/report/report_page.h"
#include "texture/source_texture.h"

namespace sphparam {

struct ReportOptions {
  std::optional<ViewerScript> viewer = std::nullopt;  // none: pictures only
  bool viewer_is_missing = false;                     // the program has none; the page says so
  PictureOptions look = {.size = 640};                // of pictures
  UprightAxes up = upright_axes({});                  // as models stand
  int image_width = 1024;                             // of textures and heat maps
  MeshTextures textures = {};                         // of the mesh
  std::vector<std::pair<std::string, std::string>> facts = {};  // program, command line, …
  int threads = 0;
  Progress progress = {};
};

/// The same from what a user says. Throws: ImageError for a texture of the file.
ReportOptions report_options(const MeshFile& file, const PageOptions& options);

/// One page that shows maps of a mesh and needs nothing else: models that change into their
/// spheres, heat maps, the paper's polar charts, histograms, tables, provenance. Several maps stand
/// side by side, their charts on the same scale; those that fold are shown as pictures. Where there
/// are no models, there is a picture of the mesh and one of each sphere, in the mesh's own colours.
/// Ensures: loads nothing from anywhere; same bytes for the same input and any number of threads,
/// but for times. Throws: ImageError; Cancelled; FieldError.
/// Requires: at least one page_entry, each with a map.
std::string report_page(const std::string& name, const MeshFile& file,
                        const std::vector<PageEntry>& entries, const ReportOptions& options = {});

}  // namespace sphparam
