// Meshes on grids of the sphere: resampled, fitted, displaced.

#include <pybind11/stl.h>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "number_text.h"
#include "sphparam/io/fillers.h"
#include "sphparam/mesh/fillers.h"
#include "sphparam/mesh/vertex_areas.h"
#include "sphparam/remesh/adaptation.h"
#include "sphparam/remesh/displacement.h"
#include "sphparam/remesh/faces_in_space.h"
#include "sphparam/remesh/harmonic_surface.h"
#include "sphparam/remesh/levels_of_detail.h"
#include "sphparam/remesh/remesh.h"
#include "sphparam/remesh/sphere_grid.h"
#include "sphparam/remesh/subdivision.h"
#include "sphparam/remesh/texture_layout.h"
#include "texts.h"

namespace sphparam::python {
namespace {

/// A surface fitted to a mesh, and what is needed to use it.
struct Fitted {
  MappedMesh source;
  Remeshed control;
  SubdivisionFit fit;
};

struct GridRequest {
  std::string name;  // "ico:6"; empty: the rays of `like`
  std::optional<MappedMesh> like = {};
};

GridRequest request_of(const py::object& grid) {
  if (py::isinstance<py::str>(grid)) {
    const auto name = py::cast<std::string>(grid);
    try {
      parse_grid(name);  // its mistakes are told before any work
    } catch (const std::invalid_argument& error) {
      throw py::value_error("grid: '" + name + "': " + error.what());
    }
    return {name};
  }
  return {"", py::cast<const Mapped&>(grid).mesh()};
}

SphereGrid grid_of(const GridRequest& request, int threads) {
  if (request.like) {
    SphereGrid grid = sphparam::grid_of(*request.like);
    grid.name = "like:" + request.like->name();
    return grid;
  }
  SphereGrid grid = make_grid(parse_grid(request.name), {.threads = threads});
  grid.name = request.name;
  return grid;
}

/// How large an image in the layout of a grid is, if nobody says.
constexpr std::int64_t usual_texels = std::int64_t{4096} * 2048;

/// Whether "grid" rather than "mesh" is asked for. Refuses it of a grid that has no layout.
bool is_of_grid(const std::string& word, const GridRequest& request, const char* argument) {
  if (word == "mesh") return false;
  const std::string name = argument;
  if (word != "grid") throw py::value_error(name + ": expected mesh or grid, not '" + word + "'");
  if (request.like || !has_texture_layout(parse_grid(request.name)))
    throw py::value_error(name + ": this grid has no layout of its own");
  return true;
}

struct RemeshRequest {
  RemeshOptions options;
  bool adaptive = false;
  std::optional<double> within = {};  // so far, on ico:L of a level that is sought
  std::string texture = "mesh";       // whose coordinates: "mesh" or "grid"
};

VectorX as_vector(const py::array_t<double, py::array::forcecast>& values) {
  VectorX result(values.size());
  for (py::ssize_t i = 0; i < values.size(); ++i) result[i] = values.at(i);
  return result;
}

RemeshRequest remesh_request_of(const py::dict& values) {
  RemeshRequest request;
  RemeshOptions& options = request.options;
  py::array_t<double, py::array::forcecast> source_areas(0), grid_areas(0);
  Settings settings(values);
  settings
      .take("sample", options.sample,
            by_name({SampleMode::Point, SampleMode::Cell, SampleMode::Barycentric,
                     SampleMode::AdapBaryArea}))
      .take("transfer", options.transfer)
      .take("source_areas", source_areas)
      .take("grid_areas", grid_areas)
      .take("adaptive", request.adaptive)
      .take("within", request.within)
      .take("uv", request.texture)
      .take("threads", options.threads);
  settings.require_all_known();
  options.source_areas = as_vector(source_areas);
  options.grid_areas = as_vector(grid_areas);
  return request;
}

void require_areas_of(const RemeshOptions& options, const MappedMesh& source,
                      const SphereGrid& grid) {
  const auto require = [](const VectorX& areas, Eigen::Index vertices, const std::string& of) {
    if (areas.size() == 0 || areas.size() == vertices) return;
    throw std::invalid_argument("areas: " + std::to_string(vertices) +
                                " are needed, one a vertex of " + of + ", not " +
                                std::to_string(areas.size()));
  };
  require(options.source_areas, source.mesh().vertex_count(), "the mesh");
  require(options.grid_areas, grid.directions.rows(), "the grid");
}

/// The grid that is near enough; what there is to say where none is.
std::string seek_grid(GridRequest& onto, const MappedMesh& source, double most,
                      const RemeshOptions& options) {
  const GridWithin found = coarsest_grid_within(
      source, most,
      {.sample = options.sample, .threads = options.threads, .progress = options.progress});
  onto.name = name_of(found.grid);
  if (found.holds()) return "";
  return onto.name + ": at most " + short_number(found.max) +
         " from the mesh, either way, more than " + short_number(most) +
         ": no finer grid is looked at";
}

py::dict as_dict(const FacesInSpace& found) {
  py::dict dict;
  dict["triangles"] = found.faces;
  dict["area_share"] = found.area_share;
  dict["turned_over"] = found.turned_over;
  dict["concave_quads"] = found.concave_quads;
  dict["crossings"] = found.crossings.pairs;
  dict["all_looked_at"] = found.crossings.all;
  dict["crossings_of_mesh"] = found.source_pairs;
  return dict;
}

/// What was made, how its faces lie in space, and what there is to say of that.
struct Seen {
  MappedMesh made;
  FacesInSpace found;
  std::vector<std::string> warnings;
};

Seen seen(MappedMesh made, const MappedMesh& source, int threads, const Progress& report) {
  FacesInSpace found = faces_in_space(
      source, made, {.most_looks = usual_looks, .threads = threads, .progress = report});
  std::vector<std::string> warnings;
  if (std::string warning = warning_of(found, source, made); !warning.empty())
    warnings.push_back(std::move(warning));
  return {std::move(made), std::move(found), std::move(warnings)};
}

/// The map, its figures in space and warnings.
py::tuple as_tuple(const Seen& seen) {
  return py::make_tuple(Mapped(seen.made), as_dict(seen.found), as_texts(seen.warnings));
}

py::tuple remesh_on(const Mapped& mapped, const py::object& grid, const py::dict& values,
                    const py::object& progress) {
  const RemeshRequest wanted = remesh_request_of(values);
  const GridRequest onto = wanted.within ? GridRequest{"ico:0"} : request_of(grid);
  const bool own_texture = is_of_grid(wanted.texture, onto, "uv");
  const Seen result = call(progress, [=, source = mapped.mesh()](const Progress& report) mutable {
    RemeshOptions options = wanted.options;
    options.progress = report;
    const int threads = options.threads;
    GridRequest chosen = onto;
    std::string too_far;
    if (wanted.within) too_far = seek_grid(chosen, source, *wanted.within, options);
    SphereGrid made = grid_of(chosen, threads);
    require_areas_of(options, source, made);
    if (wanted.adaptive) {
      source = adapt_map(source, made.directions.rows(), {.threads = threads, .progress = report})
                   .mapped;
    }
    Remeshed found = remesh(source, std::move(made), options);
    if (own_texture)
      found = with_grid_texture(found, texture_layout(found.spec().value(), usual_texels), threads);
    Seen result = seen(std::move(found), source, threads, report);
    if (!too_far.empty()) result.warnings.insert(result.warnings.begin(), too_far);
    return result;
  });
  return as_tuple(result);
}

Mapped surface_of_harmonics(const Expansion& expansion,
                            const py::array_t<double, py::array::c_style>& coefficients,
                            const py::object& grid, int threads) {
  const GridRequest request = request_of(grid);
  return call(py::none(),
              [=, harmonics = with_coefficients(expansion, coefficients)](const Progress&) {
                return Mapped(harmonic_surface(harmonics, grid_of(request, threads), threads));
              });
}

/// Of each as of a remesh.
py::list levels(const Mapped& mapped, int count, int threads, const py::object& progress) {
  const auto made = call(progress, [=, source = mapped.mesh()](const Progress& report) {
    std::vector<Seen> all;
    for (MappedMesh& mesh :
         quartered_meshes(source, count, {.threads = threads, .progress = report}))
      all.push_back(seen(std::move(mesh), source, threads, report));
    return all;
  });
  py::list list;
  for (const Seen& level : made) list.append(as_tuple(level));
  return list;
}

/// Of every vertex, without what closes holes.
py::array areas_of(const Source& source) {
  const MeshFile& file = source.mesh.file;
  const VectorX areas = vertex_areas(surface_of(file.mesh, fillers_of(file)));
  return owning(std::vector<double>(areas.begin(), areas.end()));
}

std::unique_ptr<Fitted> fit(const Mapped& mapped, const py::object& grid, const std::string& scheme,
                            const std::vector<std::string>& transfer, int threads,
                            const py::object& progress) {
  const GridRequest request = request_of(grid);
  const Scheme surface = chosen(scheme, by_name({Scheme::Loop, Scheme::CatmullClark}), "scheme");
  return call(progress, [=, source = mapped.mesh()](const Progress& report) {
    const SubdivisionFitOptions options{.scheme = surface, .threads = threads, .progress = report};
    const SphereGrid made = grid_of(request, threads);
    SubdivisionFit found = fit_subdivision(source, made, options);
    const Remeshed flat =
        remesh(source, made, {.transfer = transfer, .threads = threads, .progress = report});
    compare_with_flat(found, source, flat, options);
    Remeshed control = control_mesh(flat, found, threads);
    return std::make_unique<Fitted>(Fitted{source, std::move(control), std::move(found)});
  });
}

py::dict as_dict(const WrittenDisplacement& written) {
  py::dict dict;
  dict["least"] = written.figures.least;
  dict["greatest"] = written.figures.greatest;
  dict["missed"] = written.figures.missed;
  dict["size"] = py::make_tuple(written.width, written.height);
  dict["scale"] = written.scale;
  dict["midlevel"] = written.midlevel;
  dict["levels"] = py::none();
  if (written.layout) dict["levels"] = written.layout->levels;
  dict["rebuilt_rms"] = py::none();
  dict["base_rms"] = py::none();
  if (written.proof) {
    dict["rebuilt_rms"] = written.proof->rebuilt.rms;
    dict["base_rms"] = written.proof->base.rms;
  }
  return dict;
}

void require_layout(const Fitted& fitted) {
  if (!fitted.control.spec() || !has_texture_layout(*fitted.control.spec()))
    throw py::value_error("layout: the grid of this fit has no layout of its own");
}

Mapped textured_control(const Fitted& fitted, int width, int height, int threads) {
  require_layout(fitted);
  const auto held = std::make_shared<const Fitted>(fitted);
  return call(py::none(), [=](const Progress&) {
    const TextureLayout layout =
        texture_layout(held->control.spec().value(), std::int64_t{width} * height);
    return Mapped(with_grid_texture(held->control, layout, threads));
  });
}

/// What is written besides the image, and how.
struct DisplaceRequest {
  DisplacementFiles files;
  DisplacementOptions options;
};

DisplaceRequest displace_request_of(const FilePath& path, const py::dict& values) {
  DisplaceRequest request{.files = {.image = path}};
  DisplacementOptions& options = request.options;
  Settings settings(values);
  settings.take_path("rebuilt", request.files.rebuilt)
      .take("depth", request.files.depth,
            {{"half", ImageDepth::Half},
             {"float", ImageDepth::Float},
             {"uint16", ImageDepth::Uint16}})
      .take("layout", options.layout,
            {{"equirectangular", DisplacementLayout::Equirectangular},
             {"grid", DisplacementLayout::Grid}})
      .take("width", options.width)
      .take("height", options.height)
      .take("threads", options.threads);
  settings.require_all_known();
  return request;
}

py::dict displace(const Fitted& fitted, const FilePath& path, const py::dict& values,
                  const py::object& progress) {
  const DisplaceRequest wanted = displace_request_of(path, values);
  if (wanted.options.layout == DisplacementLayout::Grid) require_layout(fitted);
  const auto held = std::make_shared<const Fitted>(fitted);
  return as_dict(writing_call(progress, [=](const Progress& report) {
    DisplacementOptions options = wanted.options;
    options.progress = report;
    PendingFiles pending;
    const WrittenDisplacement written =
        add_displacement(pending, wanted.files, held->source, held->control, held->fit, options);
    pending.publish();
    return written;
  }));
}

py::array limit_vertices(const Fitted& fitted, int threads) {
  const auto held = std::make_shared<const Fitted>(fitted);
  return owning_rows(call(py::none(), [=](const Progress&) {
    return Points(limit_mesh(held->control, held->fit, threads).mesh().positions);
  }));
}

py::tuple fine_mesh(const Fitted& fitted, std::int64_t pieces, int threads) {
  const auto held = std::make_shared<const Fitted>(fitted);
  TriangleMesh mesh = call(py::none(), [=](const Progress&) {
    return fine_limit_mesh(held->fit, held->control.faces(), pieces, threads);
  });
  return py::make_tuple(owning_rows(std::move(mesh.positions)),
                        owning_rows(std::move(mesh.triangles)));
}

}  // namespace

void declare_grids(py::module_& module) {
  py::class_<Fitted>(module, "Fitted", "A subdivision surface fitted to a mesh.")
      .def_property_readonly("control", [](const Fitted& self) { return Mapped(self.control); })
      .def_property_readonly("rms", [](const Fitted& self) { return self.fit.rms; })
      .def_property_readonly("max", [](const Fitted& self) { return self.fit.max; })
      .def_property_readonly("two_sided_rms",
                             [](const Fitted& self) { return self.fit.two_sided_rms; })
      .def_property_readonly("flat_rms", [](const Fitted& self) { return self.fit.flat_rms; })
      .def_property_readonly("thin_vertices",
                             [](const Fitted& self) { return self.fit.thin_vertices; });
  module.def("remesh", remesh_on);
  module.def("harmonic_surface", surface_of_harmonics);
  module.def("levels", levels);
  module.def("vertex_areas", areas_of);
  module.def("fit", fit);
  module.def("displace", displace);
  module.def("textured_control", textured_control);
  module.def("limit_vertices", limit_vertices);
  module.def("fine_mesh", fine_mesh);
  module.def("grid_patterns", &grid_patterns);
}

}  // namespace sphparam::python
