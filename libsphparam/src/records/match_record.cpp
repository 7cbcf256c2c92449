#include "sphparam/records/match_record.h"

#include <nlohmann/json.hpp>

#include "number_text.h"
#include "records/json_parts.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/paths.h"
#include "sphparam/version.h"
#include "sphparam/words.h"

namespace sphparam {
namespace {

Json side_json(const std::string& path, const MappedMesh& mapped, bool mapped_now) {
  return {{"file", path},
          {"vertices", mapped.mesh().vertex_count()},
          {"triangles", mapped.mesh().face_count()},
          {"mapped_now", mapped_now},
          {"certificate", certificate_json(mapped.certificate())}};
}

Json landmarks_json(const MatchRecord& record) {
  const FileNumbers from(record.match.map.from().file()), to(record.match.map.to().file());
  Json all = Json::array();
  for (size_t i = 0; i < record.options.landmarks.size(); ++i) {
    const LandmarkPair& pair = record.options.landmarks[i];
    all.push_back({{"first", from.number(pair.from)},
                   {"second", to.number(pair.to)},
                   {"residual", record.match.residuals[i]}});
  }
  return all;
}

/// What was searched for: the first suggestion was the start; a turn, where there is none.
Json search_json(const MatchRecord& record) {
  if (!record.options.search) return nullptr;
  const FileNumbers from(record.match.map.from().file()), to(record.match.map.to().file());
  Json suggestions = Json::array();
  for (const SuggestedLandmarks& suggestion : record.match.suggestions) {
    Json pairs = Json::array();
    for (const LandmarkPair& pair : suggestion.landmarks)
      pairs.push_back({{"first", from.number(pair.from)}, {"second", to.number(pair.to)}});
    Json made{{"landmarks", pairs},
              {"energy", suggestion.energy},
              {"agreement", suggestion.agreement},
              {"score", suggestion.score}};
    if (record.options.alike) made["place_agreement"] = suggestion.place_agreement;
    suggestions.push_back(std::move(made));
  }
  return {{"confidence", record.match.confidence},
          {"alike", record.options.alike},
          {"suggestions", suggestions}};
}

/// What was to agree besides.
Json features_json(const MatchRecord& record) {
  const std::optional<MatchFeatures>& features = record.options.features;
  if (!features) return nullptr;
  Json json{{"columns", features->from.cols()},
            {"weight", features->weight},
            {"correlation", record.match.agreement},
            {"confidence", record.match.confidence}};
  if (record.options.alike) json["place_agreement"] = record.match.place_agreement;
  return json;
}

Json carried_json(const std::optional<CarriedFidelity>& carried) {
  if (!carried) return nullptr;
  return {
      {"farthest", carried->farthest}, {"rms", carried->rms}, {"area_share", carried->area_share}};
}

std::string words_of_start(const std::string& made_by) {
  if (made_by == "places") return "places in space";
  return made_by == "own map" ? "its own map" : "a turn";
}

std::string words_of_search(const Match& match, bool searched) {
  if (!searched) return {};
  if (match.suggestions.empty())
    return ", from " + words_of_start(match.made_by) + " with confidence " +
           short_number(match.confidence);
  return ", from " + counted(std::ssize(match.suggestions.front().landmarks), "end", "ends") +
         " paired with confidence " + short_number(match.confidence);
}

}  // namespace

std::string to_json(const MatchRecord& record) {
  const Match& match = record.match;
  Json json = {{"sphparam", version},
               {"command", "match"},
               {"first", side_json(record.first, match.map.from(), record.first_mapped_now)},
               {"second", side_json(record.second, match.map.to(), match.map.to().mapped_here())},
               {"mirrored", record.mirrored},
               {"one_to_one", true},
               {"made_by", match.made_by},
               {"energy", match.energy},
               {"landmarks", landmarks_json(record)},
               {"search", search_json(record)},
               {"features", features_json(record)},
               {"distortion", distortion_json(record.distortion)},
               {"carried", carried_json(record.carried)}};
  json["warnings"] = match.warnings;
  json["outputs"] = pairs_json(record.outputs);
  json["seconds"] = record.seconds;
  return text_of(json);
}

std::string to_text(const MatchRecord& record) {
  const DistortionSummary& d = record.distortion;
  std::string line = display_name(record.first) + " → " + display_name(record.second) +
                     ": one-to-one, both maps certified; mean |ln| of angles " +
                     short_number(d.mean_abs_ln_angle) + flat_images_words(d) + ", of areas " +
                     short_number(d.mean_abs_ln_area);
  const size_t landmarks = record.options.landmarks.size();
  if (landmarks > 0)
    line += ", " + counted(static_cast<long>(landmarks), "landmark", "landmarks") + " exact";
  if (record.options.features)
    line += ", correlation of features " + short_number(record.match.agreement);
  if (record.options.features && landmarks == 0)
    line += " from a turn with confidence " + short_number(record.match.confidence);
  if (record.options.features && record.options.alike)
    line += ", of places " + short_number(record.match.place_agreement);
  line += words_of_search(record.match, record.options.search);
  return line + ", " + short_number(record.seconds) + " s";
}

std::string carried_line(const MatchRecord& record) {
  const CarriedFidelity& carried = *record.carried;
  const std::string second = display_name(record.second);
  return "the triangles of " + display_name(record.first) + " in the shape of " + second +
         " have " + percent(carried.area_share) + " of its area; its points are within " +
         percent(carried.farthest) + " of its diagonal of them, " + percent(carried.rms) + " RMS";
}

}  // namespace sphparam
