// The encoder lives in the module; here is what it may be asked for, and whose bytes go where.

#include "image/image_writer.h"

#include <algorithm>
#include <exception>

#include "image/file_extension.h"
#include "image/open_module.h"

namespace sphparam::tools {
namespace {

void append_text(void* context, const char* bytes, size_t size) {
  static_cast<std::string*>(context)->append(bytes, size);
}

/// OpenImageIO's name.
const char* codec_of(ImageFormat format) {
  return format == ImageFormat::Exr ? "openexr" : name_of(format);
}

}  // namespace

std::optional<ImageFormat> image_format_of(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == ".png") return ImageFormat::Png;
  if (extension == ".exr") return ImageFormat::Exr;
  if (extension == ".jpg" || extension == ".jpeg") return ImageFormat::Jpeg;
  if (extension == ".tif" || extension == ".tiff") return ImageFormat::Tiff;
  return std::nullopt;
}

const std::vector<SampleType>& sample_types_of(ImageFormat format) {
  using enum SampleType;
  static const std::vector<SampleType> png = {Uint8, Uint16}, exr = {Half, Float}, jpeg = {Uint8},
                                       tiff = {Uint8, Uint16, Float};
  switch (format) {
    case ImageFormat::Png:
      return png;
    case ImageFormat::Exr:
      return exr;
    case ImageFormat::Jpeg:
      return jpeg;
    case ImageFormat::Tiff:
      break;
  }
  return tiff;
}

int most_channels(ImageFormat format) {
  return format == ImageFormat::Jpeg ? 3 : format == ImageFormat::Exr ? 1024 : 4;
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

bool is_integer(SampleType type) { return type == SampleType::Uint8 || type == SampleType::Uint16; }

const char* name_of(ImageFormat format) {
  switch (format) {
    case ImageFormat::Png:
      return "png";
    case ImageFormat::Exr:
      return "exr";
    case ImageFormat::Jpeg:
      return "jpeg";
    case ImageFormat::Tiff:
      return "tiff";
  }
  return "";
}

struct ImageWriter::State {
  WriteAt file;
  void* image = nullptr;
  int next_row = 0;
  std::exception_ptr thrown;  // by `file`, which C must not see
  std::string error;

  static int write(void* context, std::int64_t offset, const void* bytes, size_t size) {
    auto& state = *static_cast<State*>(context);
    if (!state.file) return 0;  // given up: whoever took the bytes may be gone
    try {
      state.file(offset, {static_cast<const char*>(bytes), size});
      return 0;
    } catch (...) {
      if (!state.thrown) state.thrown = std::current_exception();
      return 1;
    }
  }

  void check(bool failed) {
    if (thrown) std::rethrow_exception(thrown);
    if (failed) throw ImageError("cannot encode the image: " + error);
  }
};

ImageWriter::ImageWriter(const ImageFileOptions& options, WriteAt file)
    : state_(std::make_unique<State>()) {
  const std::string name = name_of(options.format);
  if (options.width <= 0 || options.height <= 0 || options.channels <= 0) {
    throw ImageError("an image without pixels cannot be written");
  }
  if (std::ranges::count(sample_types_of(options.format), options.sample_type) == 0) {
    throw ImageError(name + " images have no samples of type " + name_of(options.sample_type));
  }
  if (options.channels > most_channels(options.format)) {
    throw ImageError(name + " images have at most " +
                     std::to_string(most_channels(options.format)) + " channels, not " +
                     std::to_string(options.channels));
  }
  if (options.tiles && options.format != ImageFormat::Exr) {
    throw ImageError(name + " images have no levels");
  }
  std::vector<const char*> metadata;
  for (const auto& [key, value] : options.metadata) {
    metadata.insert(metadata.end(), {key.c_str(), value.c_str()});
  }
  state_->file = std::move(file);
  const SphparamImageFile described = {.format = codec_of(options.format),
                                       .sample_type = name_of(options.sample_type),
                                       .width = options.width,
                                       .height = options.height,
                                       .channels = options.channels,
                                       .tile = options.tiles ? tile_size : 0,
                                       .wraps = 1,
                                       .metadata = metadata.data(),
                                       .metadata_count = options.metadata.size(),
                                       .write = State::write,
                                       .context = state_.get()};
  state_->image = image_codecs().open(&described, append_text, &state_->error);
  state_->check(!state_->image);
}

ImageWriter::~ImageWriter() {
  state_->file = nullptr;
  if (state_->image) image_codecs().close(state_->image, 1, append_text, &state_->error);
}

void ImageWriter::write_rows(const void* samples, int rows) {
  const int failed = image_codecs().write_rows(state_->image, state_->next_row, rows, samples,
                                               append_text, &state_->error);
  state_->check(failed != 0);
  state_->next_row += rows;
}

void ImageWriter::begin_level(int width, int height) {
  state_->check(
      image_codecs().next_level(state_->image, width, height, append_text, &state_->error) != 0);
  state_->next_row = 0;
}

void ImageWriter::close() {
  void* image = std::exchange(state_->image, nullptr);
  state_->check(image_codecs().close(image, 0, append_text, &state_->error) != 0);
}

}  // namespace sphparam::tools
