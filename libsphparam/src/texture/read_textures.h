#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "image/image_codec.h"
#include "sphparam/io/mesh_file.h"
#include "texture/source_texture.h"

namespace sphparam {

/// A texture of the user's own for all of the mesh.
/// Throws: ImageError.
SourceTexture read_texture(const MeshFile& file, const std::string& path, TextureWrap wrap,
                           int threads);

/// The textures of a file's materials, decoded; empty where it has none. An image that several
/// materials use is decoded once.
/// Throws: ImageError that names material and image, for one that is missing, broken or unusable.
std::vector<SourceTexture> read_textures(const MeshFile& file, int threads);

/// Whether images hold colours, which are sRGB but for floats, or numbers.
enum class TexelKind { Colour, Number };

/// What of an image's file is not heeded, or missing, or to be known: colours in integers are taken
/// as sRGB, whatever profile it has, floats of a TIFF that is not ours as linear light, and numbers
/// that were measured as colours; a JPEG may lack its end. `more`: what else is to be told of it.
/// Empty: nothing.
std::string file_warning(const std::string& image, const ImageTexts& texts, TexelKind kind,
                         const std::string& more = "");

/// What is to be told of them, each line once.
std::vector<std::string> warnings_of(const std::vector<SourceTexture>& textures);

/// Why a material's image cannot be used, in a line: it is not there, of no kind that is read, or
/// broken; empty where there is none, or nothing against it. Cost: that of decoding it.
std::string why_unusable(const MaterialTexture& texture);

/// Folder, path, bytes and parts of an image, by which it is known from others: names are not
/// enough, as libraries of several folders have images of the same name.
using ImageOrigin = std::tuple<std::string, std::string, std::shared_ptr<const std::vector<char>>,
                               std::shared_ptr<const SpecularGlossiness>>;
ImageOrigin origin_of(const MaterialTexture& texture);

TextureWrap wrap_of(Wrapping wrapping);

/// An image in memory, and whether it was one of heights, of which normals were made.
struct DecodedTexture {
  std::shared_ptr<const TexturePyramid> image = nullptr;
  bool heights = false;
  std::string warning = {};  // as `SourceTexture` has it
};

/// Reads textures of one kind; an image that several share is decoded once.
class TextureReader {
 public:
  TextureReader(const MeshFile& file, TexelKind kind, int threads)
      : file_(file), kind_(kind), threads_(threads) {}

  /// One of the channels, a material: its image, with the factor as the material has it.
  /// Throws: ImageError as `read_textures`.
  std::vector<SourceTexture> read(MaterialTexture MaterialChannels::*channel);
  SourceTexture read(const MaterialTexture& texture, const std::string& material);

 private:
  const MeshFile& file_;
  TexelKind kind_;
  int threads_;
  /// By what makes an image what it is; of heights the borders do too.
  std::map<std::tuple<ImageOrigin, double, Wrapping, Wrapping>, DecodedTexture> decoded_;
};

}  // namespace sphparam
