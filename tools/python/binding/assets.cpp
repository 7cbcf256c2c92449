// An asset's whole way, from its file to a folder of what it became.

#include <pybind11/stl.h>

#include <filesystem>
#include <stdexcept>

#include "binding.h"
#include "call.h"
#include "sphparam/asset/remake_asset.h"
#include "sphparam/io/creases.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/paths.h"
#include "sphparam/version.h"

namespace sphparam::python {
namespace {

namespace fs = std::filesystem;

struct Wanted {
  RemakeOptions options;
  std::optional<double> crease;  // degrees
};

Wanted wanted_of(const py::dict& values) {
  Wanted wanted;
  RemakeOptions& options = wanted.options;
  std::string up, front;
  Settings settings(values);
  settings.take("size", options.width)
      .take("samples", options.samples)
      .take("occlusion", options.occlusion)
      .take("clear_walls", options.clear_walls)
      .take("triangles", options.whole.faces)
      .take("resolution", options.whole.resolution)
      .take("least_kept", options.whole.least_kept)
      .take("compress", options.compress)
      .take("crease", wanted.crease)
      .take("up", up)
      .take("front", front)
      .take("page", options.page)
      .take("threads", options.whole.threads);
  take_textures(settings, options.textures, options.webp_quality);
  settings.require_all_known();
  options.up = up_of(up, front);
  options.facts = {{"program", std::string("sphparam ") + version}};
  return wanted;
}

struct Made {
  MeshSource asset;
  RemadeAsset remade;
};

/// The asset's file and those that it names.
std::vector<std::string> files_of(const MeshSource& asset) {
  std::vector<std::string> files = asset.file.companions;
  files.push_back(asset.path);
  const auto add = [&](const MaterialTexture& texture) {
    if (!texture.path.empty()) files.push_back((fs::path(texture.folder) / texture.path).string());
  };
  for (const MaterialTexture& colour : asset.file.base_colours) add(colour);
  for (const MaterialChannels& channels : asset.file.channels)
    for (const MaterialTexture* texture : channels.textures()) add(*texture);
  return files;
}

/// What is made of an asset replaces nothing of it.
void require_others(const std::vector<std::string>& made, const MeshSource& asset) {
  for (const std::string& name : made) {
    for (const std::string& given : files_of(asset)) {
      std::error_code none;  // where one of them is not there
      if (fs::equivalent(name, given, none))
        throw std::invalid_argument(
            "folder: " + name +
            " is of the asset, and would be replaced; another folder is needed");
    }
  }
}

std::vector<std::string> names_of(const WrittenFiles& files) {
  std::vector<std::string> names;
  for (const auto& [name, size] : files) names.push_back(name);
  return names;
}

Made make(const std::string& path, const std::string& folder, const Wanted& wanted) {
  ReadOptions lenient;
  lenient.repeated_corners = lenient.non_finite = true;
  MeshSource asset = read_source(path, lenient);
  const std::string stem = (fs::path(folder) / stem_of(path)).string();
  require_others({stem + ".glb", stem + ".sph.ply", stem + ".html"}, asset);
  const bool has_own = wanted.crease && !add_creases(asset.file, *wanted.crease);
  PendingFiles files;
  RemadeAsset remade = remake_asset(asset, folder, wanted.options, files);
  require_others(names_of(remade.files), asset);
  files.publish();
  if (has_own)
    remade.warnings.emplace_back(
        "the asset has normals of its own, which say what is hard: crease is for others");
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
  dict["wall_share"] = remade.baked.wall_share;
  dict["projection"] = projection_of(remade.baked.projection);
  dict["files"] = files;
  dict["warnings"] = as_texts(remade.warnings);
  std::vector<std::string> losses = losses_among(made.asset.notes);
  losses.insert(losses.end(), remade.losses.begin(), remade.losses.end());
  dict["losses"] = as_texts(losses);
  dict["seconds"] = seconds;
  return dict;
}

py::dict asset(const FilePath& path, const FilePath& folder, const py::dict& values,
               const py::object& progress) {
  const Wanted asked = wanted_of(values);
  return as_dict(writing_call(progress, [asked, path, folder](const Progress& report) {
    Wanted wanted = asked;
    wanted.options.whole.progress = report;
    return make(path, folder, wanted);
  }));
}

}  // namespace

void declare_assets(py::module_& module) {
  module.def("asset", asset);
  module.def("asset_folder",
             [](const FilePath& path) { return FilePath(stem_of(path) + "_sphere"); });
}

}  // namespace sphparam::python
