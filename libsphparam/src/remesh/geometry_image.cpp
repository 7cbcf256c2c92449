// What vertices have as images, and images back as what vertices have.

#include "sphparam/remesh/geometry_image.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "image/image_codec.h"
#include "mesh/vertex_normals.h"
#include "remesh/image_file.h"
#include "remesh/image_values.h"
#include "sphparam/io/read_options.h"
#include "sphparam/version.h"

namespace sphparam {

namespace {

using Names = std::vector<std::string>;

/// More than 10 million vertices in float take.
constexpr ImageLimits large_image = {.decoded_megabytes = 4096};

constexpr char map_text[] = "sphparam:map";  // names what an image is of

bool is_colour(const std::string& what) { return what == "color" || what == "colour"; }

Names properties_of(const std::string& what) {
  return is_colour(what) ? Names{"red", "green", "blue"} : Names{what};
}

struct Channels {
  std::vector<double> values;
  int count;
};

Channels properties(const MeshFile& file, const std::string& what) {
  std::vector<const Property*> channels;
  for (const std::string& name : properties_of(what)) {
    const Property* property = file.find_vertex_property(name);
    if (!property) throw NoSuchProperty("the new mesh has no " + what);
    channels.push_back(property);
  }
  Channels result{{}, static_cast<int>(channels.size())};
  for (size_t v = 0; v < channels.front()->values.size(); ++v) {
    for (const Property* channel : channels) result.values.push_back(channel->values[v]);
  }
  return result;
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

ImageContents read_contents(const std::string& path, const std::string& what, int threads) {
  ImageTexts texts;
  const Image image = read_image(path, large_image, &texts);
  require_image_of(path, what, texts);
  try {
    return read_geometry_image(image, texts, threads);
  } catch (const std::invalid_argument& error) {
    throw ImageError(path + ": no geometry image: " + error.what());
  }
}

/// Properties of these names from the image of `what`, of the same grid. Whole numbers from 0 to
/// 255 of colours are bytes again.
void add_properties(MeshFile& file, const GridSpec& spec, const std::string& what,
                    const std::string& path, const Names& names, int threads) {
  const ImageContents contents = read_contents(path, what, threads);
  if (contents.spec != spec || contents.channels != static_cast<int>(names.size())) {
    throw ImageError(path + ": not " + std::to_string(names.size()) + " channels of " +
                     name_of(spec));
  }
  const bool bytes =
      is_colour(what) && std::all_of(contents.values.begin(), contents.values.end(),
                                     [](double x) { return holds_exactly(ScalarType::Uint8, x); });
  const auto count = static_cast<size_t>(file.mesh.vertex_count());
  for (size_t k = 0; k < names.size(); ++k) {
    Property property{names[k], bytes ? ScalarType::Uint8 : ScalarType::Float32,
                      std::vector<double>(count)};
    for (size_t v = 0; v < count; ++v) property.values[v] = contents.values[v * names.size() + k];
    file.set_vertex_property(std::move(property));
  }
}

MeshFile mesh_of(const ImageContents& contents, const GeometryImageFiles& files, int threads) {
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
  for (const auto& [name, path] : files.attributes)
    add_properties(file, contents.spec, name, path, properties_of(name), threads);
  return file;
}

}  // namespace

void add_geometry_image(PendingFiles& files, const std::string& path, const Remeshed& mesh,
                        const std::string& what, std::optional<ImageDepth> depth) {
  const ImageDepth stored = depth_in(path, depth);
  const GridSpec spec = spec_with_image(mesh);
  const Channels channels = channels_of(mesh.file(), what);
  GeometryImage made =
      make_geometry_image(spec, mesh.map().points, channels.values, channels.count, stored);
  made.texts.emplace_back(map_text, what);
  const std::vector<char> bytes =
      encode_image(made.image, stored == ImageDepth::Uint16 ? ImageFormat::Png : ImageFormat::Exr,
                   {.sample_type = sample_type(stored), .metadata = made.texts});
  files.add(path, {bytes.begin(), bytes.end()});
}

Remeshed load_geometry_image(const GeometryImageFiles& files, int threads,
                             const Progress& progress) {
  report(progress, "read", 0);
  ImageContents contents = read_contents(files.positions, "position", threads);
  MeshFile file = mesh_of(contents, files, threads);
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
