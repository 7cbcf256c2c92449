#include "io/attributes/one_material.h"

#include <algorithm>
#include <optional>
#include <set>

#include "io/attributes/finish_terms.h"
#include "mesh/triangle_geometry.h"
#include "number_text.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/losses.h"

namespace sphparam {
namespace {

/// Of each material, and last of none.
std::vector<double> areas_of(const MeshFile& file) {
  std::vector<double> areas(file.channels.size() + 1, 0);
  const Property* const material = file.find_face_property("material");
  const FillerMarks fillers = fillers_of(file);
  for (Face f = 0; f < file.mesh.face_count(); ++f) {
    const auto at = static_cast<std::size_t>(f);
    if (!fillers.empty() && fillers[at]) continue;
    const double id = material ? material->values[at] : -1;
    const bool known = id >= 0 && id < static_cast<double>(file.channels.size());
    areas[known ? static_cast<std::size_t>(id) : file.channels.size()] += face_area(file.mesh, f);
  }
  return areas;
}

/// What most of the area says, where `said` has one for each of the areas; and the share of it.
template <class Said>
std::pair<Said, double> most_of(const std::vector<Said>& said, const std::vector<double>& areas) {
  double all = 0, most = -1;
  Said found{};
  for (std::size_t i = 0; i < said.size(); ++i) {
    all += areas[i];
    double alike = 0;
    for (std::size_t k = 0; k < said.size(); ++k) alike += said[k] == said[i] ? areas[k] : 0;
    if (alike > most) {
      most = alike;
      found = said[i];
    }
  }
  return {found, all > 0 ? most / all : 1};
}

/// Those that some have and not all alike.
std::vector<std::string> disputed(const std::vector<MaterialFinish>& finishes) {
  std::set<std::string> names;
  for (const MaterialFinish& finish : finishes)
    for (const std::string& name : extensions_of(finish)) names.insert(name);
  return {names.begin(), names.end()};
}

/// `had`: of `names`, those that the one material has.
std::string told(std::vector<std::string> names, const std::vector<std::string>& had,
                 double share) {
  for (std::string& name : names)
    if (std::ranges::find(had, name) == had.end()) name.insert(0, "no ");
  const char* const as = had.empty() ? ", as the largest part of the area has none; "
                                     : " as the largest part of the area has it; ";
  return "materials become one: " + enumerated(names) + as + percent(1 - share) +
         " of the area has it" + (had.empty() ? "" : " otherwise");
}

/// Faces without a material are opaque.
double area_of(AlphaMode mode, const MeshFile& file, const std::vector<double>& areas) {
  double area = mode == AlphaMode::Opaque ? areas.back() : 0;
  for (std::size_t i = 0; i < file.channels.size(); ++i)
    if (file.channels[i].alpha_mode == mode) area += areas[i];
  return area;
}

/// Of those that are seen and mask anything; the least, so that alphas which are made to fit it get
/// no larger than they were.
double least_cutoff(const MeshFile& file, const std::vector<double>& areas) {
  std::optional<double> least;
  for (std::size_t i = 0; i < file.channels.size(); ++i) {
    const double cutoff = file.channels[i].alpha_cutoff;
    if (file.channels[i].alpha_mode == AlphaMode::Mask && areas[i] > 0 && cutoff > 0)
      least = std::min(cutoff, least.value_or(cutoff));
  }
  return least.value_or(OneMaterial().alpha_cutoff);
}

void take_alpha(const MeshFile& file, const std::vector<double>& areas, OneMaterial& one) {
  const double opaque = area_of(AlphaMode::Opaque, file, areas),
               masked = area_of(AlphaMode::Mask, file, areas),
               blended = area_of(AlphaMode::Blend, file, areas);
  one.alpha_cutoff = least_cutoff(file, areas);
  one.alpha_mode = masked > 0                   ? AlphaMode::Mask
                   : blended > 0 && opaque == 0 ? AlphaMode::Blend
                                                : AlphaMode::Opaque;
  if (blended > 0 && opaque + masked > 0)
    one.warnings.push_back("materials become one, which is not blended: " +
                           percent(blended / (opaque + masked + blended)) +
                           " of the area is, and is drawn over what lies behind it");
}

}  // namespace

OneMaterial one_material(const MeshFile& file) {
  OneMaterial one;
  if (file.channels.empty()) return one;
  const std::vector<double> areas = areas_of(file);
  std::vector<MaterialFinish> finishes;
  std::vector<char> unlit;
  for (const MaterialChannels& said : file.channels) {
    // What no viewer can tell apart is alike.
    finishes.push_back(said.unlit ? MaterialFinish() : finish_in(to_text(said.finish)));
    unlit.push_back(said.unlit);
  }
  finishes.emplace_back();
  unlit.push_back(false);
  const auto [finish, alike] = most_of(finishes, areas);
  const auto [is_unlit, alike_lit] = most_of(unlit, areas);
  one.finish = finish;
  one.unlit = is_unlit;
  take_alpha(file, areas, one);
  const std::vector<std::string> unlit_name = {"KHR_materials_unlit"}, none;
  if (alike_lit < 1)
    one.warnings.push_back(told(unlit_name, is_unlit ? unlit_name : none, alike_lit));
  if (alike < 1 && !one.unlit)
    one.warnings.push_back(told(disputed(finishes), extensions_of(finish), alike));
  return one;
}

}  // namespace sphparam
