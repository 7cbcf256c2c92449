// Figures of the library as dictionaries and lists, by the names that Python has for them.

#include <pybind11/stl.h>

#include "arrays.h"
#include "binding.h"
#include "sphparam/names.h"

namespace sphparam::python {
namespace {

/// None of no numbers.
py::object numbers_or_none(const VectorX& values) {
  if (values.size() == 0) return py::none();
  return owning(std::vector<double>(values.begin(), values.end()));
}

py::dict as_dict(const OneSidedDistance& distance) {
  py::dict dict;
  dict["rms"] = distance.rms;
  dict["mean"] = distance.mean;
  dict["max"] = distance.max;
  dict["max_bound"] = distance.max_bound;
  dict["min"] = distance.min;
  dict["samples"] = distance.samples;
  dict["farthest"] =
      py::make_tuple(distance.farthest.x(), distance.farthest.y(), distance.farthest.z());
  dict["sd"] = distance.sd;
  dict["median"] = distance.median;
  dict["p95"] = distance.p95;
  dict["p99"] = distance.p99;
  dict["within"] = distance.within;
  dict["at_vertices"] = numbers_or_none(distance.at_vertices);
  dict["left_out"] = distance.left_out;
  dict["left_out_vertices"] = py::none();
  if (!distance.left_out_vertices.empty()) {
    py::array_t<bool> marks(static_cast<py::ssize_t>(distance.left_out_vertices.size()));
    std::copy(distance.left_out_vertices.begin(), distance.left_out_vertices.end(),
              marks.mutable_data());
    dict["left_out_vertices"] = marks;
  }
  dict["deviation"] = py::none();
  if (const auto& deviation = distance.deviation)
    dict["deviation"] =
        py::make_tuple(deviation->min, deviation->max, deviation->mean, deviation->sd,
                       deviation->median, numbers_or_none(deviation->at_vertices));
  return dict;
}

}  // namespace

py::dict as_dict(const Certificate& certificate) {
  py::dict dict;
  dict["one_to_one"] = certificate.bijective();
  dict["verdict"] = verdict(certificate);
  dict["degree"] = certificate.degree;
  dict["covering"] = certificate.covering;
  dict["reversed"] = certificate.reversed;
  dict["folded"] = owning(std::vector<int>(certificate.folded));
  dict["degenerate"] = owning(std::vector<int>(certificate.degenerate));
  dict["unusable_points"] = owning(std::vector<int>(certificate.unusable_points));
  dict["branch_vertices"] = owning(std::vector<int>(certificate.branch_vertices));
  dict["max_length_error"] = certificate.max_length_error;
  return dict;
}

py::dict as_dict(const SurfaceDistance& distance) {
  py::dict dict;
  dict["rms"] = distance.rms();
  dict["mean"] = distance.mean();
  dict["max"] = distance.max();
  dict["max_bound"] = distance.max_bound();
  dict["p95"] = distance.p95();
  dict["diagonal"] = distance.diagonal_first;
  dict["forth"] = as_dict(distance.forth);
  dict["back"] = as_dict(distance.back);
  return dict;
}

py::dict as_dict(const DistortionSummary& summary) {
  py::dict dict;
  dict["mean_abs_ln_area"] = summary.mean_abs_ln_area;
  dict["mean_abs_ln_angle"] = summary.mean_abs_ln_angle;
  dict["area_within_two"] = summary.area_within_two;
  dict["area_ratio_p01"] = summary.area_ratio_p01;
  dict["area_ratio_p50"] = summary.area_ratio_p50;
  dict["area_ratio_p99"] = summary.area_ratio_p99;
  dict["area_ratio_min"] = summary.area_ratio_min;
  dict["area_ratio_max"] = summary.area_ratio_max;
  dict["angle_ratio_max"] = summary.angle_ratio_max;
  dict["weighted_abs_log2_area"] = summary.weighted_abs_log2_area;
  dict["symmetric_dirichlet"] = summary.symmetric_dirichlet;
  dict["quasi_conformal_mean"] = summary.quasi_conformal_mean;
  dict["quasi_conformal_max"] = summary.quasi_conformal_max;
  dict["stretch_l2"] = summary.stretch_l2;
  dict["stretch_linf"] = summary.stretch_linf;
  dict["flat_images"] = summary.flat_images;
  dict["flat_faces"] = summary.flat_faces;
  return dict;
}

py::list as_list(const std::vector<MeshDefect>& defects) {
  py::list list;
  for (const MeshDefect& defect : defects) {
    list.append(py::make_tuple(name_of(defect.kind), defect.fatal, defect.count,
                               py::tuple(py::cast(defect.elements)), defect.message, defect.hint));
  }
  return list;
}

py::list as_list(const std::vector<RepairAction>& actions) {
  py::list list;
  for (const RepairAction& action : actions) {
    list.append(py::make_tuple(name_of(action.kind), action.count,
                               py::tuple(py::cast(action.elements)), action.message));
  }
  return list;
}

py::list as_list(const std::vector<HandleLoop>& loops) {
  py::list list;
  for (const HandleLoop& loop : loops) {
    Points points(static_cast<Eigen::Index>(loop.points.size()), 3);
    for (std::size_t i = 0; i < loop.points.size(); ++i)
      points.row(static_cast<Eigen::Index>(i)) = loop.points[i];
    list.append(py::make_tuple(loop.filled, loop.length, loop.share, loop.area_added,
                               owning_rows(std::move(points))));
  }
  return list;
}

}  // namespace sphparam::python
