#include "image/image_codec.h"

#include <dlfcn.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "image/oiio_module.h"

// A program linked to OpenImageIO takes 0.19 s and 262 shared objects to start. So the codecs live
// in a module that is opened when the first image is touched, and is found beside the program
// (build tree) or in ../lib/sphparam (installed): both move with it.

namespace sphparam::tools {
namespace {

constexpr char kModuleName[] = "sphparam_image_oiio.so";

std::filesystem::path find_module() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) throw ImageError("cannot tell where this program is: " + error.message());
  const std::filesystem::path folder = program.parent_path();
  const std::array<std::filesystem::path, 2> candidates{
      folder / kModuleName, folder.parent_path() / "lib" / "sphparam" / kModuleName};
  for (const auto& candidate : candidates) {
    if (std::filesystem::exists(candidate, error)) return candidate;
  }
  throw ImageError(std::string("the image module ") + kModuleName + " is neither in " +
                   candidates[0].parent_path().string() + " nor in " +
                   candidates[1].parent_path().string());
}

const SphparamImageTable& open_module() {
  const std::filesystem::path path = find_module();
  // Never closed: OpenImageIO's threads run in it.
  void* module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!module) throw ImageError(std::string("cannot open the image module: ") + dlerror());
  const auto table =
      reinterpret_cast<SphparamImageTableFunction>(dlsym(module, kSphparamImageTableName));
  if (!table || table()->version != kSphparamImageTableVersion) {
    throw ImageError(path.string() + " belongs to another version of this program");
  }
  return *table();
}

const SphparamImageTable& codecs() {
  static const SphparamImageTable& table = open_module();
  return table;
}

void append_bytes(void* context, const char* bytes, size_t size) {
  auto& out = *static_cast<std::vector<char>*>(context);
  out.insert(out.end(), bytes, bytes + size);
}

void append_text(void* context, const char* bytes, size_t size) {
  static_cast<std::string*>(context)->append(bytes, size);
}

float* make_room(void* context, int width, int height, int channels) {
  auto& image = *static_cast<Image*>(context);
  try {
    image = Image(width, height, channels);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
  return image.pixels.data();
}

/// OpenImageIO's name of the format, told by the first bytes; null for what is not allowed.
const char* format_of(const std::vector<char>& bytes) {
  using namespace std::string_view_literals;
  const std::string_view head(bytes.data(), std::min<size_t>(bytes.size(), 8));
  if (head.starts_with("\x89PNG\r\n\x1a\n"sv)) return "png";
  if (head.starts_with("\xff\xd8\xff"sv)) return "jpeg";
  if (head.starts_with("II*\0"sv) || head.starts_with("MM\0*"sv)) return "tiff";
  if (head.starts_with("II+\0"sv) || head.starts_with("MM\0+"sv)) return "tiff";  // BigTIFF
  if (head.starts_with("\x76\x2f\x31\x01"sv)) return "openexr";
  return nullptr;
}

const char* name_of(SampleType type) {
  switch (type) {
    case SampleType::Uint8:
      return "uint8";
    case SampleType::Uint16:
      return "uint16";
    case SampleType::Half:
      return "half";
    case SampleType::Float:
      return "float";
  }
  return "";
}

bool suits(ImageFormat format, SampleType type) {
  const bool integer = type == SampleType::Uint8 || type == SampleType::Uint16;
  return integer == (format == ImageFormat::Png);
}

std::vector<char> read_bytes(const std::string& path, const ImageLimits& limits) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw ImageError(path + ": " + error.message());
  if (size > static_cast<std::uintmax_t>(limits.file_bytes)) {
    throw ImageError(path + ": " + std::to_string(size) + " bytes, more than the limit of " +
                     std::to_string(limits.file_bytes));
  }
  std::vector<char> bytes(size);
  std::ifstream file(path, std::ios::binary);
  if (!file.read(bytes.data(), static_cast<std::streamsize>(size))) {
    throw ImageError(path + ": cannot be read");
  }
  return bytes;
}

}  // namespace

Image decode_image(const std::vector<char>& bytes, std::string_view name,
                   const ImageLimits& limits) {
  const std::string prefix = std::string(name) + ": ";
  const char* format = format_of(bytes);
  if (!format) throw ImageError(prefix + "not a PNG, JPEG, TIFF or EXR image");
  Image image;
  std::string error;
  if (codecs().decode(format, bytes.data(), bytes.size(), limits.decoded_megabytes, limits.channels,
                      make_room, &image, append_text, &error) != 0) {
    throw ImageError(prefix + (error.empty() ? "broken image" : error));
  }
  return image;
}

Image read_image(const std::string& path, const ImageLimits& limits) {
  return decode_image(read_bytes(path, limits), path, limits);
}

std::vector<char> encode_image(const Image& image, ImageFormat format,
                               const ImageWriteOptions& options) {
  if (image.width <= 0 || image.height <= 0 || image.channels <= 0) {
    throw ImageError("an image without pixels cannot be written");
  }
  const char* name = format == ImageFormat::Png ? "png" : "exr";
  if (!suits(format, options.sample_type)) {
    throw ImageError(std::string(name) + " images have no samples of type " +
                     name_of(options.sample_type));
  }
  if (format == ImageFormat::Png && image.channels > 4) {
    throw ImageError("png images have at most 4 channels");
  }
  std::vector<const char*> metadata;
  for (const auto& [key, value] : options.metadata) {
    metadata.push_back(key.c_str());
    metadata.push_back(value.c_str());
  }
  std::vector<char> bytes;
  std::string error;
  if (codecs().encode(name, name_of(options.sample_type), image.pixels.data(), image.width,
                      image.height, image.channels, metadata.data(), options.metadata.size(),
                      append_bytes, &bytes, append_text, &error) != 0) {
    throw ImageError(std::string("cannot encode the image as ") + name + ": " + error);
  }
  return bytes;
}

void write_image(const std::string& path, const Image& image, const ImageWriteOptions& options) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension != ".png" && extension != ".exr") {
    throw ImageError(path + ": images are written as .png or .exr");
  }
  const ImageFormat format = extension == ".png" ? ImageFormat::Png : ImageFormat::Exr;
  const std::vector<char> bytes = encode_image(image, format, options);
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw ImageError(path + ": cannot be written");
}

}  // namespace sphparam::tools
