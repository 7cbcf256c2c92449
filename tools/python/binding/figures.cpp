// Figures of surfaces: distances, spherical harmonics.

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <set>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "measure/enclosure.h"
#include "number_text.h"
#include "sphere/body_centre.h"
#include "sphparam/io/body_longitudes.h"
#include "sphparam/io/coef_file.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/harmonic_expansion.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/planetocentric.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/measure/alignment.h"
#include "sphparam/measure/coordinates_apart.h"
#include "sphparam/measure/growth.h"
#include "sphparam/measure/surface_distance.h"
#include "sphparam/mesh/fillers.h"
#include "sphparam/records/harmonics_record.h"
#include "sphparam/remesh/resample.h"
#include "sphparam/sphere/radial_directions.h"
#include "sphparam/sphere/sphere_map.h"
#include "sphparam/sphere/spherical_harmonics.h"

namespace sphparam::python {
namespace {

/// As the first of two files stands.
void turn_as(const MeshFile& first, const MeshFile& second, TriangleMesh& second_mesh) {
  second_mesh.positions *=
      upright_rotation(upright_axes(second)).transpose() * upright_rotation(upright_axes(first));
}

py::object as_object(const std::optional<Alignment>& alignment) {
  if (!alignment) return py::none();
  const auto matrix = alignment->motion.matrix();
  py::array_t<double> rows({4, 4});
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k)
      rows.mutable_at(i, k) = matrix[static_cast<size_t>(i)][static_cast<size_t>(k)];
  return py::make_tuple(rows, alignment->motion.scale, name_of(alignment->start), alignment->rms,
                        alignment->kept, alignment->reach, alignment->iterations);
}

/// Are these in one unit and in one system of coordinates? `align` brings together what is not.
std::vector<std::string> doubts_about_coordinates(const TriangleMesh& first,
                                                  const TriangleMesh& second,
                                                  const std::string& align) {
  std::vector<std::string> doubts;
  const auto units = align != "similarity" ? units_apart(first, second) : std::nullopt;
  if (units) {
    const bool first_is_smaller = units->smaller == Side::First;
    doubts.push_back(std::string(first_is_smaller ? "first" : "second") + " is " +
                     short_number(units->ratio, 4) + " times smaller than " +
                     (first_is_smaller ? "second" : "first") +
                     ", and of the same proportions: are both in one unit, not in " + units->units +
                     "?");
  }
  if (const double apart = align == "none" ? far_apart(first, second) : 0; apart > 0)
    doubts.push_back("first and second are " + short_number(apart, 4) +
                     " from one another, farther than either is large: has one been moved, as a "
                     "global shift of coordinates does? align=\"rigid\" first puts the second onto "
                     "the first");
  return doubts;
}

/// `align`: "none", "rigid" or "similarity".
py::dict measure(const Source& first, const Source& second, std::int64_t samples,
                 std::uint64_t seed, const std::set<std::string>& over, bool extremes,
                 bool deviations, const std::optional<double>& within, bool upright,
                 const std::string& align, bool leave_out_border, int threads,
                 const py::object& progress) try {
  using Mesh = std::shared_ptr<TriangleMesh>;
  // What closes holes is no surface.
  const auto surface = [](const MeshFile& file) {
    return std::make_shared<TriangleMesh>(surface_of(file.mesh, fillers_of(file)));
  };
  const Mesh one = surface(first.mesh.file), other = surface(second.mesh.file);
  if (upright) turn_as(first.mesh.file, second.mesh.file, *other);
  const std::vector<std::string> doubts = doubts_about_coordinates(*one, *other, align);
  std::optional<Alignment> alignment;
  const SurfaceDistance found = call(progress, [=, &alignment, &second](const Progress& report) {
    if (align != "none") {
      alignment = align_surfaces(
          *one, *other,
          {.scale = align == "similarity", .seed = seed, .threads = threads, .progress = report});
      other->positions = moved(std::move(other->positions), alignment->motion);
    }
    const Triangles& whole = second.mesh.file.mesh.triangles;
    const bool encloses = whole.rows() > other->face_count() && unclosed_edges(whole) == 0;
    const TriangleMesh enclosing{encloses ? other->positions : Points(), whole};
    return measure_distance(*one, *other,
                            {.samples = samples,
                             .seed = seed,
                             .faces = over.contains("faces"),
                             .edges = over.contains("edges"),
                             .vertices = over.contains("vertices"),
                             .extremes = extremes,
                             .deviations = deviations,
                             .enclosing = encloses ? &enclosing : nullptr,
                             .within = within,
                             .leave_out_borders = leave_out_border,
                             .threads = threads,
                             .progress = report});
  });
  py::dict dict = as_dict(found);
  dict["alignment"] = as_object(alignment);
  dict["warnings"] = doubts;
  return dict;
} catch (const UnmeasurableSurface& error) {
  throw py::value_error((error.side() == Side::First ? "first: " : "second: ") +
                        std::string(error.what()));
}

/// Of faces, and of vertices. Fillers are faces as others are.
py::tuple growth(const Source& first, const Source& second) {
  const TriangleMesh &one = first.mesh.file.mesh, &other = second.mesh.file.mesh;
  const Growth found = measure_growth(one, other);
  const auto list = [](const VectorX& values) {
    return owning(std::vector<double>(values.begin(), values.end()));
  };
  return py::make_tuple(list(found.faces), list(found.vertices));
}

/// What is wrong with a radius about this centre, over the longitudes that the map has.
std::vector<std::string> doubts_about_radius(const MappedMesh& mapped, const Vector3& centre,
                                             int threads) {
  std::vector<std::string> lines = {line_of_outside(mapped.mesh(), centre)};
  if (std::string off = longitudes_off(mapped, centre, false, threads); !off.empty())
    lines.push_back("the longitudes of these harmonics are the map's, not the body's: " + off);
  std::erase(lines, "");
  return lines;
}

Functions table_of(const py::array_t<double, py::array::c_style>& coefficients) {
  Functions table(coefficients.shape(0), coefficients.shape(1));
  std::copy(coefficients.data(), coefficients.data() + coefficients.size(), table.data());
  return table;
}

/// What Python knows of harmonics, wherever they come from. It keeps them whole for files.
py::dict as_dict(Expansion&& expansion) {
  const HarmonicExpansion& found = expansion.harmonics;
  const Functions& coefficients = found.fit.coefficients;
  const Vector3 axes = found.degree() > 0 ? first_order_ellipsoid(coefficients.leftCols<3>())
                                          : Vector3(Vector3::Zero());
  py::dict dict;
  dict["functions"] = found.functions;
  dict["ellipsoid"] = py::make_tuple(axes.x(), axes.y(), axes.z());
  dict["centre"] = py::none();
  if (found.radius_about)
    dict["centre"] =
        py::make_tuple(found.radius_about->x(), found.radius_about->y(), found.radius_about->z());
  dict["aligned"] = found.aligned != HarmonicAlignment::None;
  dict["power"] = owning_rows(power_per_degree(coefficients));
  dict["values"] = owning_rows(found.values);
  dict["coefficients"] = owning_rows(coefficients);
  dict["expansion"] = std::move(expansion);
  return dict;
}

HarmonicAlignment alignment_named(const std::string& word) {
  if (word.empty()) return HarmonicAlignment::None;
  return word == "sphere" ? HarmonicAlignment::Sphere : HarmonicAlignment::SphereAndSurface;
}

/// `turned`: "", "sphere" or "surface", which is both; `flips`: coefficients of a template.
/// `radius`: expanded too, from `centre`, else as the map says what its centre is.
py::dict expand(const Mapped& mapped, int degree, const std::vector<std::string>& scalars,
                bool least_squares, const std::string& turned,
                const std::optional<py::array_t<double, py::array::c_style>>& flips, bool radius,
                const std::optional<std::array<double, 3>>& given, int threads,
                const py::object& progress) {
  std::optional<Vector3> centre, from;
  std::optional<Functions> half_turns;
  if (flips) half_turns = table_of(*flips);
  const HarmonicAlignment alignment = alignment_named(turned);
  if (given) from = Vector3(given->data());
  if (radius) centre = body_centre(planetocentric(mapped.mesh().provenance()), from);
  HarmonicExpansion found = call(progress, [=, mesh = mapped.mesh()](const Progress& report) {
    HarmonicExpansion expansion = expand_in_harmonics(
        mesh, scalars,
        {.degree = degree, .least_squares = least_squares, .threads = threads, .progress = report},
        centre);
    align(expansion, mesh, alignment, half_turns ? &*half_turns : nullptr, threads);
    return expansion;
  });
  std::vector<std::string> doubts;
  if (centre) doubts = doubts_about_radius(mapped.mesh(), *centre, threads);
  if (found.alignment)
    std::ranges::copy(doubts_about(*found.alignment), std::back_inserter(doubts));
  if (found.fit.quadrature_change.value_or(0) > settled_quadrature)
    doubts.emplace_back("the integral has not settled with the most nodes that there are");
  const int decided = found.fit.decided_degree.value_or(degree);
  if (found.fit.decided_degree)
    doubts.push_back(undecided_line(found) + "; degree=" + std::to_string(decided) +
                     " leaves it out, least_squares=False is the integral");
  if (const std::string line = decided_change_line(found); !line.empty())
    doubts.back() += "; " + line;
  const double rms = found.position_rms(), plain_rms = found.plain_position_rms(),
               diagonal = found.diagonal;
  py::dict dict =
      as_dict(Expansion{std::move(found), mapped.mesh().name(), mapped.mesh().provenance()});
  dict["rms"] = rms;
  dict["plain_rms"] = plain_rms;
  dict["diagonal"] = diagonal;
  dict["decided_degree"] = decided;
  dict["doubts"] = doubts;
  return dict;
}

py::array evaluate(const py::array_t<double, py::array::c_style>& coefficients,
                   const py::array& rows, int threads) {
  bool finite = true;
  const Points directions = normalised(points_of(rows, finite)).points;
  return owning_rows(call(py::none(), [=, table = table_of(coefficients)](const Progress&) {
    return synthesise(table, directions, threads);
  }));
}

py::dict read(const FilePath& path) {
  HarmonicExpansion found =
      call(py::none(), [path](const Progress&) { return read_harmonics(path); });
  found.values.resize(0, found.fit.coefficients.cols());  // there are no vertices
  Provenance map = found.map;
  return as_dict(Expansion{std::move(found), path, std::move(map)});
}

/// In the format of the name.
std::string text_of(const HarmonicExpansion& harmonics, const Expansion& expansion,
                    const std::string& path) {
  const std::string kind = extension_of(path);
  if (kind == ".csv") return to_csv(harmonics);
  if (kind == ".coef") return to_coef(harmonics.fit.coefficients);
  return to_json(harmonics, expansion.mesh, expansion.map);
}

void write(const Expansion& expansion, const py::array_t<double, py::array::c_style>& coefficients,
           const FilePath& path, bool geodetic) {
  HarmonicExpansion harmonics = with_coefficients(expansion, coefficients);
  harmonics.normalisation =
      geodetic ? HarmonicNormalisation::FourPi : HarmonicNormalisation::Orthonormal;
  writing_call(py::none(), [=](const Progress&) {
    PendingFiles files;
    files.add(path, text_of(harmonics, expansion, path));
    files.publish();
    return true;
  });
}

/// A table of the PDS.
void write_shadr(const FilePath& path, const py::array_t<double, py::array::c_style>& radius) {
  HarmonicExpansion expansion;
  expansion.functions = {"radius"};
  expansion.fit.coefficients.resize(radius.size(), 1);
  std::copy(radius.data(), radius.data() + radius.size(), expansion.fit.coefficients.data());
  writing_call(py::none(), [path, text = to_shadr(expansion)](const Progress&) {
    PendingFiles files;
    files.add(path, text);
    files.publish();
    return true;
  });
}

}  // namespace

HarmonicExpansion with_coefficients(const Expansion& expansion,
                                    const py::array_t<double, py::array::c_style>& coefficients) {
  HarmonicExpansion harmonics = expansion.harmonics;
  Functions table = table_of(coefficients);
  const Functions& before = harmonics.fit.coefficients;
  if (table.cols() != before.cols())
    throw py::value_error("coefficients: " + std::to_string(before.cols()) +
                          " columns are needed, one a function");
  power_per_degree(table);  // which throws unless there are (L + 1)² rows
  if (table.rows() == before.rows() && table == before) return harmonics;
  harmonics.fit = {.coefficients = std::move(table), .rms = {}};
  harmonics.values.resize(0, harmonics.fit.coefficients.cols());
  harmonics.plain_rms.resize(0);
  return harmonics;
}

void declare_figures(py::module_& module) {
  py::class_<Expansion>(module, "Expansion", "A surface in harmonics, for files.");
  module.def("measure", measure);
  module.def("growth", growth);
  module.def("expand", expand);
  module.def("evaluate", evaluate);
  module.def("write_shadr", write_shadr);
  module.def("read_harmonics", read);
  module.def("write_harmonics", write);
}

}  // namespace sphparam::python
