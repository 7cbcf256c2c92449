// Shapes beside shapes.

#include <pybind11/stl.h>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "sphparam/group/group.h"
#include "sphparam/names.h"
#include "sphparam/records/group_record.h"
#include "sphparam/remesh/sphere_grid.h"

namespace sphparam::python {
namespace {

GroupOptions options_of(const py::dict& values) {
  GroupOptions options;
  std::string grid = "ico:5";
  Settings settings(values);
  settings
      .take("start", options.start,
            by_name(
                {GroupStart::Ends, GroupStart::Rotation, GroupStart::Ellipsoid, GroupStart::Maps}))
      .take("alike", options.alike)
      .take("mirror", options.mirror)
      .take("hold", options.hold)
      .take("rounds", options.rounds)
      .take("grid", grid)
      .take("scale", options.scale)
      .take("modes", options.modes)
      .take("energy", options.energy.kind,
            by_name({EnergyKind::SymmetricDirichlet, EnergyKind::AngleAndArea}))
      .take("threads", options.threads);
  settings.require_all_known();
  options.grid.reset();
  if (grid != "template") options.grid = parse_grid(grid);
  return options;
}

py::dict member_of(const GroupMember& member) {
  py::dict dict;
  dict["map"] = Mapped(member.mapped);
  dict["size"] = member.size;
  dict["start"] = member.start;
  dict["energy"] = member.energy;
  dict["mirrored"] = member.mirrored;
  dict["confidence"] = member.confidence;
  dict["resampling_rms"] = member.resampling_rms;
  dict["resampling_max"] = member.resampling_max;
  dict["warnings"] = as_texts(member.warnings);
  return dict;
}

/// Of each shape on the mean: n×V.
py::array growths(const Group& group) {
  RowTable<double, Eigen::Dynamic> rows(std::ssize(group.members),
                                        group.mean.mesh().vertex_count());
  for (size_t i = 0; i < group.members.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = growth_from_mean(group, i).vertices.transpose();
  return owning_rows(std::move(rows));
}

/// Tables of one size, one after the other: n×V×3.
py::array stacked(const std::vector<Points>& tables, Eigen::Index rows) {
  std::vector<double> all;
  for (const Points& table : tables)
    all.insert(all.end(), table.data(), table.data() + table.size());
  return owning(std::move(all), {static_cast<py::ssize_t>(tables.size()), rows, 3});
}

py::array rows_of(const MatrixX& matrix) {
  return owning_rows(RowTable<double, Eigen::Dynamic>(matrix));
}

py::array list_of(const VectorX& values) {
  return owning(std::vector<double>(values.begin(), values.end()));
}

/// Name, shapes that have it, mean, deviation.
py::list scalars_of(const Group& group) {
  py::list all;
  for (const GroupScalar& scalar : group.scalars) {
    std::vector<int> shapes(scalar.shapes.begin(), scalar.shapes.end());
    all.append(py::make_tuple(as_text(scalar.name), owning(std::move(shapes)), list_of(scalar.mean),
                              list_of(scalar.deviation)));
  }
  return all;
}

py::dict as_dict(Group&& group) {
  const Eigen::Index count = group.mean.mesh().vertex_count();
  py::array growth = growths(group);
  py::list members;
  std::vector<Points> aligned;
  for (GroupMember& member : group.members) {
    members.append(member_of(member));
    aligned.push_back(std::move(member.aligned));
  }
  py::dict dict;
  dict["shapes"] = members;
  dict["growth"] = growth;
  dict["scalars"] = scalars_of(group);
  dict["reference"] = Mapped(group.reference);
  dict["mean"] = Mapped(group.mean);
  dict["aligned"] = stacked(aligned, count);
  dict["weights"] = list_of(group.weights);
  dict["deviation"] = list_of(group.deviation);
  dict["normal_deviation"] = list_of(group.normal_deviation);
  dict["distances"] = rows_of(group.distances);
  dict["modes"] = stacked(group.modes.modes, count);
  dict["deviations"] = list_of(group.modes.deviations);
  dict["shares"] = list_of(group.modes.shares);
  dict["scores"] = rows_of(group.modes.scores);
  dict["variance"] = group.modes.variance;
  return dict;
}

py::dict make(const std::vector<Mapped>& shapes, const Mapped& reference, const py::dict& values,
              const py::object& progress) {
  const GroupOptions wanted = options_of(values);
  return as_dict(call(progress, [=](const Progress& report) {
    GroupOptions options = wanted;
    options.progress = report;
    std::vector<MappedMesh> meshes;
    for (const Mapped& shape : shapes) meshes.push_back(shape.mesh());
    return make_group(meshes, reference.mesh(), options);
  }));
}

}  // namespace

void declare_groups(py::module_& module) { module.def("group", make); }

}  // namespace sphparam::python
