// An asset's whole way, from its file to a folder of what it became.

#include <pybind11/stl.h>

#include "binding.h"
#include "call.h"
#include "sphparam/asset/remake_asset.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/paths.h"
#include "sphparam/version.h"

namespace sphparam::python {
namespace {

RemakeOptions options_of(const py::dict& values) {
  RemakeOptions options;
  std::string up, front;
  Settings settings(values);
  settings.take("size", options.width)
      .take("samples", options.samples)
      .take("occlusion", options.occlusion)
      .take("triangles", options.whole.faces)
      .take("resolution", options.whole.resolution)
      .take("least_kept", options.whole.least_kept)
      .take("compress", options.compress)
      .take("up", up)
      .take("front", front)
      .take("page", options.page)
      .take("threads", options.whole.threads);
  take_textures(settings, options.textures, options.webp_quality);
  settings.require_all_known();
  options.up = up_of(up, front);
  options.facts = {{"program", std::string("sphparam ") + version}};
  return options;
}

struct Made {
  MeshSource asset;
  RemadeAsset remade;
};

Made make(const std::string& path, const std::string& folder, const RemakeOptions& options) {
  ReadOptions lenient;
  lenient.repeated_corners = lenient.non_finite = true;
  MeshSource asset = read_source(path, lenient);
  PendingFiles files;
  RemadeAsset remade = remake_asset(asset, folder, options, files);
  files.publish();
  return {std::move(asset), std::move(remade)};
}

py::object projection_of(const std::optional<ProjectionShares>& shares) {
  if (!shares) return py::none();
  py::dict dict;
  dict["back"] = shares->back;
  dict["nearest"] = shares->nearest;
  dict["median"] = shares->median;
  dict["farthest"] = shares->farthest;
  return dict;
}

py::dict as_dict(const Made& made) {
  const RemadeAsset& remade = made.remade;
  py::dict images, dict, seconds;
  for (const BakedImage& image : remade.baked.images)
    images[image.field.c_str()] = FilePath(image.path);
  for (const auto& [stage, time] : remade.seconds) seconds[stage.c_str()] = time;
  py::list files;
  for (const auto& [name, size] : remade.files) files.append(FilePath(name));
  dict["map"] = Mapped(remade.whole.mapped);
  dict["surface"] = word_of(remade.whole.by);
  dict["area_kept"] = remade.whole.area_kept;
  dict["found"] = as_texts(remade.whole.found);
  dict["done"] = as_texts(remade.whole.done);
  dict["details"] = as_texts(remade.whole.details);
  dict["images"] = images;
  dict["projection"] = projection_of(remade.baked.projection);
  dict["files"] = files;
  dict["warnings"] = as_texts(remade.warnings);
  dict["losses"] = as_texts(losses_among(made.asset.notes));
  dict["seconds"] = seconds;
  return dict;
}

py::dict asset(const FilePath& path, const FilePath& folder, const py::dict& values,
               const py::object& progress) {
  const RemakeOptions wanted = options_of(values);
  return as_dict(writing_call(progress, [wanted, path, folder](const Progress& report) {
    RemakeOptions options = wanted;
    options.whole.progress = report;
    return make(path, folder, options);
  }));
}

}  // namespace

void declare_assets(py::module_& module) {
  module.def("asset", asset);
  module.def("asset_folder",
             [](const FilePath& path) { return FilePath(stem_of(path) + "_sphere"); });
}

}  // namespace sphparam::python
