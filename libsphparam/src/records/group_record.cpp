#include "sphparam/records/group_record.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "free_name.h"
#include "io/files/nearest_vertex.h"
#include "mesh/vertex_normals.h"
#include "number_text.h"
#include "records/json_parts.h"
#include "sphparam/correspondence/surface_map.h"
#include "sphparam/group/surface_size.h"
#include "sphparam/io/brain_names.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/repair_advice.h"
#include "sphparam/names.h"
#include "sphparam/version.h"
#include "sphparam/words.h"

namespace sphparam {
namespace {

constexpr double far_energy = 1.5;       // of the median beyond isometry: a shape to look at,
constexpr double telling_energy = 0.25;  // if it is this much beyond the median, too
constexpr double isometry = 2;           // of symmetric Dirichlet as it is minimised
constexpr double far_size = 10;          // times the median, or one over that: another unit
constexpr size_t telling_count = 5;      // shapes: of fewer no median says anything

// What columns of a group's own files are called, or numbers of that name would make them.
constexpr std::array<std::string_view, 3> own_names = {"normal", "normal_displacement", "growth"};

bool is_carried(const Group& group, const std::string& name) {
  return std::ranges::any_of(group.members, [&](const GroupMember& member) {
    return member.resampled.file().find_vertex_property(name) != nullptr;
  });
}

double rms(const Points& points, const VectorX& weights) {
  return std::sqrt(points.rowwise().squaredNorm().dot(weights));
}

/// A row of a table.
std::string row(const std::vector<std::string>& cells) { return joined(cells, "\t") + "\n"; }

std::vector<std::string> mode_names(const Group& group, const std::string& word) {
  std::vector<std::string> names;
  for (size_t k = 0; k < group.modes.modes.size(); ++k)
    names.push_back(word + std::to_string(k + 1));
  return names;
}

MendedShape mended_of(const GroupRecord& record, size_t i) {
  return i < record.mended.size() ? record.mended[i] : MendedShape{};
}

/// "hole-filled 1; handle-cut 2"
std::string repairs_text(const MendedShape& mended) {
  std::vector<std::string> told;
  for (const RepairAction& repair : mended.repairs)
    told.push_back(name_of(repair.kind) + " " + std::to_string(repair.count));
  return joined(told, "; ");
}

std::string mended_line(const std::string& name, const MendedShape& mended) {
  std::vector<std::string> told;
  for (const RepairAction& repair : mended.repairs) told.push_back(repair.message);
  for (const std::string& line : {kept_line(mended.parts, mended.repairs), mended.added})
    if (!line.empty()) told.push_back(line);
  return name + ": " + joined(told, "; ");
}

/// Under the keys of the record of `map`.
void add_mended(Json& json, const MendedShape& mended) {
  json["repairs"] = repairs_json(mended.repairs);
  json["handles"] = handles_json(mended.handles);
  json["added"] = mended.added_share;
  json["components"] = parts_json(mended.parts);
}

Json reference_mended_json(const GroupRecord& record) {
  if (!record.reference_mended) return nullptr;
  Json json = Json::object();
  add_mended(json, *record.reference_mended);
  return json;
}

Json member_json(const GroupRecord& record, size_t i) {
  const GroupMember& member = record.group.members[i];
  Json scores = Json::array();
  for (Eigen::Index k = 0; k < record.group.modes.scores.cols(); ++k)
    scores.push_back(record.group.modes.scores(static_cast<Eigen::Index>(i), k));
  Json json = {{"name", record.names[i]},
               {"file", record.files[i]},
               {"vertices", member.mapped.mesh().vertex_count()},
               {"triangles", member.mapped.mesh().face_count()},
               {"mapped_now", record.mapped_now[i]},
               {"start", member.start},
               {"mirrored", member.mirrored},
               {"confidence", member.confidence},
               {"energy", member.energy > 0 ? Json(member.energy) : Json(nullptr)},
               {"certificate", certificate_json(member.mapped.certificate())},
               {"resampled_certificate", certificate_json(member.resampled.certificate())},
               {"resampling_rms", member.resampling_rms},
               {"resampling_max", member.resampling_max},
               {"size", member.size},
               {"scale", member.motion.scale},
               {"distance_from_mean", distance_from_mean(record.group, i)},
               {"scores", scores},
               {"warnings", member.warnings}};
  add_mended(json, mended_of(record, i));
  return json;
}

Json modes_json(const ShapeModes& modes) {
  Json all = Json::array();
  for (Eigen::Index k = 0; k < modes.deviations.size(); ++k)
    all.push_back({{"standard_deviation", modes.deviations[k]}, {"share", modes.shares[k]}});
  return all;
}

Json scalars_json(const Group& group) {
  Json all = Json::array();
  for (const GroupScalar& scalar : group.scalars)
    all.push_back({{"name", carried_name(group, scalar.name)}, {"shapes", scalar.shapes.size()}});
  return all;
}

/// Which shapes are not in the mean of what others have; empty where all are.
std::string missing_line(const GroupRecord& record, const GroupScalar& scalar) {
  std::vector<std::string> missing;
  for (size_t i = 0; i < record.names.size(); ++i)
    if (!std::ranges::binary_search(scalar.shapes, i)) missing.push_back(record.names[i]);
  if (missing.empty()) return {};
  return scalar.name + ": its mean is of " + std::to_string(scalar.shapes.size()) + " of " +
         std::to_string(record.names.size()) + " shapes: " + enumerated(missing) +
         (missing.size() == 1 ? " has" : " have") + " none";
}

/// Numbers that are called otherwise in the files; empty where none is.
std::string renamed_line(const Group& group) {
  std::vector<std::string> renamed;
  for (const std::string_view own : own_names)
    if (const std::string name(own); is_carried(group, name))
      renamed.push_back(name + " is " + carried_name(group, name));
  if (renamed.empty()) return {};
  return "of what shapes carry " + enumerated(renamed) +
         " on the grid: a group has columns of its own of such names";
}

/// Subjects of FreeSurfer have one name for the same surface of each: "sub01_lh_white" of
/// "sub01/surf/lh.white", as in a batch.
std::string name_of_shape(const std::string& file) {
  const std::string stem = stem_of(file), side = stem.substr(0, 2);
  const BrainName brain = parse_brain_name(file);
  const bool is_of_subject =
      (side == "lh" || side == "rh") && brain.hemisphere != 0 && !brain.subject.empty();
  return is_of_subject ? brain.subject + "_" + side + "_" + brain.what : stem;
}

/// Shapes whose energy is far above the others', of so many that this says something.
std::vector<size_t> outliers(const Group& group) {
  std::vector<double> energies;
  for (const GroupMember& member : group.members)
    if (member.energy > 0) energies.push_back(member.energy - isometry);
  if (energies.size() < telling_count) return {};
  std::ranges::sort(energies);
  const double median = energies[energies.size() / 2];
  std::vector<size_t> result;
  for (size_t i = 0; i < group.members.size(); ++i)
    if (group.members[i].energy - isometry > median + std::max(far_energy * median, telling_energy))
      result.push_back(i);
  return result;
}

/// Shapes that no group has beside each other, but in two units; none where --scale makes them one.
std::vector<std::string> size_lines(const GroupRecord& record) {
  std::vector<double> sizes;
  for (const GroupMember& member : record.group.members) sizes.push_back(member.size);
  std::ranges::nth_element(sizes, sizes.begin() + std::ssize(sizes) / 2);
  const double median = sizes[sizes.size() / 2];
  std::vector<std::string> lines;
  for (size_t i = 0; i < record.names.size() && !record.options.scale; ++i)
    if (const double size = record.group.members[i].size;
        size > far_size * median || median > far_size * size)
      lines.push_back(record.names[i] + ": its size is " + short_number(size) +
                      ", the median of the group " + short_number(median) +
                      ": if its file is in another unit the mean and the modes say nothing: bring "
                      "all into one, or to one size with --scale");
  return lines;
}

}  // namespace

MendedShape what_was_mended(const MeshSource& source) {
  return {source.repairs, source.parts, source.handles, source.added_share, added_line(source)};
}

std::vector<std::string> names_of_shapes(const std::vector<std::string>& files) {
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const std::string& file : files) {
    const std::string name = is_stream(file) ? "stdin" : name_of_shape(file);
    names.push_back(free_name(name, [&](const std::string& one) { return taken.contains(one); }));
    taken.insert(names.back());
  }
  return names;
}

