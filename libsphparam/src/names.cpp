#include "sphparam/names.h"

#include "mesh/repair/repair_kinds.h"
#include "number_text.h"

namespace sphparam {

std::string name_of(Method method) {
  switch (method) {
    case Method::Progressive:
      return "progressive";
    case Method::Curvilinear:
      return "curvilinear";
    case Method::Paper:
      return "paper";
    case Method::Radial:
      return "radial";
  }
  return "";
}

std::string name_of(Balance balance) {
  switch (balance) {
    case Balance::Lambda:
      return "balanced";
    case Balance::Conformal:
      return "conformal";
    case Balance::EqualArea:
      return "equal-area";
  }
  return "";
}

std::string name_of(Quality quality) {
  switch (quality) {
    case Quality::Draft:
      return "draft";
    case Quality::Normal:
      return "normal";
    case Quality::Best:
      return "best";
  }
  return "";
}

std::string name_of(EnergyKind energy) {
  switch (energy) {
    case EnergyKind::AngleAndArea:
      return "angle-and-area";
    case EnergyKind::SymmetricDirichlet:
      return "symmetric-dirichlet";
  }
  return "";
}

std::string name_of(WeightKind weights) {
  switch (weights) {
    case WeightKind::Cotangent:
      return "cotangent";
    case WeightKind::MeanValue:
      return "mean-value";
    case WeightKind::SymmetricMeanValue:
      return "symmetric-mean-value";
  }
  return "";
}

std::string name_of(DefectKind kind) {
  switch (kind) {
    case DefectKind::Empty:
      return "empty";
    case DefectKind::IndexOutOfRange:
      return "index-out-of-range";
    case DefectKind::NonFinitePosition:
      return "non-finite-position";
    case DefectKind::RepeatedVertex:
      return "repeated-vertex";
    case DefectKind::DuplicateFace:
      return "duplicate-face";
    case DefectKind::BoundaryEdge:
      return "boundary-edge";
    case DefectKind::NonManifoldEdge:
      return "non-manifold-edge";
    case DefectKind::InconsistentOrientation:
      return "inconsistent-orientation";
    case DefectKind::NonManifoldVertex:
      return "non-manifold-vertex";
    case DefectKind::SeveralComponents:
      return "several-components";
    case DefectKind::WrongGenus:
      return "wrong-genus";
    case DefectKind::UnusedVertex:
      return "unused-vertex";
    case DefectKind::ZeroAreaFace:
      return "zero-area-face";
    case DefectKind::CoincidentVertices:
      return "coincident-vertices";
    case DefectKind::InsideOut:
      return "inside-out";
  }
  return "";
}

std::string name_of(RepairKind kind) { return info_of(kind).name; }

std::string name_of(HandleChoice choice) {
  switch (choice) {
    case HandleChoice::Shortest:
      return "shortest";
    case HandleChoice::Cut:
      return "cut";
    case HandleChoice::Fill:
      return "fill";
    case HandleChoice::Area:
      return "area";
  }
  return "";
}

std::string options_line(const ParameterizeOptions& options) {
  const PaperSettings& paper = options.paper;
  const std::string lambda = "--lambda " + shortest(options.energy.lambda);
  if (options.method == Method::Curvilinear) return lambda;
  if (options.method == Method::Radial) {
    const Vector3& c = options.centre;
    return lambda + " --centre " + shortest(c.x()) + "," + shortest(c.y()) + "," + shortest(c.z());
  }
  if (options.method == Method::Progressive) {
    const std::string rest =
        "--quality " + name_of(options.quality) + " --energy " + name_of(options.energy.kind);
    if (options.energy.kind == EnergyKind::SymmetricDirichlet) return rest;  // it has no weight
    const bool given = options.balance == Balance::Lambda;  // else it follows from the balance
    return (given ? lambda + " " : "") + "--balance " + name_of(options.balance) + " " + rest;
  }
  return "--weights " + name_of(paper.weights) + " --epsilon " + shortest(paper.epsilon) +
         " --iterations " + std::to_string(paper.iterations) + " --rings " +
         std::to_string(paper.rings) + " --sweeps " + std::to_string(paper.sweeps) +
         (options.repair_paper ? " --repair-map" : "");
}

const std::vector<RepairSwitch>& repair_switches() {
  static const std::vector<RepairSwitch> all = {{"non-finite", &RepairOptions::non_finite},
                                                {"duplicates", &RepairOptions::duplicates},
                                                {"cracks", &RepairOptions::cracks},
                                                {"orientation", &RepairOptions::orientation},
                                                {"non-manifold", &RepairOptions::non_manifold},
                                                {"components", &RepairOptions::components},
                                                {"holes", &RepairOptions::holes},
                                                {"handles", &RepairOptions::handles},
                                                {"flat-faces", &RepairOptions::flat_faces},
                                                {"unused", &RepairOptions::unused}};
  return all;
}

std::vector<std::string> names_of(const RepairOptions& options) {
  std::vector<std::string> names;
  for (const RepairSwitch& repair : repair_switches()) {
    if (options.*repair.wanted) names.emplace_back(repair.name);
  }
  return names;
}

std::string options_line(const RepairOptions& options) {
  std::string line = "--repair";
  if (options.component > 0) line += " --component " + std::to_string(options.component);
  if (options.weld_length >= 0) {
    line += " --weld " + shortest(options.weld_length);
  } else if (options.weld_share >= 0) {
    line += " --weld " + short_number(100 * options.weld_share, 6) + "%";
  }
  if (options.keep_holes) {
    line += " --keep-holes";
  } else if (options.largest_hole != RepairOptions{}.largest_hole) {
    line += " --max-hole " + std::to_string(options.largest_hole);
  }
  if (options.handle_choice != HandleChoice::Shortest) {
    line += " --handles " + name_of(options.handle_choice);
  }
  if (options.longest_handle_length > 0) {
    line += " --max-handle " + shortest(options.longest_handle_length);
  } else if (options.longest_handle != RepairOptions{}.longest_handle) {
    line += " --max-handle " + short_number(100 * options.longest_handle, 6) + "%";
  }
  if (options.edge_length > 0) {
    line += " --max-edge " + shortest(options.edge_length);
  } else if (options.edge_share > 0) {
    line += " --max-edge " + short_number(100 * options.edge_share, 6) + "%";
  }
  return line;
}

}  // namespace sphparam
