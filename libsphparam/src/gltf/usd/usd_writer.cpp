// An asset as a layer: a prim of its name, in it the mesh, the materials, and the variants that
// bind one of them.

#include "sphparam/gltf/usd_writer.h"

#include <algorithm>
#include <stdexcept>

#include "gltf/images/image_kind.h"
#include "gltf/usd/usd_check.h"
#include "gltf/usd/usd_head.h"
#include "gltf/usd/usd_materials.h"
#include "io/files/stored_zip.h"
#include "number_text.h"
#include "sphparam/io/losses.h"

namespace sphparam {

namespace {

constexpr std::size_t bytes_of_vertex = 130, bytes_of_triangle = 24, bytes_of_rest = 16'384;

constexpr char bindable[] = "prepend apiSchemas = [\"MaterialBindingAPI\"]";

FloatRows as_floats(const std::vector<std::array<std::uint16_t, 4>>& colours) {
  FloatRows rows(static_cast<Eigen::Index>(colours.size()), 3);
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    for (int k = 0; k < 3; ++k)
      rows(i, k) = static_cast<float>(colours[size_t(i)][size_t(k)]) / 65535.0F;
  return rows;
}

class UsdLayer {
 public:
  UsdLayer(const Asset& asset, std::vector<std::string> files)
      : asset_(asset),
        mesh_(asset.levels.front()),
        name_(usd_name(asset.name)),
        materials_(asset, "/" + name_ + "/materials", std::move(files)),
        text_(bytes_of_rest + bytes_of_vertex * mesh_.vertex_count() +
              bytes_of_triangle * mesh_.indices.size() / 3) {}

  std::string text() {
    put_head(text_, asset_);
    open_root();
    put_mesh();
    if (!asset_.materials.empty()) put_materials();
    if (has_variants()) put_variants();
    text_.close();
    return text_.take();
  }

 private:
  bool has_variants() const { return asset_.materials.size() > 1; }

  void open_root() {
    text_.line("");
    text_.open("def Xform \"%\" (", {name_});
    text_.line("kind = \"component\"");
    if (has_variants()) {
      text_.line(bindable);
      text_.line("prepend variantSets = \"look\"");
      text_.open("variants = {");
      text_.line("string look = \"%\"", {materials_.names().front()});
      text_.close();
    }
    text_.close(")");
    text_.open("{");
  }

  void put_mesh() {
    text_.open("def Mesh \"mesh\" (");
    text_.line(bindable);
    text_.close(")");
    text_.open("{");
    if (!asset_.materials.empty())
      text_.line("rel material:binding = <%>", {materials_.path_of(0)});
    const bool two = !asset_.materials.empty() && asset_.materials.front().double_sided;
    text_.line("uniform bool doubleSided = %", {two ? "1" : "0"});
    FloatRows extent(2, 3);
    extent << mesh_.positions.colwise().minCoeff(), mesh_.positions.colwise().maxCoeff();
    text_.rows("float3[] extent", extent);
    text_.numbers("int[] faceVertexCounts",
                  std::vector<std::uint32_t>(mesh_.indices.size() / 3, 3));
    text_.numbers("int[] faceVertexIndices", mesh_.indices);
    if (mesh_.normals.size() > 0) text_.vertex_rows("normal3f[] normals", mesh_.normals);
    text_.rows("point3f[] points", mesh_.positions);
    put_primvars();
    text_.line("uniform token subdivisionScheme = \"none\"");
    put_origin(text_, mesh_.origin);
    text_.close();
  }

  void put_primvars() {
    if (!mesh_.colours.empty())
      text_.vertex_rows("color3f[] primvars:displayColor", as_floats(mesh_.colours));
    for (std::size_t i = 0; i < mesh_.texcoords.size(); ++i)
      text_.vertex_rows("texCoord2f[] primvars:st" + (i > 0 ? std::to_string(i) : std::string()),
                        upward(mesh_.texcoords[i]));
    for (const CustomAttribute& custom : mesh_.custom) {
      const Eigen::Index width = custom.values.cols();
      text_.vertex_rows("float" + (width > 1 ? std::to_string(width) : std::string()) +
                            "[] primvars:" + usd_name(custom.name),
                        custom.values);
    }
  }

  void put_materials() {
    text_.line("");
    text_.line("def Scope \"materials\"");
    text_.open("{");
    materials_.write(text_);
    text_.close();
  }

  /// By the prim above the mesh, stronger than what the mesh says: who knows no variants sees the
  /// first material.
  void put_variants() {
    text_.line("");
    text_.open("variantSet \"look\" = {");
    for (std::size_t i = 0; i < asset_.materials.size(); ++i) {
      text_.open("\"%\" {", {materials_.names()[i]});
      text_.open("rel material:binding = <%> (", {materials_.path_of(i)});
      text_.line("bindMaterialAs = \"strongerThanDescendants\"");
      text_.close(")");
      text_.close();
    }
    text_.close();
  }

  const Asset& asset_;
  const Surface& mesh_;
  std::string name_;
  UsdMaterials materials_;
  LayerText text_;
};

void require_writable(const Asset& asset) {
  if (asset.levels.empty() || asset.levels.front().indices.empty())
    throw std::invalid_argument("an asset needs a level, and each of its levels triangles");
  if (asset.quantised)
    throw std::invalid_argument("texture coordinates of 16 bits are of glTF, not of USD");
  for (const int image : images_of_usd(asset))
    if (image_kind(asset.images.at(static_cast<std::size_t>(image)).bytes).is_webp())
      throw std::invalid_argument("images of USD are PNG or JPEG, not WebP");
}

/// The layer and its images; what is before and between the name of one in the layer and its
/// file's.
UsdFiles files_of(const Asset& asset, const std::string& in_layer, const std::string& prefix) {
  require_writable(asset);
  std::vector<std::string> names;
  for (const AssetImage& image : asset.images)
    names.push_back(prefix + image.name + image_kind(image.bytes).extension);
  std::vector<std::string> in_text = names;
  for (std::string& name : in_text) name = in_layer + name;
  UsdFiles files = {{"", UsdLayer(asset, in_text).text()}};
  for (const int image : images_of_usd(asset))
    files.emplace_back(names[static_cast<std::size_t>(image)],
                       asset.images[static_cast<std::size_t>(image)].bytes);
  return files;
}

}  // namespace

UsdFiles write_usd(const Asset& asset, const std::string& stem) {
  return files_of(asset, "./", stem + "_");
}

std::string usdz_bytes(const Asset& asset) {
  constexpr std::size_t alignment = 64;
  UsdFiles files = files_of(asset, "", "textures/");
  files.front().first = usdz_layer;
  return stored_zip(files, alignment);
}

std::vector<std::string> beyond_usd(const Asset& asset) {
  std::vector<std::string> lines, words;
  const Surface& mesh = asset.levels.front();
  if (!mesh.targets.empty()) words.emplace_back("the animation");
  if (asset.levels.size() > 1) words.emplace_back("levels of detail");
  for (const Material& material : asset.materials)
    for (const std::string& name : finish_beyond_usd(material))
      if (std::ranges::count(words, name) == 0) words.push_back(name);
  if (!words.empty()) add_loss(lines, enumerated(words) + ": .glb and .gltf have room for that");
  return lines;
}

}  // namespace sphparam
