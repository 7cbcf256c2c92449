#include "cli/wording.h"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "compare/methods.h"

namespace sphparam::tools {

namespace {

constexpr size_t ids_shown = 10;  // the JSON lists them all

/// "3 folded faces: 4, 17, 18"
std::string ids_line(const std::string& what, const std::vector<int>& ids) {
  if (ids.empty()) return "";
  std::string line = "  " + std::to_string(ids.size()) + " " + what + ": ";
  for (size_t i = 0; i < std::min(ids.size(), ids_shown); ++i) {
    line += (i ? ", " : "") + std::to_string(ids[i]);
  }
  return line + (ids.size() > ids_shown ? ", …\n" : "\n");
}

/// All digits that matter, no more.
std::string shortest(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace

std::string name_of(Method method) { return info_of(method).name; }

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

std::string name_of(RepairKind kind) {
  switch (kind) {
    case RepairKind::InvalidFaceRemoved:
      return "invalid-face-removed";
    case RepairKind::DuplicateFaceRemoved:
      return "duplicate-face-removed";
    case RepairKind::FaceTurned:
      return "face-turned";
    case RepairKind::EdgeSplit:
      return "edge-split";
    case RepairKind::DiagonalTurned:
      return "diagonal-turned";
    case RepairKind::EdgeMidpointAdded:
      return "edge-midpoint-added";
    case RepairKind::VertexSplit:
      return "vertex-split";
    case RepairKind::ComponentDropped:
      return "component-dropped";
    case RepairKind::HoleFilled:
      return "hole-filled";
    case RepairKind::TurnedOutward:
      return "turned-outward";
    case RepairKind::FlatFaceTurned:
      return "flat-face-turned";
    case RepairKind::FlatFaceCollapsed:
      return "flat-face-collapsed";
    case RepairKind::UnusedVertexDropped:
      return "unused-vertex-dropped";
  }
  return "";
}

std::string options_line(const ParameterizeOptions& options) {
  const PaperSettings& paper = options.paper;
  const std::string lambda = "--lambda " + shortest(options.energy.lambda);
  if (options.method == Method::Curvilinear) return lambda;
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

std::string verdict(const Certificate& certificate) {
  if (certificate.bijective()) return "one-to-one";
  if (!certificate.unusable_points.empty()) {
    return "unusable points " + std::to_string(certificate.unusable_points.size());
  }
  if (certificate.fold_count() > 0) return "folded " + std::to_string(certificate.fold_count());
  return "degree " + std::to_string(certificate.degree);
}

std::string complaint(const Certificate& certificate) {
  std::string lines =
      ids_line("points that are not finite, zero or too far", certificate.unusable_points) +
      ids_line("folded faces", certificate.folded) +
      ids_line("faces without area on the sphere", certificate.degenerate) +
      ids_line("vertices whose faces wind more than once", certificate.branch_vertices);
  const bool counted = certificate.unusable_points.empty() && certificate.fold_count() == 0;
  if (counted && certificate.degree != 1) {
    lines += "  the sphere is covered " + std::to_string(certificate.degree) + " times\n";
  }
  return lines;
}

std::string defect_list(const std::vector<MeshDefect>& defects) {
  std::string lines;
  for (const MeshDefect& defect : defects) {
    lines += "  " + defect.message + "\n";
    if (!defect.hint.empty()) lines += "    hint: " + defect.hint + "\n";
  }
  return lines;
}

std::string distortion_line(const DistortionSummary& distortion) {
  return "angle " + short_number(distortion.mean_abs_ln_angle) + " area " +
         short_number(distortion.mean_abs_ln_area);
}

std::string short_number(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

}  // namespace sphparam::tools
