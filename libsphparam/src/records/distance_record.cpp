// Distances as JSON and as a table: absolute, and relative to the diagonal of the first mesh.

#include "sphparam/records/distance_record.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "elementary.h"
#include "number_text.h"
#include "place_text.h"
#include "records/json_parts.h"
#include "sphparam/io/paths.h"
#include "sphparam/version.h"

namespace sphparam {

namespace {

/// Null of nothing.
Json number_json(const std::optional<double>& number) { return number ? Json(*number) : Json(); }

Json mesh_json(const std::string& path, const MeshFile& file, double diagonal,
               const std::optional<double>& volume) {
  return {{"file", path},
          {"format", file.format},
          {"vertices", file.mesh.vertex_count()},
          {"triangles", file.mesh.face_count()},
          {"diagonal", diagonal},
          {"volume", number_json(volume)},
          {"notes", file.notes}};
}

Json side_json(const OneSidedDistance& side, double own_diagonal, double other_diagonal,
               double reference, const std::optional<double>& within) {
  Json json = {{"RMS", side.rms},
               {"max", side.max},
               {"mean", side.mean},
               {"min", side.min},
               {"SD", side.sd},
               {"median", side.median},
               {"P95", side.p95},
               {"P99", side.p99},
               {"n_samples", side.samples},
               {"diag_mesh_0", own_diagonal},
               {"diag_mesh_1", other_diagonal},
               {"max_bound", side.max_bound},
               {"farthest", vector_json(side.farthest)},
               {"relative",
                {{"RMS", side.rms / reference},
                 {"max", side.max / reference},
                 {"mean", side.mean / reference},
                 {"min", side.min / reference}}}};
  if (side.within) json["within"] = {{"length", *within}, {"share", *side.within}};
  if (side.left_out) json["left_out"] = *side.left_out;
  return json;
}

/// The first as the second has it: with the side, where that was asked for.
Json forth_json(const SurfaceDistance& distance, const std::optional<double>& within) {
  const OneSidedDistance& forth = distance.forth;
  const double first = distance.diagonal_first;
  Json json = side_json(forth, first, distance.diagonal_second, first, within);
  if (forth.deviation)
    json["signed"] = {{"max", forth.deviation->max},
                      {"mean", forth.deviation->mean},
                      {"min", forth.deviation->min},
                      {"SD", forth.deviation->sd},
                      {"median", forth.deviation->median}};
  return json;
}

Json sampled_json(const DistanceOptions& options) {
  Json on = Json::array();
  if (options.faces) on.push_back("faces");
  if (options.edges) on.push_back("edges");
  if (options.vertices) on.push_back("vertices");
  return {{"on", on}, {"samples", options.samples}, {"seed", options.seed}};
}

Json growth_json(const Growth& growth) {
  return {
      {"total", growth.total}, {"min", growth.faces.minCoeff()}, {"max", growth.faces.maxCoeff()}};
}

/// Of a turn: its angle.
double degrees_of(const Eigen::Matrix3d& turn) {
  const Vector3 axis(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
  return 180 / std::numbers::pi * elementary::atan2(axis.norm(), turn.trace() - 1);
}

Json alignment_json(const Alignment& alignment) {
  return {{"kind", alignment.scaled ? "similarity" : "rigid"},
          {"matrix", alignment.motion.matrix()},
          {"scale", alignment.motion.scale},
          {"degrees", degrees_of(alignment.motion.rotation)},
          {"start", name_of(alignment.start)},
          {"RMS", alignment.rms},
          {"kept", alignment.kept},
          {"reach", alignment.reach},
          {"iterations", alignment.iterations}};
}

/// Empty where that was not asked for.
std::string alignment_lines(const std::optional<Alignment>& alignment) {
  if (!alignment) return "";
  const Similarity& motion = alignment->motion;
  std::string text =
      "2 is put onto 1: turned by " + short_number(degrees_of(motion.rotation), 4) + "°" +
      (alignment->scaled ? ", scaled by " + short_number(motion.scale, 6) : "") +
      ", and moved; sought from " +
      (alignment->start == AlignmentStart::AsTheyAre ? "where it was" : name_of(alignment->start)) +
      "; RMS " + short_number(alignment->rms, 4) + " of the " + percent(alignment->kept) +
      " of samples within " + short_number(alignment->reach, 4) + "; its matrix:\n";
  for (const auto& row : motion.matrix()) {
    const char* before = "  ";
    for (const double number : row) text += std::exchange(before, " ") + shortest(number);
    text += "\n";
  }
  return text + "\n";
}

std::string growth_line(const Growth& growth) {
  return "growth, area of 2 over that of 1: " + short_number(growth.total, 6) +
         ", of triangles from " + short_number(growth.faces.minCoeff(), 6) + " to " +
         short_number(growth.faces.maxCoeff(), 6) + "\n";
}

Json limits_json(const std::vector<DistanceLimit>& limits) {
  Json all = Json::array();
  for (const DistanceLimit& limit : limits) {
    all.push_back({{"option", limit.name},
                   {"limit", limit.limit},
                   {"measured", limit.measured},
                   {"exceeded", limit.exceeded()}});
  }
  return all;
}

std::string signed_line(const SignedDeviation& deviation) {
  return "signed, of 1 from 2, less than 0 inside: from " + short_number(deviation.min, 6) +
         " to " + short_number(deviation.max, 6) + ", mean " + short_number(deviation.mean, 6) +
         ", SD " + short_number(deviation.sd, 6) + ", median " + short_number(deviation.median, 6) +
         "\n";
}

/// One line of the table: four lengths, each with its share of the diagonal.
std::string row(const std::string& name, const std::array<double, 4>& lengths, double diagonal) {
  char text[32];
  std::string line = name;
  for (const double length : lengths) {
    std::snprintf(text, sizeof text, "%13.6g", length);
    line += text;
    std::snprintf(text, sizeof text, " %8.3g%%", 100 * length / diagonal);
    line += text;
  }
  return line + "\n";
}

std::string distance_row(const std::string& name, const OneSidedDistance& side, double diagonal) {
  return row(name, {side.max, side.mean, side.rms, side.min}, diagonal);
}

std::string percentile_row(const std::string& name, const OneSidedDistance& side, double diagonal) {
  return row(name, {side.p99, side.p95, side.median, side.sd}, diagonal);
}

std::string percentile_rows(const SurfaceDistance& distance) {
  const double diagonal = distance.diagonal_first;
  return "\n                      99 %                   95 %                 median"
         "                     SD\n" +
         percentile_row("1 to 2", distance.forth, diagonal) +
         percentile_row("2 to 1", distance.back, diagonal) +
         "the larger 95 % (HD95): " + short_number(distance.p95(), 6) + "\n";
}

/// All is said of all alone.
std::string share_of_all(std::optional<double> share) {
  constexpr double nearly_all = 0.999;
  return percent(share.value_or(0) < 1 ? std::min(share.value_or(0), nearly_all) : 1);
}

/// Empty where that was not asked for.
std::string within_line(const DistanceRecord& record) {
  if (!record.options.within) return "";
  const SurfaceDistance& distance = record.distance;
  return "within " + short_number(*record.options.within, 6) + ": " +
         share_of_all(distance.forth.within) + " of 1, " + share_of_all(distance.back.within) +
         " of 2\n";
}

/// Empty where nothing was to be left out.
std::string left_out_line(const SurfaceDistance& distance) {
  if (!distance.forth.left_out) return "";
  const auto share = [](double of) { return of > 0 ? percent(of) : "0 %"; };
  return "left out, nearest to the border of the other: " + share(*distance.forth.left_out) +
         " of 1, " + share(*distance.back.left_out) + " of 2\n";
}

/// Empty where one is open.
std::string volume_line(const DistanceRecord& record) {
  constexpr double rounding = 1e-10;  // of a volume
  if (!record.first_volume || !record.second_volume) return "";
  const double first = *record.first_volume, second = *record.second_volume;
  const double gained = second - first;
  std::string text =
      "volume: " + short_number(first, 6) + " of 1, " + short_number(second, 6) + " of 2";
  if (std::abs(gained) > rounding * std::abs(first))
    text += ", " + short_number(std::abs(gained), 6) + (gained > 0 ? " more (" : " less (") +
            short_number(100 * gained / first, 3) + " %)";
  return text + "\n";
}

/// What is known of points that were not looked at.
std::string bound_words(const SurfaceDistance& distance) {
  if (distance.forth.left_out) return "; of samples and vertices";
  return "; no point is farther than " + short_number(distance.max_bound(), 6);
}

}  // namespace

std::string to_json(const DistanceRecord& record) {
  const SurfaceDistance& distance = record.distance;
  const double first = distance.diagonal_first, second = distance.diagonal_second;
  const std::optional<double>& within = record.options.within;
  Json json = {
      {"sphparam", version},
      {"command", "measure"},
      {"first", mesh_json(record.first, record.first_file, first, record.first_volume)},
      {"second", mesh_json(record.second, record.second_file, second, record.second_volume)},
      {"sampled", sampled_json(record.options)},
      {"upright", record.upright},
      {"alignment", record.alignment ? alignment_json(*record.alignment) : Json()},
      {"first_to_second", forth_json(distance, within)},
      {"second_to_first", side_json(distance.back, second, first, first, within)},
      {"two_sided",
       {{"RMS", distance.rms()},
        {"max", distance.max()},
        {"max_bound", distance.max_bound()},
        {"mean", distance.mean()},
        {"HD95", distance.p95()},
        {"relative",
         {{"RMS", distance.rms() / first},
          {"max", distance.max() / first},
          {"mean", distance.mean() / first}}}}},
      {"limits", limits_json(record.limits)},
      {"renamed", pairs_json(record.renamed)},
      {"outputs", pairs_json(record.outputs)},
      {"seconds", record.seconds}};
  if (record.growth) json["growth"] = growth_json(*record.growth);
  return text_of(json);
}

std::string to_text(const DistanceRecord& record) {
  const SurfaceDistance& distance = record.distance;
  const std::string first = display_name(record.first), second = display_name(record.second);
  std::string text = "1: " + first + "\n2: " + second + "\n%: of the diagonal of 1, " +
                     short_number(distance.diagonal_first, 6) + "; " +
                     std::to_string(distance.forth.samples) + " and " +
                     std::to_string(distance.back.samples) + " samples\n\n" +
                     alignment_lines(record.alignment);
  text +=
      "                       max                   mean                    RMS"
      "                    min\n";
  text += distance_row("1 to 2", distance.forth, distance.diagonal_first);
  text += distance_row("2 to 1", distance.back, distance.diagonal_first);
  text += row("larger",
              {distance.max(), distance.mean(), distance.rms(),
               std::max(distance.forth.min, distance.back.min)},
              distance.diagonal_first);
  text += percentile_rows(distance) + "\n" + left_out_line(distance) + within_line(record);
  if (distance.forth.deviation) text += signed_line(*distance.forth.deviation);
  if (record.growth) text += growth_line(*record.growth);
  text += volume_line(record);
  text += "farthest: " + place_text(distance.forth.farthest, distance.diagonal_first, " ") +
          " of 1, " + place_text(distance.back.farthest, distance.diagonal_second, " ") + " of 2" +
          bound_words(distance) + "\n";
  return text;
}

}  // namespace sphparam
