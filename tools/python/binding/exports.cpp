// Files that other programs show: glTF, USD, textured OBJ and PLY, pages.

#include <pybind11/stl.h>

#include <algorithm>
#include <iterator>

#include "binding.h"
#include "call.h"
#include "sphparam/gltf/export.h"
#include "sphparam/gltf/usd_writer.h"
#include "sphparam/io/paths.h"
#include "sphparam/report/report_page.h"

namespace sphparam::python {
namespace {

/// What is exported, and how the file holds it.
struct ExportRequest {
  ExportOptions options;
  GltfOptions gltf;
};

void take_look(Settings& settings, LookOptions& look) {
  settings.take_path("texture", look.texture)
      .take_path("normal_map", look.normal)
      .take_path("occlusion_map", look.occlusion)
      .take_path("orm_map", look.orm)
      .take_path("emissive_map", look.emissive)
      .take_path("images", look.folder)
      .take("variants", look.variants)
      .take("image_size", look.image_width)
      .take("unlit", look.unlit)
      .take("tangents", look.tangents);
  take_textures(settings, look.textures, look.webp_quality);
}

ExportRequest request_of(const py::dict& values) {
  ExportRequest request;
  ExportOptions& options = request.options;
  Settings settings(values);
  take_look(settings, options.look);
  settings.take("name", options.name)
      .take("refine_poles", options.refine_poles)
      .take("keep_topology", options.keep_topology)
      .take("theta_phi", options.theta_phi)
      .take("source_uv", options.source_uv)
      .take("quantise", options.quantise)
      .take("threads", options.threads)
      .take("compress", request.gltf.compress)
      .take("shape", options.shape,
            {{"mesh", ShapeKind::Mesh}, {"sphere", ShapeKind::Sphere}, {"flat", ShapeKind::Flat}})
      .take("morph", options.morph,
            {{"none", Morph::None}, {"sphere", Morph::Sphere}, {"flat", Morph::Flat}});
  std::string convention = info_of(options.convention).name, up, front;
  std::vector<Mapped> coarser;
  bool embedded = false;
  settings.take("convention", convention)
      .take("up", up)
      .take("front", front)
      .take("levels", coarser)
      .take("embedded", embedded);
  options.convention = convention_of(convention);
  options.up = up_of(up, front);
  for (const Mapped& level : coarser) options.coarser.push_back(level.mesh());
  if (embedded) request.gltf.container = GltfContainer::Embedded;
  // As the program's --compress.
  if (request.gltf.compress && options.shape != ShapeKind::Sphere) options.quantise = true;
  request.gltf.quantise = options.quantise;
  settings.require_all_known();
  return request;
}

/// What was written, and what the user should know.
struct Exported {
  WrittenFiles files;
  std::vector<std::string> warnings;
};

Exported export_mesh(const std::string& path, const MappedMesh& mesh,
                     const ExportRequest& request) {
  const std::string kind = extension_of(path);
  if (kind == ".obj" || kind == ".ply") {
    TexturedFiles written = write_textured_mesh(path, mesh, request.options);
    return {std::move(written.files), std::move(written.warnings)};
  }
  ExportOptions options = request.options;
  options.upward_v = kind == ".usda" || kind == ".usdz";
  options.look.bake_colours = kind == ".usdz";  // telephones show none of vertices
  Asset asset = make_asset(mesh, options);
  PendingFiles files;
  WrittenFiles written = add_asset(files, path, asset, request.gltf);
  files.publish();
  if (options.upward_v) std::ranges::move(beyond_usd(asset), std::back_inserter(asset.warnings));
  return {std::move(written), std::move(asset.warnings)};
}

py::tuple write_export(const Mapped& mapped, const FilePath& path, const py::dict& values,
                       const py::object& progress) {
  ExportRequest request = request_of(values);
  Exported exported =
      writing_call(progress, [=, mesh = mapped.mesh()](const Progress& report) mutable {
        request.options.progress = report;
        return export_mesh(path, mesh, request);
      });
  py::list files;
  for (const auto& [name, size] : exported.files)
    files.append(py::make_tuple(FilePath(name), size));
  return py::make_tuple(files, as_texts(exported.warnings));
}

void write_page(const Mapped& mapped, const FilePath& path, int size, const std::string& up,
                const std::string& front, int threads, const py::object& progress) {
  writing_call(progress, [=, mesh = mapped.mesh()](const Progress& report) {
    PageOptions options{.size = size, .threads = threads, .progress = report};
    options.up = up_of(up, front);
    write_report(path, mesh, options);
    return true;
  });
}

}  // namespace

void take_textures(Settings& settings, TextureFormat& format, int& quality) {
  using enum TextureFormat;
  Choices<TextureFormat> formats;
  for (const TextureFormat choice : {Given, Png, Jpeg, Webp, WebpLossless})
    formats.emplace_back(word_of(choice), choice);
  settings.take("webp_quality", quality).take("textures", format, formats);
}

void declare_exports(py::module_& module) {
  module.def("export", write_export);
  module.def("report", write_page);
}

}  // namespace sphparam::python