std::string carried_name(const Group& group, const std::string& name) {
  if (std::ranges::find(own_names, name) == own_names.end()) return name;
  std::string result = name + "_carried";
  while (is_carried(group, result)) result += "_carried";
  return result;
}

std::string grid_name(const GroupOptions& options) {
  return options.grid ? name_of(*options.grid) : "template";
}

double distance_from_mean(const Group& group, size_t member) {
  return rms(group.members[member].aligned - group.mean.mesh().positions, group.weights);
}

Growth growth_from_mean(const Group& group, size_t member) {
  const TriangleMesh& mean = group.mean.mesh();
  return measure_growth(mean, {group.members.at(member).aligned, mean.triangles});
}

double rms_distance_from_mean(const Group& group) {
  double squares = 0;
  for (size_t i = 0; i < group.members.size(); ++i) {
    const double distance = distance_from_mean(group, i);
    squares += distance * distance;
  }
  return std::sqrt(squares / static_cast<double>(group.members.size()));
}

double mean_size(const Group& group) {
  double sum = 0;
  for (const GroupMember& member : group.members) sum += member.size;
  return sum / static_cast<double>(group.members.size());
}

double size_of_mean(const Group& group) { return surface_size(group.mean.surface()); }

std::string to_json(const GroupRecord& record) {
  const Group& group = record.group;
  Json members = Json::array(), landmarks = Json::array();
  for (size_t i = 0; i < group.members.size(); ++i) members.push_back(member_json(record, i));
  const FileNumbers numbers(group.reference.file());
  for (const TemplateLandmark& landmark : record.landmarks)
    landmarks.push_back({{"name", landmark.name},
                         {"vertex", numbers.number(landmark.vertex)},
                         {"distance", landmark.distance ? Json(*landmark.distance) : Json()}});
  const Json json = {{"sphparam", version},
                     {"command", "group"},
                     {"template", record.reference},
                     {"template_mended", reference_mended_json(record)},
                     {"start", name_of(record.options.start)},
                     {"alike", record.options.alike},
                     {"mirror", record.options.mirror},
                     {"hold", record.options.hold},
                     {"rounds", record.options.hold ? 0 : record.options.rounds},
                     {"grid", grid_name(record.options)},
                     {"scale", record.options.scale},
                     {"one_to_one", true},
                     {"mean_size", mean_size(group)},
                     {"size_of_mean", size_of_mean(group)},
                     {"variance", group.modes.variance},
                     {"modes", modes_json(group.modes)},
                     {"scalars", scalars_json(group)},
                     {"procrustes_iterations", group.iterations},
                     {"shapes", members},
                     {"landmarks", landmarks},
                     {"warnings", group_warnings(record)},
                     {"outputs", record.outputs},
                     {"seconds", record.seconds}};
  return text_of(json);
}

