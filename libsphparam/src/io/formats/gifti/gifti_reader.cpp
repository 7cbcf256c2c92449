#include "io/formats/gifti/gifti_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

#include "free_name.h"
#include "io/files/non_finite_advice.h"
#include "io/formats/freesurfer_comments.h"
#include "io/formats/gifti/gifti_data.h"
#include "io/formats/gifti/gifti_labels.h"
#include "io/formats/gifti/gifti_xml.h"
#include "io/formats/non_finite_numbers.h"
#include "io/formats/volume_geometry.h"
#include "sphparam/io/losses.h"

// The XML is taken apart (gifti_xml), the two arrays of the surface are decoded (gifti_data), then
// the arrays that have one number a vertex.

namespace sphparam {
namespace {

// Coordinates and triangles hardly pack; labels and masks may pack as well as anything.
constexpr std::int64_t most_surface_inflation = 100, most_inflation = 1000;
constexpr std::size_t most_properties = 64;
constexpr std::array<std::string_view, 4> kept = {"AnatomicalStructurePrimary",
                                                  "AnatomicalStructureSecondary", "GeometricType",
                                                  "TopologicalType"};
constexpr std::string_view pointset = "NIFTI_INTENT_POINTSET";
constexpr std::string_view triangle = "NIFTI_INTENT_TRIANGLE";
constexpr std::string_view scanner = "NIFTI_XFORM_SCANNER_ANAT";

class GiftiReader {
 public:
  GiftiReader(const GiftiDocument& document, const std::string& name, const ReadOptions& options)
      : document_(document), name_(name), options_(options) {}

  MeshFile read() {
    file_.format = "GIFTI";
    const GiftiArray& points = the_only(pointset);
    read_points(points);
    read_triangles(the_only(triangle));
    for (const GiftiArray& array : document_.arrays)
      if (array.intent != pointset && array.intent != triangle) read_property(array);
    add_comments(points);
    return std::move(file_);
  }

 private:
  const GiftiArray& the_only(std::string_view intent) const {
    const GiftiArray* found = nullptr;
    for (const GiftiArray& array : document_.arrays) {
      if (array.intent != intent) continue;
      if (found) fail_in_array(name_, array, "is the second one");
      found = &array;
    }
    if (!found) throw ReadError(name_, "is no surface: it has no array of " + std::string(intent));
    return *found;
  }

  /// Decodes an array of rows of three.
  std::vector<double> triples(const GiftiArray& array, std::int64_t limit, const char* what) const {
    const std::int64_t count = gifti_count(array, most_surface_inflation, name_);
    if (array.dimensions.size() != 2 || array.dimensions[1] != 3)
      fail_in_array(name_, array, "does not have rows of three");
    if (array.dimensions[0] > limit || count > std::numeric_limits<int>::max())
      fail_in_array(
          name_, array,
          "has more " + std::string(what) + " than the limit of " + std::to_string(limit));
    return decode_gifti(array, name_);
  }

  void read_points(const GiftiArray& array) {
    if (!is_floating(gifti_type(array, name_)))
      fail_in_array(name_, array, "has coordinates that are no real numbers");
    const std::vector<double> xyz = triples(array, options_.max_vertices, "vertices");
    for (std::size_t i = 0; i < xyz.size(); ++i)
      if (!std::isfinite(xyz[i]) && !options_.non_finite)
        fail_in_array(name_, array,
                      "has a coordinate of vertex " + std::to_string(i / 3) +
                          " that is not finite" + non_finite_advice());
    file_.mesh.positions = Eigen::Map<const Points>(xyz.data(), array.dimensions[0], 3);
    file_.position_type = gifti_type(array, name_);
  }

  void read_triangles(const GiftiArray& array) {
    if (is_floating(gifti_type(array, name_)))
      fail_in_array(name_, array, "has indices that are no whole numbers");
    const std::vector<double> corners = triples(array, options_.max_faces, "triangles");
    const auto vertices = static_cast<double>(file_.mesh.vertex_count());
    Triangles& triangles = file_.mesh.triangles;
    triangles.resize(array.dimensions[0], 3);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (corners[i] < 0 || corners[i] >= vertices)
        fail_in_array(name_, array,
                      "names vertex " + std::to_string(static_cast<long>(corners[i])) + " of " +
                          std::to_string(file_.mesh.vertex_count()) + " in triangle " +
                          std::to_string(i / 3));
      triangles.data()[i] = static_cast<int>(corners[i]);
    }
    for (Eigen::Index f = 0; f < triangles.rows() && !options_.repeated_corners; ++f) {
      const int a = triangles(f, 0), b = triangles(f, 1), c = triangles(f, 2);
      if (a == b || b == c || c == a)
        fail_in_array(
            name_, array,
            "names a vertex twice in triangle " + std::to_string(f) + repeated_corners_advice());
    }
  }

  void read_property(const GiftiArray& array) {
    const std::int64_t vertices = file_.mesh.vertex_count();
    std::int64_t others = 1;
    for (std::size_t i = 1; i < array.dimensions.size(); ++i)
      others = std::max(others, array.dimensions[i]);
    const std::string property = property_name(array);
    const auto leave = [&](const std::string& why) {
      add_loss(file_.notes, "array '" + property + "': " + why);
    };
    if (array.dimensions[0] != vertices || others != 1)
      return leave("it does not have one number a vertex");
    if (file_.vertex_properties.size() == most_properties)
      return leave("only " + std::to_string(most_properties) + " are kept");
    gifti_count(array, most_inflation, name_);
    std::vector<double> values = decode_gifti(array, name_);
    if (const std::string why = non_finite_words(values); !why.empty()) return leave(why);
    file_.vertex_properties.push_back({property, gifti_type(array, name_), std::move(values)});
  }

