#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/attributes/authorship.h"
#include "io/formats/gltf/scene_origin.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

/// What a glTF 2.0 file holds that makes up a mesh, as plain data. Nothing in it is promised: every
/// index and range is checked where it is used (gltf_accessors, gltf_reader).
struct GltfDocument {
  struct View {
    int buffer = -1;
    std::uint64_t offset = 0, length = 0, stride = 0;  // stride 0: tightly packed
  };
  struct Sparse {
    std::int64_t count = 0;
    int index_view = -1, index_type = 0, value_view = -1;
    std::int64_t index_offset = 0, value_offset = 0;
  };
  struct Accessor {
    int view = -1;
    std::uint64_t offset = 0, count = 0;
    int component_type = 0;
    int components = 0;  // 1 to 4; 16 for 4 × 4 matrices, column by column; 0 for smaller ones
    bool normalised = false;
    std::optional<Sparse> sparse;
  };
  struct Primitive {
    int mode = 0;
    int indices = -1;
    int material = -1;
    std::map<std::string, int> attributes;
    std::vector<std::map<std::string, int>> targets;  // morphs: attributes to accessors
    std::vector<double> weights;                      // of these, as the mesh has them
  };
  struct Node {
    int mesh = -1;
    bool is_hidden = false;  // with all below it
    int skin = -1;
    std::map<std::string, int> instances;  // of the mesh: attributes to accessors; empty: one
    std::vector<int> children;
    std::vector<double> matrix, translation, rotation, scale;  // empty where not given
    std::vector<double> weights;  // of morphs, instead of the mesh's; empty where not given
  };
  struct Skin {
    std::vector<int> joints;         // nodes
    int inverse_bind_matrices = -1;  // −1: the identity
  };
  /// (u, v) of vertices → those of an image: scaled, turned, then moved. Source:
  /// KHR_texture_transform; positive angles turn (u, v) counter-clockwise as an image shows it.
  struct TextureTransform {
    int texcoord = 0;  // which of the vertices' sets
    std::array<double, 2> scale = {1, 1}, offset = {0, 0};
    double rotation = 0;  // radians

    bool operator==(const TextureTransform&) const = default;
  };
  struct Material {
    std::string name;
    std::string words = {};  // texture and factor in words; empty when there is no texture
    MaterialTexture base_colour = {};
    MaterialChannels channels = {};
    TextureTransform transform = {};  // of the base colour's image, else of the first one there is
    int second_texcoord = -1;         // the vertices' set of images on another one; −1: none
    std::vector<std::string> others = {};   // what else it says, in words
    std::vector<std::string> nearest = {};  // textures of `note_nearest`
  };

  std::vector<std::vector<unsigned char>> buffers;
  std::vector<View> views;
  std::vector<Accessor> accessors;
  std::vector<std::vector<Primitive>> meshes;
  std::vector<Node> nodes;
  std::vector<Skin> skins;
  std::vector<std::vector<int>> scenes;  // root nodes
  int default_scene = -1;
  std::vector<Material> materials;
  Authorship author;
  std::vector<std::string> files;  // that buffers were read from
  std::vector<std::string> notes;
};

/// Loads a glTF file, text or binary, by tinygltf, after all that it does not check is checked.
///
/// Buffers in files are read from below `folder` only; where there is none, they are refused.
/// Images inside the file that materials use are copied as they are, each once, and together no
/// more than the buffers hold; those in files are not read. Throws: ReadError.
GltfDocument load_gltf(std::string_view bytes, const std::string& name,
                       const std::optional<std::filesystem::path>& folder,
                       const ReadOptions& options, const SceneOrigin& origin = {});

}  // namespace sphparam