std::string shapes_table(const GroupRecord& record) {
  std::vector<std::string> header{"shape", "start", "energy", "size", "distance_from_mean"};
  for (std::string& name : mode_names(record.group, "mode")) header.push_back(std::move(name));
  header.insert(header.end(), {"mirrored", "confidence", "repairs", "file"});
  std::string text = row(header);
  for (size_t i = 0; i < record.names.size(); ++i) {
    const GroupMember& member = record.group.members[i];
    std::vector<std::string> cells{
        record.names[i], member.start, member.energy > 0 ? shortest(member.energy) : "",
        shortest(member.size), shortest(distance_from_mean(record.group, i))};
    for (Eigen::Index k = 0; k < record.group.modes.scores.cols(); ++k)
      cells.push_back(shortest(record.group.modes.scores(static_cast<Eigen::Index>(i), k)));
    cells.push_back(member.mirrored ? "1" : "0");
    cells.push_back(shortest(member.confidence));
    cells.push_back(repairs_text(mended_of(record, i)));
    cells.push_back(record.files[i]);
    text += row(cells);
  }
  return text;
}

std::string distances_table(const GroupRecord& record) {
  std::vector<std::string> header{"shape"};
  header.insert(header.end(), record.names.begin(), record.names.end());
  std::string text = row(header);
  for (size_t i = 0; i < record.names.size(); ++i) {
    std::vector<std::string> cells{record.names[i]};
    for (Eigen::Index j = 0; j < record.group.distances.cols(); ++j)
      cells.push_back(shortest(record.group.distances(static_cast<Eigen::Index>(i), j)));
    text += row(cells);
  }
  return text;
}

std::string vertices_table(const GroupRecord& record) {
  const Group& group = record.group;
  const Points normals = vertex_normals(group.mean.mesh());
  std::vector<std::string> header{"vertex",          "x", "y", "z", "weight", "deviation",
                                  "normal_deviation"};
  for (std::string& name : mode_names(group, "normal_mode")) header.push_back(std::move(name));
  for (const GroupScalar& scalar : group.scalars)
    for (const char* of : {"_mean", "_deviation"})
      header.push_back(carried_name(group, scalar.name) + of);
  std::string text = row(header);
  for (Vertex v = 0; v < group.mean.mesh().vertex_count(); ++v) {
    const Vector3 x = group.mean.mesh().position(v);
    std::vector<std::string> cells{std::to_string(v)};
    for (const double value :
         {x.x(), x.y(), x.z(), group.weights[v], group.deviation[v], group.normal_deviation[v]})
      cells.push_back(shortest(value));
    for (const Points& mode : group.modes.modes)
      cells.push_back(shortest(mode.row(v).dot(normals.row(v))));
    for (const GroupScalar& scalar : group.scalars)
      cells.insert(cells.end(), {shortest(scalar.mean[v]), shortest(scalar.deviation[v])});
    text += row(cells);
  }
  return text;
}

