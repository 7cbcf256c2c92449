#include "sphparam/records/verification_record.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "number_text.h"
#include "records/json_parts.h"
#include "sphparam/io/paths.h"
#include "sphparam/version.h"
#include "sphparam/words.h"

namespace sphparam {

namespace {

std::string words_of(RayPlace place) {
  switch (place) {
    case RayPlace::Rays:
      return "properties sx sy sz";
    case RayPlace::Angles:
      return "properties theta phi";
    case RayPlace::AnglesAttribute:
      return "attribute _THETA_PHI";
    case RayPlace::Positions:
      return "vertex positions";
  }
  return "";
}

/// Where the rays were found.
std::string rays_of(const VerifiedMap& map) {
  std::string words = words_of(map.place);
  if (map.of_two_files) words += " of the sphere";
  if (map.cut_otherwise > 0) {
    words += ", " + std::to_string(map.cut_otherwise) + " of its polygons cut as in the mesh";
  }
  return words;
}

std::string filler_count(const VerifiedMap& map) {
  return std::to_string(std::count(map.fillers.begin(), map.fillers.end(), 1));
}

Json fillers_json(const VerifiedMap& map) {
  if (map.fillers.empty()) return nullptr;
  return {{"triangles", std::count(map.fillers.begin(), map.fillers.end(), 1)},
          {"share", map.filler_share}};
}

Json angles_json(const VerifiedMap& map) {
  if (!map.angles) return nullptr;
  return {{"off", map.angles->off}, {"farthest", map.angles->farthest}};
}

Json input_json(const VerificationRecord& record) {
  return {{"file", record.file},
          {"format", record.map.format},
          {"vertices", record.map.mesh.vertex_count()},
          {"triangles", record.map.mesh.face_count()}};
}

}  // namespace

std::vector<std::string> warnings_of(const VerifiedMap& map) {
  std::vector<std::string> warnings;
  if (!map.is_round()) warnings.push_back(roundness_warning(map));
  warnings.insert(warnings.end(), map.warnings.begin(), map.warnings.end());
  return warnings;
}

std::string to_json(const VerificationRecord& record) {
  const VerifiedMap& map = record.map;
  return text_of({{"sphparam", version},
                  {"command", "verify"},
                  {"input", input_json(record)},
                  {"file", record.file},
                  {"sphere", record.sphere.empty() ? Json() : Json(record.sphere)},
                  {"rays", rays_of(map)},
                  {"mean_length", map.mean_length},
                  {"length_deviation", map.length_deviation},
                  {"angles", angles_json(map)},
                  {"certificate", certificate_json(map.certificate)},
                  {"fillers", fillers_json(map)},
                  {"distortion", distortion_json(map.distortion)},
                  {"chart", chart_json(record.chart)},
                  {"warnings", warnings_of(map)},
                  {"notes", map.notes},
                  {"seconds", record.seconds}});
}

std::string to_text(const VerificationRecord& record) {
  const VerifiedMap& map = record.map;
  std::string text = display_name(record.file) + ": " + verdict(map.certificate) + ", " +
                     std::to_string(map.mesh.face_count()) + " triangles" +
                     (map.certificate.reversed ? ", seen from inside\n" : "\n");
  text += complaint(map.certificate);
  text += "  rays: " + rays_of(map) + ", mean length " + short_number(map.mean_length) +
          ", largest relative deviation " + short_number(map.length_deviation) + "\n";
  if (!map.fillers.empty()) {
    text += "  fillers, proved with the rest: " + filler_count(map) + " triangles, " +
            percent(map.filler_share) + " of the sphere\n";
  }
  if (map.distortion) text += "  " + distortion_line(*map.distortion) + "\n";
  if (record.chart_wanted) text += "  " + chart_line(record.chart) + "\n";
  return text;
}

}  // namespace sphparam
