// Geometry images of `sphparam remesh`: what each vertex has, laid out as the grid says.

#include "commands/remesh_images.h"

#include <stdexcept>
#include <utility>

#include "console/paths.h"
#include "sphparam/io/paths.h"
#include "image/image_codec.h"
#include "mesh/vertex_normals.h"

namespace sphparam::cli {

namespace {

ImageDepth depth_for(const RemeshArguments& arguments, const std::string& path) {
  return arguments.depth.value_or(extension_of(path) == ".png" ? ImageDepth::Uint16
                                                               : ImageDepth::Float);
}

struct Channels {
  std::vector<double> values;
  int count;
};

Channels properties(const MeshFile& file, const std::string& what) {
  const bool colour = what == "color" || what == "colour";
  std::vector<const Property*> channels;
  for (const std::string& name :
       colour ? std::vector<std::string>{"red", "green", "blue"} : std::vector<std::string>{what}) {
    const Property* property = file.find_vertex_property(name);
    if (!property) throw UsageMistake("--attribute-image: the new mesh has no " + what);
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

}  // namespace

std::vector<ImageRequest> images_asked_for(const RemeshArguments& arguments) {
  std::vector<ImageRequest> requests;
  if (!arguments.geometry_image.empty()) requests.push_back({"position", arguments.geometry_image});
  if (!arguments.normal_image.empty()) requests.push_back({"normal", arguments.normal_image});
  for (const std::string& text : arguments.attribute_images) {
    const size_t equals = text.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == text.size()) {
      throw UsageMistake("--attribute-image: expected NAME=FILE, not " + text);
    }
    requests.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return requests;
}

void check_images(const RemeshArguments& arguments, const std::optional<GridSpec>& spec) {
  for (const ImageRequest& request : images_asked_for(arguments)) {
    if (!spec || !has_image_layout(*spec)) {
      throw UsageMistake("images are of octa and cube grids, not of " + arguments.grid);
    }
    const std::string extension = extension_of(request.path);
    if (extension != ".png" && extension != ".exr") {
      throw UsageMistake(request.path + ": images are written as .png or .exr");
    }
    const bool integers = depth_for(arguments, request.path) == ImageDepth::Uint16;
    if (integers != (extension == ".png")) {
      throw UsageMistake(request.path + ": half and float go into .exr, u16 into .png");
    }
  }
}

void add_images(PendingFiles& files, const RemeshArguments& arguments, const GridSpec& spec,
                const Remeshed& result) {
  for (const ImageRequest& request : images_asked_for(arguments)) {
    const Channels channels = channels_of(result.file, request.what);
    const ImageDepth depth = depth_for(arguments, request.path);
    GeometryImage made;
    try {
      made = make_geometry_image(spec, result.map.points, channels.values, channels.count, depth);
    } catch (const std::range_error& error) {
      throw UsageMistake("--depth: " + request.what + ": " + error.what());
    }
    made.texts.emplace_back("sphparam:map", request.what);
    const bool png = depth == ImageDepth::Uint16;
    const SampleType type = png                         ? SampleType::Uint16
                            : depth == ImageDepth::Half ? SampleType::Half
                                                        : SampleType::Float;
    const std::vector<char> bytes =
        encode_image(made.image, png ? ImageFormat::Png : ImageFormat::Exr,
                     {.sample_type = type, .metadata = made.texts});
    files.add(request.path, {bytes.begin(), bytes.end()});
  }
}

}  // namespace sphparam::cli