std::string landmarks_table(const GroupRecord& record) {
  std::vector<Vertex> vertices;
  for (const TemplateLandmark& landmark : record.landmarks) vertices.push_back(landmark.vertex);
  std::string text =
      row({"shape", "landmark", "x", "y", "z", "face", "w0", "w1", "w2", "nearest_vertex"});
  for (size_t i = 0; i < record.names.size(); ++i) {
    const MappedMesh& mapped = record.group.members[i].mapped;
    const NearestVertex nearest(mapped.mesh(), FileNumbers(mapped.file()));
    const std::vector<SurfacePoint> points = carried_to(record.group, i, vertices);
    for (size_t k = 0; k < points.size(); ++k) {
      const SurfacePoint& point = points[k];
      const Vector3 x = position(mapped.mesh(), point);
      std::vector<std::string> cells{record.names[i], record.landmarks[k].name};
      for (int axis = 0; axis < 3; ++axis) cells.push_back(shortest(x[axis]));
      cells.push_back(std::to_string(point.face));
      for (int corner = 0; corner < 3; ++corner)
        cells.push_back(shortest(point.barycentric[corner]));
      cells.push_back(std::to_string(nearest.at(x)));
      text += row(cells);
    }
  }
  return text;
}

/// Empty where mirror images were not asked for.
std::string mirrored_words(const GroupRecord& record) {
  if (!record.options.mirror) return "";
  std::vector<std::string> mirrored;
  for (size_t i = 0; i < record.names.size(); ++i)
    if (record.group.members[i].mirrored) mirrored.push_back(record.names[i]);
  return mirrored.empty() ? ", none mirrored"
                          : ", of " + enumerated(mirrored) + " the mirror image";
}

std::string to_text(const GroupRecord& record) {
  const Group& group = record.group;
  const double size = size_of_mean(group), distance = rms_distance_from_mean(group);
  const std::string grid =
      record.options.grid ? grid_name(record.options) : "the template's triangles";
  return counted(static_cast<long>(record.names.size()), "shape") + " on " + grid +
         mirrored_words(record) + ", all maps certified; RMS distance from the mean " +
         short_number(distance) + " (" + percent(size > 0 ? distance / size : 0) + " of its size " +
         short_number(size) + "), " + short_number(record.seconds) + " s";
}

std::vector<std::string> mode_lines(const GroupRecord& record) {
  const ShapeModes& modes = record.group.modes;
  std::vector<std::string> lines;
  for (Eigen::Index k = 0; k < modes.deviations.size(); ++k)
    lines.push_back("mode " + std::to_string(k + 1) + ": standard deviation " +
                    short_number(modes.deviations[k]) + ", " + percent(modes.shares[k]) +
                    " of the variance");
  return lines;
}

std::vector<std::string> mended_lines(const GroupRecord& record) {
  std::vector<std::string> lines;
  const auto add = [&](const std::string& name, const MendedShape& mended) {
    if (!mended.repairs.empty()) lines.push_back(mended_line(name, mended));
  };
  for (size_t i = 0; i < record.names.size(); ++i) add(record.names[i], mended_of(record, i));
  if (record.reference_mended)
    add("template " + display_name(record.reference), *record.reference_mended);
  return lines;
}

std::vector<std::string> group_warnings(const GroupRecord& record) {
  std::vector<std::string> warnings;
  for (size_t i = 0; i < record.names.size(); ++i)
    for (const std::string& warning : record.group.members[i].warnings)
      warnings.push_back(record.names[i] + ": " + warning);
  for (const size_t i : outliers(record.group))
    warnings.push_back(record.names[i] +
                       ": its map to the mean distorts far more than the others' "
                       "(energy " +
                       short_number(record.group.members[i].energy) +
                       "): look at its correspondence; where it is wrong, landmarks by match bring "
                       "it right");
  std::ranges::move(size_lines(record), std::back_inserter(warnings));
  for (const GroupScalar& scalar : record.group.scalars)
    if (std::string line = missing_line(record, scalar); !line.empty())
      warnings.push_back(std::move(line));
  if (std::string line = renamed_line(record.group); !line.empty())
    warnings.push_back(std::move(line));
  return warnings;
}

}  // namespace sphparam
