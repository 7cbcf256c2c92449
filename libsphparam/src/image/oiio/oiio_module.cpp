#include "image/oiio_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "image/oiio/callers_file.h"
#include "image/oiio/colour_profile.h"
#include "image/oiio/jpeg.h"
#include "image/oiio/png_texts.h"
#include "image/oiio/webp_codec.h"

// The only code that knows OpenImageIO. Files are decoded from memory by the decoder that the
// caller named after looking at the first bytes: Debian's build has 29 of them, some of which have
// known holes, and would choose by content itself.

namespace {

void tell(SphparamBytesSink sink, void* context, const std::string& text) {
  sink(context, text.data(), text.size());
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

/// A compressed image cannot grow without bound: deflate, the best of these codecs at it, reaches
/// 1032:1. Small images are let pass whatever they claim.
bool grows_too_much(int64_t decoded, size_t file) {
  constexpr int64_t harmless = int64_t{16} << 20, most_per_byte = 1100;
  return decoded > harmless && decoded / most_per_byte > static_cast<int64_t>(file);
}

/// Empty, or why the image is refused.
std::string refusal(const OIIO::ImageSpec& spec, size_t file_size, int64_t max_megabytes,
                    int max_channels) {
  if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels <= 0) {
    return "not a flat image with at least one pixel";
  }
  if (spec.deep) return "deep images are not supported";
  if (spec.nchannels > max_channels) {
    return std::to_string(spec.nchannels) + " channels, more than the limit of " +
           std::to_string(max_channels);
  }
  const auto decoded = static_cast<int64_t>(spec.width) * spec.height * spec.nchannels *
                       static_cast<int64_t>(spec.format.size());
  if (decoded > (max_megabytes << 20)) {
    return std::to_string(spec.width) + " x " + std::to_string(spec.height) +
           " pixels are more than the limit of " + std::to_string(max_megabytes) + " MB";
  }
  if (grows_too_much(decoded, file_size)) return "claims to be far larger than its bytes can hold";
  return "";
}

/// WebP needs next to no bytes for one colour, however large: it may grow as much as it likes.
std::string refusal(const WebpHead& head, int64_t max_megabytes, int max_channels) {
  constexpr size_t any_size = std::numeric_limits<int64_t>::max();
  const OIIO::ImageSpec spec(head.width, head.height, head.channels, OIIO::TypeDesc::UINT8);
  return refusal(spec, any_size, max_megabytes, max_channels);
}

/// Whether an EXR has pixels for another part of the plane than the one that is to be seen.
bool has_other_window(const OIIO::ImageSpec& spec, std::string_view format) {
  return format == "openexr" && (spec.x != spec.full_x || spec.y != spec.full_y ||
                                 spec.width != spec.full_width || spec.height != spec.full_height);
}

/// What is to be seen of it: of any size, however few bytes the pixels are that it has.
OIIO::ImageSpec seen_spec(const OIIO::ImageSpec& spec) {
  OIIO::ImageSpec seen = spec;
  seen.width = spec.full_width;
  seen.height = spec.full_height;
  return seen;
}

/// Puts the pixels where they are to be seen; black, without alpha, where there are none.
void place(const std::vector<float>& pixels, const OIIO::ImageSpec& spec, float* seen) {
  const auto channels = static_cast<int64_t>(spec.nchannels);
  std::fill_n(seen, int64_t{spec.full_width} * spec.full_height * channels, 0.0F);
  const int64_t right = int64_t{spec.x} - spec.full_x, down = int64_t{spec.y} - spec.full_y;
  const int64_t first = std::max<int64_t>(0, right),
                last = std::min<int64_t>(spec.full_width, right + spec.width);
  if (first >= last) return;
  for (int64_t row = 0; row < spec.height; ++row) {
    if (row + down < 0 || row + down >= spec.full_height) continue;
    std::copy_n(&pixels[static_cast<size_t>((row * spec.width + first - right) * channels)],
                (last - first) * channels,
                seen + ((row + down) * spec.full_width + first) * channels);
  }
}

void tell_texts(const OIIO::ImageSpec& spec, SphparamTextSink text, void* context) {
  for (const OIIO::ParamValue& value : spec.extra_attribs) {
    const bool is_text = value.type() == OIIO::TypeDesc::STRING;
    if (is_text) text(context, value.name().c_str(), value.get_string().c_str());
  }
}

/// What libjpeg only warns of, painting grey: data of a JPEG that end early or are damaged. Empty:
/// nothing. Of several warnings it tells the first: where that was of the head, it says nothing of
/// the data.
std::string damage_of(OIIO::ImageInput& input, const sphparam::Jpeg& jpeg, bool head_was_told) {
  const std::string told = input.has_error() ? input.geterror() : "";
  const bool is_whole = told.empty() && !head_was_told && jpeg.has_all_scans();
  if (jpeg.lacks_end() && !is_whole)
    return "is cut off, the end of the JPEG is not there: copy or save it again";
  for (const char* const harmless : {"Adobe color transform", "SOS parameters"})
    if (told.find(harmless) != std::string::npos) return "";
  return told.empty() ? "" : "damaged, or ends early: " + told;
}

int decode(const char* format, const char* bytes, size_t size, int64_t max_megabytes,
           int max_channels, SphparamPixelRoom room, void* room_context, SphparamTextSink text,
           void* text_context, SphparamBytesSink error, void* error_context) try {
  OIIO::attribute("limits:imagesize_MB", static_cast<int>(max_megabytes));
  OIIO::attribute("limits:channels", max_channels);
  const auto fail = [&](const std::string& why) {
    tell(error, error_context, why);
    return 1;
  };
  if (const std::optional<WebpHead> head = webp_head(bytes, size)) {
    const std::string refused = refusal(*head, max_megabytes, max_channels);
    if (!refused.empty()) return fail(refused);
    return decode_webp(*head, bytes, size, room, room_context, error, error_context);
  }
  const bool is_jpeg = std::string_view(format) == "jpeg";
  const sphparam::Jpeg jpeg({bytes, size});
  const std::string ended = is_jpeg && jpeg.lacks_end() ? jpeg.with_end() : "";
  const std::string_view all = ended.empty() ? std::string_view(bytes, size) : ended;
  // From memory only, whatever the decoder would like to open.
  OIIO::Filesystem::IOMemReader memory(const_cast<char*>(all.data()), all.size());
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format, false);
  if (!input) return fail(OIIO::geterror());
  OIIO::ImageSpec config, spec;
  config.attribute("oiio:UnassociatedAlpha", 1);
  if (!input->set_ioproxy(&memory)) return fail("this decoder cannot read from memory");
  if (!input->open(std::string("memory.") + format, spec, config)) return fail(input->geterror());
  // Of the head, where stray bytes do no harm.
  const bool head_was_told = is_jpeg && !input->geterror().empty();
  const std::string refused = refusal(spec, size, max_megabytes, max_channels);
  if (!refused.empty()) return fail(refused);
  const bool is_placed = has_other_window(spec, format);
  const OIIO::ImageSpec seen = is_placed ? seen_spec(spec) : spec;
  constexpr size_t any_size = std::numeric_limits<int64_t>::max();
  const std::string too_large = refusal(seen, any_size, max_megabytes, max_channels);
  if (!too_large.empty()) return fail(too_large);
  if (text) tell_texts(spec, text, text_context);
  const std::string profile = text ? sphparam::other_profile(spec) : "";
  if (!profile.empty()) text(text_context, sphparam_other_profile, profile.c_str());
  float* const pixels = room(room_context, seen.width, seen.height, seen.nchannels);
  if (!pixels) return fail(sphparam_image_no_memory);
  std::vector<float> apart;
  if (is_placed) apart.resize(spec.image_pixels() * static_cast<size_t>(spec.nchannels));
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT,
                         is_placed ? apart.data() : pixels)) {
    return fail(input->geterror());
  }
  if (is_jpeg) {
    const std::string damage = damage_of(*input, jpeg, head_was_told);
    if (!damage.empty()) return fail(damage);
    if (text && !ended.empty()) text(text_context, sphparam_lacks_end, "1");
  }
  if (is_placed) place(apart, spec, pixels);
  return 0;
} catch (const std::exception& e) {
  tell(error, error_context, words_of(e));
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
int guarded(SphparamBytesSink error, void* error_context, const Codec& codec,
            const Work& work) try {
  if (work()) return 0;
  tell(error, error_context, codec.geterror());
  return 1;
} catch (const std::exception& e) {
  tell(error, error_context, words_of(e));
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

OIIO::ImageSpec spec_of(const SphparamImageFile& file) {
  const std::string format = file.format;
  OIIO::ImageSpec spec(file.width, file.height, file.channels, OIIO::TypeDesc(file.sample_type));
  spec.attribute("oiio:UnassociatedAlpha", 1);
  // Beside one value OpenImageIO takes a channel for nothing, and the file would not name it.
  if (format == "tiff" && file.channels == 2) {
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
  if (file.tile > 0) {
    spec.tile_width = spec.tile_height = file.tile;
    spec.tile_depth = 1;
    spec.attribute("textureformat", "Plain Texture");
    spec.attribute("openexr:levelmode", 1);     // mipmap
    spec.attribute("openexr:roundingmode", 0);  // down
    if (file.wraps) spec.attribute("wrapmodes", "periodic,clamp");
  }
  // JPEG and TIFF have no place for names of ours.
  std::string all;
  for (size_t i = 0; i < file.metadata_count; ++i) {
    const std::string name = file.metadata[2 * i], value = file.metadata[2 * i + 1];
    if (format != "png" || !sphparam::needs_utf8(value)) spec.attribute(name, value);
    if (name.starts_with("sphparam:")) all += (all.empty() ? "" : "\n") + name + "=" + value;
  }
  const bool one_text = format == "jpeg" || format == "tiff";
  if (one_text && !all.empty()) spec.attribute("ImageDescription", all);
  return spec;
}

OIIO::TypeDesc type_of_rows(const OIIO::ImageSpec& spec) {
  return spec.format == OIIO::TypeDesc::HALF ? OIIO::TypeDesc(OIIO::TypeDesc::FLOAT) : spec.format;
}

void* open(const SphparamImageFile* file, SphparamBytesSink error, void* error_context) try {
  auto image = std::make_unique<OpenImage>(
      OpenImage{{sphparam::CallersFile::Write, file->write, nullptr, file->context, 0},
                nullptr,
                spec_of(*file),
                {}});
  image->type = type_of_rows(image->spec);
  if (std::string_view(file->format) == "png") image->file.add_png_texts(png_texts_of(*file));
  image->output = OIIO::ImageOutput::create(file->format);
  if (!image->output) {
    tell(error, error_context, OIIO::geterror());
    return nullptr;
  }
  if (!image->output->set_ioproxy(&image->file) ||
      !image->output->open(std::string("memory.") + file->format, image->spec)) {
    tell(error, error_context, image->output->geterror());
    return nullptr;
  }
  return image.release();
} catch (const std::exception& e) {
  tell(error, error_context, words_of(e));
  return nullptr;
}

int write_rows(void* handle, int first_row, int rows, const void* samples, SphparamBytesSink error,
               void* error_context) {
  auto& image = *static_cast<OpenImage*>(handle);
  image.next_row = first_row + rows;
  return guarded(error, error_context, *image.output, [&] {
    return image.spec.tile_width > 0
               ? image.output->write_tiles(0, image.spec.width, first_row, first_row + rows, 0, 1,
                                           image.type, samples)
               : image.output->write_scanlines(first_row, first_row + rows, 0, image.type, samples);
  });
}

int next_level(void* handle, int width, int height, SphparamBytesSink error, void* error_context) {
  auto& image = *static_cast<OpenImage*>(handle);
  image.spec.width = image.spec.full_width = width;
  image.spec.height = image.spec.full_height = height;
  return guarded(error, error_context, *image.output, [&] {
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

int close(void* handle, int give_up, SphparamBytesSink error, void* error_context) {
  const std::unique_ptr<OpenImage> image(static_cast<OpenImage*>(handle));
  if (give_up && std::string_view(image->output->format_name()) == "png")
    guarded(error, error_context, *image->output, [&] { return write_noise(*image); });
  const int failed =
      guarded(error, error_context, *image->output, [&] { return image->output->close(); });
  image->output.reset();
  return give_up ? 0 : failed;
}

/// A file that is read back. The decoder goes before the file it reads from.
struct WrittenImage {
  std::vector<char> bytes;  // of JPEG, whose decoder reads from memory only
  std::unique_ptr<OIIO::Filesystem::IOProxy> file;
  std::unique_ptr<OIIO::ImageInput> input;
};

std::unique_ptr<WrittenImage> written_image(const std::string& format, SphparamBytesFrom read,
                                            void* context, size_t size) {
  auto image = std::make_unique<WrittenImage>();
  if (format == "jpeg") {
    image->bytes.resize(size);
    image->bytes.resize(read(context, 0, image->bytes.data(), size));
    image->file =
        std::make_unique<OIIO::Filesystem::IOMemReader>(image->bytes.data(), image->bytes.size());
  } else {
    image->file = std::make_unique<sphparam::CallersFile>(sphparam::CallersFile::Read, nullptr,
                                                          read, context, size);
  }
  image->input = OIIO::ImageInput::create(format, false);
  return image;
}

void* open_written(const char* format, SphparamBytesFrom read, void* context, int64_t size,
                   SphparamTextSink text, void* text_context, SphparamBytesSink error,
                   void* error_context) try {
  OIIO::attribute("limits:imagesize_MB", 0);
  OIIO::attribute("limits:channels", 0);
  auto image = written_image(format, read, context, static_cast<size_t>(size));
  const auto fail = [&](const std::string& why) {
    tell(error, error_context, why);
    return nullptr;
  };
  if (!image->input) return fail(OIIO::geterror());
  OIIO::ImageSpec config, spec;
  config.attribute("oiio:UnassociatedAlpha", 1);
  if (!image->input->set_ioproxy(image->file.get()) ||
      !image->input->open(std::string("memory.") + format, spec, config)) {
    return fail(image->input->geterror());
  }
  tell_texts(spec, text, text_context);
  return image.release();
} catch (const std::exception& e) {
  tell(error, error_context, words_of(e));
  return nullptr;
}

int level_written(void* handle, int level, SphparamImageLevel* out) {
  const OIIO::ImageSpec spec = static_cast<WrittenImage*>(handle)->input->spec_dimensions(0, level);
  if (spec.format == OIIO::TypeDesc::UNKNOWN) return 1;
  *out = {spec.format.c_str(), spec.width, spec.height, spec.nchannels, spec.tile_width};
  return 0;
}

int read_rows(void* handle, int level, int first_row, int rows, void* samples,
              SphparamBytesSink error, void* error_context) {
  OIIO::ImageInput& input = *static_cast<WrittenImage*>(handle)->input;
  return guarded(error, error_context, input, [&] {
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
