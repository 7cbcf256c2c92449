// One surface onto another.

#include <pybind11/stl.h>

#include <algorithm>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "sphparam/correspondence/likeness.h"
#include "sphparam/correspondence/match.h"
#include "sphparam/correspondence/matched_files.h"
#include "sphparam/correspondence/surface_map.h"
#include "sphparam/gltf/morph.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/names.h"

namespace sphparam::python {
namespace {

using Pairs = std::vector<std::pair<long, long>>;

Vertex vertex_of(const FileNumbers& numbers, long number, const char* whose) {
  const Vertex vertex = numbers.vertex(number);
  if (vertex < 0) throw NoSuchVertex(whose, numbers.absence(number));
  return vertex;
}

std::vector<LandmarkPair> landmarks_of(const Pairs& pairs, const MappedMesh& from,
                                       const MappedMesh& to) {
  const FileNumbers of_from(from.file()), of_to(to.file());
  std::vector<LandmarkPair> landmarks;
  for (const auto& [a, b] : pairs)
    landmarks.push_back(
        {vertex_of(of_from, a, "landmarks, source"), vertex_of(of_to, b, "landmarks, target")});
  return landmarks;
}

MatchOptions options_of(const py::dict& values) {
  MatchOptions options;
  Settings settings(values);
  settings
      .take("energy", options.energy.kind,
            by_name({EnergyKind::SymmetricDirichlet, EnergyKind::AngleAndArea}))
      .take("lambda", options.energy.lambda)
      .take("search", options.search)
      .take("alike", options.alike)
      .take("threads", options.threads);
  settings.require_all_known();
  return options;
}

std::optional<MatchFeatures> features_of(const std::optional<py::tuple>& features) {
  if (!features) return std::nullopt;
  const auto table = [](const py::object& rows) {
    const auto values = py::cast<py::array_t<double, py::array::c_style>>(rows);
    Functions result(values.shape(0), values.shape(1));
    std::copy(values.data(), values.data() + values.size(), result.data());
    return result;
  };
  return MatchFeatures{table((*features)[0]), table((*features)[1]), (*features)[2].cast<double>()};
}

/// The first map as it was moved, the least energy, what it came from, radians of the landmarks,
/// confidence, correlation of features, warnings. `features`: of both, and their weight.
py::tuple match(const Mapped& from, const Mapped& to, const Pairs& pairs,
                const std::optional<py::tuple>& features, bool mirror, const py::dict& values,
                const py::object& progress) {
  MatchOptions wanted = options_of(values);
  wanted.features = features_of(features);
  Match found = call(progress, [=, from = from, to = to](const Progress& report) {
    MatchOptions options = wanted;
    options.progress = report;
    const MappedMesh first = mirror ? mirror_image(from.mesh(), options.threads) : from.mesh();
    options.landmarks = landmarks_of(pairs, first, to.mesh());
    return match_surfaces(first, to.mesh(), options);
  });
  return py::make_tuple(Mapped(found.map.from()), found.energy, found.made_by,
                        owning(std::move(found.residuals)), found.confidence, found.agreement,
                        as_texts(found.warnings));
}

/// The first one's mesh on the second one's sphere, and what is worth a warning of it.
py::tuple like(const Mapped& mesh, const Mapped& other, int threads, const py::object& progress) {
  constexpr double nearly_all = 0.99;
  const Likeness found = call(progress, [=, mesh = mesh, other = other](const Progress& report) {
    return map_like(mesh.mesh(), other.mesh(), {.threads = threads, .progress = report});
  });
  std::vector<std::string> warnings;
  if (found.in_place < nearly_all) warnings.push_back(to_text(found));
  return py::make_tuple(Mapped(found.mapped), as_texts(warnings));
}

py::dict matched_distortion(const Mapped& from, const Mapped& to, int threads) {
  return as_dict(call(py::none(), [=, from = from, to = to](const Progress&) {
    return summarise_distortion(SurfaceMap(from.mesh(), to.mesh()), threads);
  }));
}

Placement placement_of(const std::string& word) {
  if (word == "scaled") return Placement::Scaled;
  if (word == "moved") return Placement::Moved;
  if (word == "as-is") return Placement::AsItIs;
  throw py::value_error("place: \"scaled\", \"moved\" or \"as-is\" is needed, not \"" + word +
                        "\"");
}

struct MorphRequest {
  Placement placement = Placement::Scaled;
  ExportOptions options;
};

MorphRequest morph_request_of(const py::dict& values) {
  MorphRequest request;
  ExportOptions& options = request.options;
  std::string place = "scaled", up, front;
  Settings settings(values);
  settings.take("place", place)
      .take("up", up)
      .take("front", front)
      .take("image_size", options.look.image_width)
      .take("threads", options.threads);
  settings.require_all_known();
  request.placement = placement_of(place);
  options.up = up_of(up, front);
  return request;
}

/// Writes a .glb; returns warnings.
py::list write_morph(const Mapped& from, const Mapped& to, const FilePath& path,
                     const py::dict& values, const py::object& progress) {
  MorphRequest wanted = morph_request_of(values);
  return as_texts(writing_call(progress, [=, from = from, to = to](const Progress& report) mutable {
    wanted.options.progress = report;
    const Asset asset =
        make_morph(SurfaceMap(from.mesh(), to.mesh()), wanted.placement, wanted.options);
    write_asset(path, asset);
    return asset.warnings;
  }));
}

}  // namespace

void declare_matches(py::module_& module) {
  module.def("match", match);
  module.def("map_like", like);
  module.def("matched_distortion", matched_distortion);
  module.def("write_morph", write_morph);
}

}  // namespace sphparam::python
