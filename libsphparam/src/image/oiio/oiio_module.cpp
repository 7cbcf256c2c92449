#include "image/oiio_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <new>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "image/oiio/callers_file.h"
#include "image/oiio/decoding.h"
#include "image/oiio/png_texts.h"
#include "image/oiio/webp_codec.h"

// The module: what OpenImageIO does, for callers that do not know of it.

namespace {

void tell(SphparamBytesSink sink, const std::string& text) {
  sink.take(sink.context, text.data(), text.size());
}

/// Where memory ran out under it, OpenImageIO's table of names keeps a lock, and aborts the program
/// that destructs it: what has been written is flushed, and the program ends as it was to end.
void end_without_destructors() {
  const auto end = [](int status, void*) {
    std::fflush(nullptr);
    _exit(status);
  };
  on_exit(end, nullptr);
}

std::string words_of(const std::exception& error) {
  if (!dynamic_cast<const std::bad_alloc*>(&error)) return error.what();
  end_without_destructors();
  return sphparam_image_no_memory;
}

int decode(const char* format, const char* bytes, size_t size, SphparamImageLimits limits,
           SphparamPixelRoom room, SphparamTextSink text, SphparamBytesSink error) try {
  OIIO::attribute("limits:imagesize_MB", static_cast<int>(limits.megabytes));
  OIIO::attribute("limits:channels", limits.channels);
  sphparam::decode_in_memory(format, {bytes, size}, limits, room, text);
  return 0;
} catch (const std::exception& e) {
  tell(error, words_of(e));
  return 1;
}

/// "YYYY:MM:DD hh:mm:ss" of SOURCE_DATE_EPOCH, so that files do not depend on the clock.
std::string reproducible_date() {
  const char* epoch = std::getenv("SOURCE_DATE_EPOCH");
  const std::time_t time = epoch ? std::atoll(epoch) : 0;
  std::tm utc{};
  gmtime_r(&time, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y:%m:%d %H:%M:%S", &utc);
  return text;
}

/// An image under way. The encoder goes before the file it writes to.
struct OpenImage {
  sphparam::CallersFile file;
  std::unique_ptr<OIIO::ImageOutput> output;
  OIIO::ImageSpec spec;
  OIIO::TypeDesc type;  // of the rows that come
  int next_row = 0;
};

template <class Codec, class Work>
int guarded(SphparamBytesSink error, const Codec& codec, const Work& work) try {
  if (work()) return 0;
  tell(error, codec.geterror());
  return 1;
} catch (const std::exception& e) {
  tell(error, words_of(e));
  return 1;
}

/// Of the texts that a PNG's usual chunks have no characters for.
std::string png_texts_of(const SphparamImageFile& file) {
  std::string chunks;
  for (size_t i = 0; i < file.metadata_count; ++i) {
    const std::string value = file.metadata[2 * i + 1];
    if (sphparam::needs_utf8(value)) chunks += sphparam::itxt_chunk(file.metadata[2 * i], value);
  }
  return chunks;
}

void describe_format(OIIO::ImageSpec& spec, const std::string& format) {
  spec.attribute("oiio:UnassociatedAlpha", 1);
  // Beside one value OpenImageIO takes a channel for nothing, and the file would not name it.
  if (format == "tiff" && spec.nchannels == 2) {
    spec.channelnames = {"Y", "A"};
    spec.alpha_channel = 1;
  }
  if (format == "openexr" || format == "tiff") {
    spec.attribute("DateTime", reproducible_date());
    spec.attribute("compression", "zip");
  }
  // A second directory, for the colour space: libtiff would have to read what it wrote, which
  // OpenImageIO does not let it. Colours in integers are sRGB for every reader without it.
  if (format == "tiff") spec.attribute("tiff:write_exif", 0);
  if (format == "png") spec.attribute("png:compressionLevel", 6);
  if (format == "jpeg") spec.attribute("compression", "jpeg:95");
}

/// As textures of renderers have it: tiles, and all levels.
void describe_tiles(OIIO::ImageSpec& spec, const SphparamImageFile& file) {
  spec.tile_width = spec.tile_height = file.tile;
  spec.tile_depth = 1;
  spec.attribute("textureformat", "Plain Texture");
  spec.attribute("openexr:levelmode", 1);     // mipmap
  spec.attribute("openexr:roundingmode", 0);  // down
  if (file.wraps) spec.attribute("wrapmodes", "periodic,clamp");
}

void add_texts(OIIO::ImageSpec& spec, const SphparamImageFile& file, const std::string& format) {
  std::string ours;
  for (size_t i = 0; i < file.metadata_count; ++i) {
    const std::string name = file.metadata[2 * i], value = file.metadata[2 * i + 1];
    if (format != "png" || !sphparam::needs_utf8(value)) spec.attribute(name, value);
    if (name.starts_with("sphparam:")) ours += (ours.empty() ? "" : "\n") + name + "=" + value;
  }
  // JPEG and TIFF have no place for names of ours.
  const bool one_text = format == "jpeg" || format == "tiff";
  if (one_text && !ours.empty()) spec.attribute("ImageDescription", ours);
}

OIIO::ImageSpec spec_of(const SphparamImageFile& file) {
  const std::string format = file.format;
  OIIO::ImageSpec spec(file.width, file.height, file.channels, OIIO::TypeDesc(file.sample_type));
  describe_format(spec, format);
  if (file.tile > 0) describe_tiles(spec, file);
  add_texts(spec, file, format);
  return spec;
}

OIIO::TypeDesc type_of_rows(const OIIO::ImageSpec& spec) {
  return spec.format == OIIO::TypeDesc::HALF ? OIIO::TypeDesc(OIIO::TypeDesc::FLOAT) : spec.format;
}

void* open(const SphparamImageFile* file, SphparamBytesSink error) try {
  auto image = std::make_unique<OpenImage>(
      OpenImage{sphparam::CallersFile(file->file), nullptr, spec_of(*file), {}});
  image->type = type_of_rows(image->spec);
  if (std::string_view(file->format) == "png") image->file.add_png_texts(png_texts_of(*file));
  image->output = OIIO::ImageOutput::create(file->format);
  if (!image->output) {
    tell(error, OIIO::geterror());
    return nullptr;
  }
  if (!image->output->set_ioproxy(&image->file) ||
      !image->output->open(std::string("memory.") + file->format, image->spec)) {
    tell(error, image->output->geterror());
    return nullptr;
  }
  return image.release();
} catch (const std::exception& e) {
  tell(error, words_of(e));
  return nullptr;
}

int write_rows(void* handle, int first_row, int rows, const void* samples,
               SphparamBytesSink error) {
  auto& image = *static_cast<OpenImage*>(handle);
  image.next_row = first_row + rows;
  return guarded(error, *image.output, [&] {
    return image.spec.tile_width > 0
               ? image.output->write_tiles(0, image.spec.width, first_row, first_row + rows, 0, 1,
                                           image.type, samples)
               : image.output->write_scanlines(first_row, first_row + rows, 0, image.type, samples);
  });
}

int next_level(void* handle, int width, int height, SphparamBytesSink error) {
  auto& image = *static_cast<OpenImage*>(handle);
  image.spec.width = image.spec.full_width = width;
  image.spec.height = image.spec.full_height = height;
  return guarded(error, *image.output, [&] {
    return image.output->open("memory.openexr", image.spec, OIIO::ImageOutput::AppendMIPLevel);
  });
}

/// libpng prints to standard error where an image ends of which no data was written yet. Noise does
/// not wait for more to be compressed with.
bool write_noise(OpenImage& image) {
  constexpr size_t enough = size_t{1} << 17;  // bytes: libpng and zlib keep less
  const size_t row = image.spec.scanline_bytes(true);
  const auto rows = std::min<std::int64_t>(image.spec.height - image.next_row,
                                           static_cast<std::int64_t>(1 + enough / row));
  if (rows <= 0) return true;
  std::vector<unsigned char> noise(static_cast<size_t>(rows) * row);
  std::minstd_rand random;
  for (unsigned char& byte : noise) byte = static_cast<unsigned char>(random() >> 8);
  return image.output->write_scanlines(image.next_row, image.next_row + static_cast<int>(rows), 0,
                                       image.type, noise.data());
}

int close(void* handle, int give_up, SphparamBytesSink error) {
  const std::unique_ptr<OpenImage> image(static_cast<OpenImage*>(handle));
  if (give_up && std::string_view(image->output->format_name()) == "png")
    guarded(error, *image->output, [&] { return write_noise(*image); });
  const int failed = guarded(error, *image->output, [&] { return image->output->close(); });
  image->output.reset();
  return give_up ? 0 : failed;
}

/// A file that is read back. The decoder goes before the file it reads from.
struct WrittenImage {
  std::vector<char> bytes;  // of JPEG, whose decoder reads from memory only
  std::unique_ptr<OIIO::Filesystem::IOProxy> file;
  std::unique_ptr<OIIO::ImageInput> input;
};

std::unique_ptr<WrittenImage> written_image(const std::string& format, SphparamBytesFrom bytes,
                                            size_t size) {
  auto image = std::make_unique<WrittenImage>();
  if (format == "jpeg") {
    image->bytes.resize(size);
    image->bytes.resize(bytes.read(bytes.context, 0, image->bytes.data(), size));
    image->file =
        std::make_unique<OIIO::Filesystem::IOMemReader>(image->bytes.data(), image->bytes.size());
  } else {
    image->file = std::make_unique<sphparam::CallersFile>(bytes, size);
  }
  image->input = OIIO::ImageInput::create(format, false);
  return image;
}

void* open_written(const char* format, SphparamBytesFrom bytes, int64_t size, SphparamTextSink text,
                   SphparamBytesSink error) try {
  OIIO::attribute("limits:imagesize_MB", 0);
  OIIO::attribute("limits:channels", 0);
  auto image = written_image(format, bytes, static_cast<size_t>(size));
  const auto fail = [&](const std::string& why) {
    tell(error, why);
    return nullptr;
  };
  if (!image->input) return fail(OIIO::geterror());
  OIIO::ImageSpec config, spec;
  config.attribute("oiio:UnassociatedAlpha", 1);
  if (!image->input->set_ioproxy(image->file.get()) ||
      !image->input->open(std::string("memory.") + format, spec, config)) {
    return fail(image->input->geterror());
  }
  sphparam::tell_texts(spec, text);
  return image.release();
} catch (const std::exception& e) {
  tell(error, words_of(e));
  return nullptr;
}

int level_written(void* handle, int level, SphparamImageLevel* out) {
  const OIIO::ImageSpec spec = static_cast<WrittenImage*>(handle)->input->spec_dimensions(0, level);
  if (spec.format == OIIO::TypeDesc::UNKNOWN) return 1;
  *out = {spec.format.c_str(), spec.width, spec.height, spec.nchannels, spec.tile_width};
  return 0;
}

int read_rows(void* handle, int level, int first_row, int rows, void* samples,
              SphparamBytesSink error) {
  OIIO::ImageInput& input = *static_cast<WrittenImage*>(handle)->input;
  return guarded(error, input, [&] {
    const OIIO::ImageSpec spec = input.spec_dimensions(0, level);
    const OIIO::TypeDesc type = type_of_rows(spec);
    const int end = first_row + rows;
    return spec.tile_width > 0 ? input.read_tiles(0, level, 0, spec.width, first_row, end, 0, 1, 0,
                                                  spec.nchannels, type, samples)
                               : input.read_scanlines(0, level, first_row, end, 0, 0,
                                                      spec.nchannels, type, samples);
  });
}

void close_written(void* handle) {
  const std::unique_ptr<WrittenImage> image(static_cast<WrittenImage*>(handle));
}

constexpr SphparamImageTable table{sphparam_image_table_version,
                                   decode,
                                   open,
                                   write_rows,
                                   next_level,
                                   close,
                                   open_written,
                                   level_written,
                                   read_rows,
                                   close_written,
                                   encode_webp};

}  // namespace

extern "C" __attribute__((visibility("default"))) const SphparamImageTable* sphparam_image_table() {
  return &table;
}