  /// From the metadata, else from the intent; unlike those that are there already.
  std::string property_name(const GiftiArray& array) const {
    constexpr std::string_view prefix = "NIFTI_INTENT_";
    constexpr std::size_t longest_allowed = 64;
    std::string name = value_of(array.metadata, "Name");
    if (name.empty()) name = array.intent.substr(array.intent.starts_with(prefix) * prefix.size());
    name = printable_name(one_line(name.substr(0, longest_allowed)));
    return free_name(name, [this](const std::string& candidate) {
      return candidate.empty() || candidate == "x" || candidate == "y" || candidate == "z" ||
             file_.find_vertex_property(candidate);
    });
  }

  static std::string value_of(const Metadata& metadata, std::string_view key) {
    for (const auto& [name, value] : metadata)
      if (name == key) return value;
    return {};
  }

  void add_comments(const GiftiArray& points) {
    constexpr std::string_view ours = "sphparam ";
    constexpr std::size_t longest_allowed = 1000;
    for (const auto& [key, value] : document_.metadata)
      if (key.starts_with(ours) && value.size() <= longest_allowed)
        file_.comments.push_back(one_line(key + " " + value));
    for (const std::string_view key : kept) {
      const std::string value = value_of(points.metadata, key);
      if (!value.empty() && value.size() <= longest_allowed)
        file_.comments.push_back(one_line("gifti " + std::string(key) + " " + value));
    }
    add_geometry(points);
    note_metadata();
    for (const Label& label : document_.labels) file_.comments.push_back(comment_of(label));
    for (const auto& [from, to, matrix] : points.coordinate_systems)
      if (!is_identity(matrix))
        add_loss(file_.notes, "the transform from the space " + quoted(from) + " to " + quoted(to) +
                                  ": coordinates stay as they are");
  }

  /// The volume where all of it is there; else its keys are told with all others.
  void add_geometry(const GiftiArray& points) {
    const std::vector<std::string> geometry = freesurfer_geometry_of(points.metadata);
    has_geometry_ = !geometry.empty();
    const bool is_scanner = are_in(scanner, points);
    if (has_geometry_ || is_scanner)
      file_.comments.push_back(std::string(freesurfer_real_ras) + (is_scanner ? "1" : "0"));
    file_.comments.insert(file_.comments.end(), geometry.begin(), geometry.end());
    if (!is_scanner) tell_space(points);
  }

  /// Whether coordinates are in this space, as they are.
  static bool are_in(std::string_view space, const GiftiArray& points) {
    return std::ranges::any_of(points.coordinate_systems, [&](const auto& system) {
      return system.data_space == space ||
             (system.transformed_space == space && is_identity(system.matrix));
    });
  }

  /// One that has a name, and no place in other formats.
  void tell_space(const GiftiArray& points) {
    for (const auto& [from, to, matrix] : points.coordinate_systems) {
      const bool is_named = !from.empty() && from != "NIFTI_XFORM_UNKNOWN";
      if (!is_named || !is_identity(matrix)) continue;  // which a transform's loss names
      return add_loss(file_.notes, "that coordinates are in the space " + quoted(from));
    }
  }

  void note_metadata() {
    std::vector<std::string> keys;
    const auto add = [&](const Metadata& metadata) {
      for (const auto& [key, value] : metadata) {
        const bool known = key.empty() || (has_geometry_ && is_gifti_geometry(key)) ||
                           key == "Name" || key.starts_with("sphparam ") ||
                           std::find(kept.begin(), kept.end(), key) != kept.end();
        if (!known && std::find(keys.begin(), keys.end(), quoted(key)) == keys.end() &&
            keys.size() < most_properties)
          keys.push_back(quoted(key));
      }
    };
    add(document_.metadata);
    for (const GiftiArray& array : document_.arrays) add(array.metadata);
    if (!keys.empty()) add_loss(file_.notes, "metadata " + enumerated(keys));
  }

  /// Sixteen numbers as they are written: what cannot be read so is no identity.
  static bool is_identity(const std::string& matrix) {
    std::istringstream text(matrix);
    text.imbue(std::locale::classic());
    for (int i = 0; i < 16; ++i) {
      double entry = 0;
      if (!(text >> entry) || entry != (i % 5 == 0 ? 1 : 0)) return false;
    }
    return !(text >> std::ws).good();
  }

  const GiftiDocument& document_;
  const std::string& name_;
  const ReadOptions& options_;
  MeshFile file_;
  bool has_geometry_ = false;
};

}  // namespace

bool looks_like_gifti(std::string_view bytes) {
  constexpr std::size_t prologue_size = 4096;
  const std::size_t start = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
  bytes.remove_prefix(start);
  if (!bytes.starts_with("<")) return false;
  const std::string_view prologue = bytes.substr(0, prologue_size);
  return prologue.find("<GIFTI") != std::string_view::npos ||
         prologue.find("<!DOCTYPE GIFTI") != std::string_view::npos;
}

MeshFile read_gifti(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  const GiftiDocument document = parse_gifti_xml(bytes, name);
  return GiftiReader(document, name, options).read();
}

}  // namespace sphparam
