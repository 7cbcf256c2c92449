// What vertices have as images, and images back as what vertices have.

#include "sphparam/remesh/geometry_image.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "image/image_codec.h"
#include "mesh/vertex_normals.h"
#include "number_text.h"
#include "remesh/image_file.h"
#include "remesh/image_values.h"
#include "sphparam/io/read_options.h"
#include "sphparam/version.h"

namespace sphparam {

namespace {

using Names = std::vector<std::string>;

/// More than 10 million vertices in float take.
constexpr ImageLimits large_image = {.decoded_megabytes = 4096};

constexpr char map_text[] = "sphparam:map";    // names what an image is of
constexpr char type_text[] = "sphparam:type";  // and of properties their type, as in a PLY

bool is_colour(const std::string& what) { return what == "color" || what == "colour"; }

Names properties_of(const std::string& what) {
  return is_colour(what) ? Names{"red", "green", "blue"} : Names{what};
}

struct Channels {
  std::vector<double> values;
  int count;
  std::optional<ScalarType> type = std::nullopt;  // of a property
};

Channels properties(const MeshFile& file, const std::string& what) {
  std::vector<const Property*> channels;
  for (const std::string& name : properties_of(what)) {
    const Property* property = file.find_vertex_property(name);
    if (!property) throw NoSuchProperty("the new mesh has no " + what);
    channels.push_back(property);
  }
  Channels result{{}, static_cast<int>(channels.size()), channels.front()->type};
  for (size_t v = 0; v < channels.front()->values.size(); ++v) {
    for (const Property* channel : channels) result.values.push_back(channel->values[v]);
  }
  return result;
}

/// Labels come back as they are, or not at all. Throws std::range_error.
void require_room(const Channels& channels, const std::string& what, ImageDepth depth) {
  if (!channels.type || is_floating(*channels.type) || channels.values.empty()) return;
  constexpr double of_16_bits = 65535, of_half = 2048, of_float = 16777216;
  const auto [least, greatest] = std::ranges::minmax(channels.values);
  const double size = std::max(std::abs(least), std::abs(greatest));
  const bool fits = depth == ImageDepth::Uint16
                        ? greatest - least <= of_16_bits
                        : size <= (depth == ImageDepth::Half ? of_half : of_float);
  if (fits) return;
  throw std::range_error(what + ": whole numbers from " + shortest(least) + " to " +
                         shortest(greatest) + " are not told apart by " + name_of(depth) +
                         (depth == ImageDepth::Float ? "" : "; float has those to 16777216"));
}

Channels channels_of(const MeshFile& file, const std::string& what) {
  if (what != "position" && what != "normal") return properties(file, what);
  const Points rows = what == "normal" ? vertex_normals(file.mesh) : file.mesh.positions;
  return {{rows.data(), rows.data() + rows.size()}, 3};
}

GridSpec spec_with_image(const Remeshed& mesh) {
  if (mesh.spec() && has_image_layout(*mesh.spec())) return *mesh.spec();
  throw std::invalid_argument("images are of octa and cube grids, not of " + mesh.name());
}

SampleType sample_type(ImageDepth depth) {
  return depth == ImageDepth::Uint16 ? SampleType::Uint16
         : depth == ImageDepth::Half ? SampleType::Half
                                     : SampleType::Float;
}

/// Where the texts of an image name what it is of, it must be of that.
void require_image_of(const std::string& path, const std::string& what, const ImageTexts& texts) {
  for (const auto& [key, named] : texts) {
    if (key != map_text || named == what || (is_colour(named) && is_colour(what))) continue;
    throw ImageError(path + ": the image of " + quoted(named) + ", not of " + quoted(what) +
                     "; give it as " +
                     (named == "position" ? "IMAGE"
                      : named == "normal" ? "--normals"
                                          : "--attribute NAME=FILE, with that name"));
  }
}

/// What the mesh had the numbers of an image as; nothing where it does not say so.
std::optional<ScalarType> type_in(const ImageTexts& texts) {
  const auto found = std::ranges::find(texts, type_text, &ImageTexts::value_type::first);
  ScalarType type = ScalarType::Int64;
  if (found == texts.end()) return std::nullopt;
  if (found->second == ply_name(type) || parse_ply_name(found->second, type)) return type;
  return std::nullopt;
}

struct Contents : ImageContents {
  std::optional<ScalarType> type = std::nullopt;
};

Contents read_contents(const std::string& path, const std::string& what, int threads) {
  ImageTexts texts;
  const Image image = read_image(path, large_image, &texts);
  require_image_of(path, what, texts);
  try {
    return {read_geometry_image(image, texts, threads), type_in(texts)};
  } catch (const std::invalid_argument& error) {
    throw ImageError(path + ": no geometry image: " + error.what());
  }
}

bool all_are(ScalarType type, const std::vector<double>& values) {
  return std::ranges::all_of(values, [&](double x) { return holds_exactly(type, x); });
}

/// The type of what an image of `what` has; whole numbers are rounded to such. Colours that do not
/// say their type are bytes where they are whole numbers from 0 to 255. Throws ImageError.
ScalarType adopt_type(Contents& contents, const std::string& what, const std::string& path) {
  if (!contents.type)
    return is_colour(what) && all_are(ScalarType::Uint8, contents.values) ? ScalarType::Uint8
                                                                          : ScalarType::Float32;
  if (is_floating(*contents.type)) return ScalarType::Float32;
  for (double& x : contents.values) x = std::nearbyint(x) + 0.0;  // −0 is no whole number
  if (!all_are(*contents.type, contents.values))
    throw ImageError(path + ": holds other numbers than its " + type_text + " " +
                     std::string(ply_name(*contents.type)) + " has");
  return *contents.type;
}

/// Properties of these names from the image of `what`, of the same grid. Returns a warning, or
/// nothing.
std::string add_properties(MeshFile& file, const GridSpec& spec, const std::string& what,
                           const std::string& path, const Names& names, int threads) {
  Contents contents = read_contents(path, what, threads);
  if (contents.spec != spec || contents.channels != static_cast<int>(names.size())) {
    throw ImageError(path + ": not " + std::to_string(names.size()) + " channels of " +
                     name_of(spec));
  }
  const ScalarType type = adopt_type(contents, what, path);
  const auto count = static_cast<size_t>(file.mesh.vertex_count());
  for (size_t k = 0; k < names.size(); ++k) {
    Property property{names[k], type, std::vector<double>(count)};
    for (size_t v = 0; v < count; ++v) property.values[v] = contents.values[v * names.size() + k];
    file.set_vertex_property(std::move(property));
  }
  const bool may_be_labels =
      !contents.type && names.size() == 1 && all_are(ScalarType::Int64, contents.values);
  return may_be_labels ? path +
                             ": whole numbers, of which the image does not say whether they are "
                             "labels: they become floats, which are averaged (an image that "
                             "`remesh` makes now says it)"
                       : "";
}

MeshFile mesh_of(const ImageContents& contents, const GeometryImageFiles& files, int threads,
                 std::vector<std::string>& warnings) {
  if (contents.channels != 3) {
    throw ImageError(files.positions + ": positions have 3 channels, this has " +
                     std::to_string(contents.channels));
  }
  MeshFile file;
  file.position_type = ScalarType::Float32;
  file.mesh.positions =
      Eigen::Map<const Points>(contents.values.data(), contents.grid.directions.rows(), 3);
  adopt_triangulation(file, triangulate(file.mesh.positions, contents.grid.faces));
  if (!files.normals.empty())
    add_properties(file, contents.spec, "normal", files.normals, {"nx", "ny", "nz"}, threads);
  for (const auto& [name, path] : files.attributes) {
    std::string warning =
        add_properties(file, contents.spec, name, path, properties_of(name), threads);
    if (!warning.empty()) warnings.push_back(std::move(warning));
  }
  return file;
}

}  // namespace

void add_geometry_image(PendingFiles& files, const std::string& path, const Remeshed& mesh,
                        const std::string& what, std::optional<ImageDepth> depth) {
  const ImageDepth stored = depth_in(path, depth);
  const GridSpec spec = spec_with_image(mesh);
  const Channels channels = channels_of(mesh.file(), what);
  require_room(channels, what, stored);
  GeometryImage made =
      make_geometry_image(spec, mesh.map().points, channels.values, channels.count, stored);
  made.texts.emplace_back(map_text, what);
  if (channels.type) made.texts.emplace_back(type_text, ply_name(*channels.type));
  const std::vector<char> bytes =
      encode_image(made.image, stored == ImageDepth::Uint16 ? ImageFormat::Png : ImageFormat::Exr,
                   {.sample_type = sample_type(stored), .metadata = made.texts});
  files.add(path, {bytes.begin(), bytes.end()});
}

Remeshed load_geometry_image(const GeometryImageFiles& files, int threads, const Progress& progress,
                             std::vector<std::string>* warnings) {
  report(progress, "read", 0);
  Contents contents = read_contents(files.positions, "position", threads);
  std::vector<std::string> told;
  MeshFile file = mesh_of(contents, files, threads, told);
  if (warnings) *warnings = std::move(told);
  report(progress, "certify", 0);
  return {MappedMesh({.file = std::move(file),
                      .map = {std::move(contents.grid.directions)},
                      .provenance = {{"version", version},
                                     {"method", "unimage"},
                                     {"grid", name_of(contents.spec)},
                                     {"verdict", "one-to-one"}},
                      .polygons = std::move(contents.grid.faces),
                      .name = name_of(contents.spec)},
                     threads),
          contents.spec,
          {}};
}

}  // namespace sphparam
