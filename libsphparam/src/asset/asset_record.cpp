// What became of an asset, as JSON and in words.

#include <algorithm>
#include <nlohmann/json.hpp>

#include "number_text.h"
#include "records/json_parts.h"
#include "sphparam/asset/remake_asset.h"
#include "sphparam/io/losses.h"
#include "sphparam/sphere/distortion.h"
#include "sphparam/version.h"

namespace sphparam {
namespace {

Json images_json(const std::vector<BakedImage>& images) {
  Json all = Json::array();
  for (const BakedImage& image : images)
    all.push_back({{"map", image.field}, {"about", image.about}, {"file", image.path}});
  return all;
}

Json projection_json(const std::optional<ProjectionShares>& shares) {
  if (!shares) return {};
  return {{"back", shares->back},
          {"nearest", shares->nearest},
          {"median_distance", shares->median},
          {"farthest", shares->farthest}};
}

/// A wrap is told as repairs are, so that who counts them finds it.
Json mending_json(const WholeSurface& whole) {
  Json repairs = repairs_json(whole.repairs);
  if (whole.by == WholeBy::Wrap)
    repairs.push_back({{"kind", "wrapped"},
                       {"count", 1},
                       {"first", Json::array()},
                       {"message", whole.done.front()}});
  return repairs;
}

/// Assets may have thousands.
Json parts_json(const std::vector<PartTexels>& parts) {
  constexpr size_t most = 32;
  Json largest = Json::array();
  for (size_t i = 0; i < std::min(most, parts.size()); ++i)
    largest.push_back({{"material", parts[i].material.empty() ? Json() : Json(parts[i].material)},
                       {"triangles", parts[i].triangles},
                       {"area", parts[i].area},
                       {"texels", parts[i].texels}});
  return {{"count", parts.size()}, {"largest", largest}};
}

/// Of reading, and of what was made.
std::vector<std::string> all_losses(const MeshSource& asset, const RemadeAsset& remade) {
  std::vector<std::string> losses = losses_among(asset.file.notes);
  losses.insert(losses.end(), remade.losses.begin(), remade.losses.end());
  return losses;
}

Json stages(const std::vector<std::pair<std::string, double>>& seconds) {
  Json all = Json::object();
  for (const auto& [stage, time] : seconds) all[stage] = time;
  return all;
}

}  // namespace

std::string verdict_of(const RemadeAsset& remade) {
  const WholeSurface& whole = remade.whole;
  const std::string certified = ", certified one-to-one with the sphere";
  if (whole.by == WholeBy::Itself) return "One closed surface as it is" + certified;
  if (whole.by == WholeBy::Wrap) return "Wrapped in one closed surface" + certified;
  return "Mended to one closed surface with " + percent(whole.area_kept) + " of the area" +
         certified;
}

std::string line_of(const std::vector<PartTexels>& parts) {
  constexpr size_t most = 5;
  std::vector<std::string> shares;
  for (size_t i = 0; i < std::min(most, parts.size()); ++i)
    shares.push_back(percent(parts[i].texels));
  const auto none = std::ranges::count(parts, 0, &PartTexels::texels);
  return "texels of its " + counted(std::ssize(parts), "part") + ": " + joined(shares) +
         (parts.size() > most ? ", …" : "") +
         (none > 0 ? "; " + counted(none, "has none", "have none") : "");
}

std::string to_json(const MeshSource& asset, const RemadeAsset& remade) {
  Json files = Json::array();
  for (const auto& [name, size] : remade.files) files.push_back(name);
  const MappedMesh& mapped = remade.whole.mapped;
  const Distortion distortion = measure_distortion(mapped.surface(), mapped.map(), 1);
  return text_of(
      {{"sphparam", version},
       {"command", "asset"},
       {"input", input_json(asset)},
       {"surface", word_of(remade.whole.by)},
       {"area_kept", remade.whole.area_kept},
       {"found", remade.whole.found},
       {"done", remade.whole.done},
       {"details", remade.whole.details},
       {"repairs", mending_json(remade.whole)},
       {"certificate", certificate_json(mapped.certificate())},
       {"distortion", distortion_json(summarise(distortion, 1))},
       {"vertices", mapped.mesh().vertex_count()},
       {"triangles", mapped.mesh().face_count()},
       {"chart", {{"triangles", remade.chart.triangles}, {"vertices", remade.chart.vertices}}},
       {"images", images_json(remade.baked.images)},
       {"textures", textures_json(remade.textures)},
       {"parts", parts_json(remade.parts)},
       {"from", projection_json(remade.baked.projection)},
       {"wall_share", remade.baked.wall_share},
       {"folds_as_stored", remade.chart.stored.folded.size()},
       {"warnings", remade.warnings},
       {"losses", all_losses(asset, remade)},
       {"files", files},
       {"seconds", stages(remade.seconds)}});
}

}  // namespace sphparam
