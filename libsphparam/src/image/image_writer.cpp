// The encoder lives in the module; here is what it may be asked for, whose bytes go where, and
// whether what came of it is what was meant.

#include "image/image_writer.h"

#include <algorithm>
#include <exception>

#include "image/meant_rows.h"
#include "image/open_module.h"
#include "image/sinks.h"
#include "sphparam/io/paths.h"

namespace sphparam {
namespace {

constexpr std::uint64_t no_bytes = 0xcbf29ce484222325;

/// FNV-1a, so that it does not matter in which parts the bytes come.
std::uint64_t digest_with(std::uint64_t digest, const void* bytes, size_t size) {
  const auto* const first = static_cast<const unsigned char*>(bytes);
  for (const unsigned char* byte = first; byte != first + size; ++byte)
    digest = (digest ^ *byte) * 0x100000001b3;
  return digest;
}

/// OpenImageIO's name.
const char* codec_of(ImageFormat format) {
  return format == ImageFormat::Exr ? "openexr" : name_of(format);
}

}  // namespace

ImagePlace in_memory(std::vector<char>& bytes) {
  return {[&bytes](std::int64_t offset, std::string_view part) {
            const auto at = static_cast<size_t>(offset);
            if (bytes.size() < at + part.size()) bytes.resize(at + part.size());
            part.copy(bytes.data() + at, part.size());
          },
          [&bytes](std::int64_t offset, char* part, size_t size) {
            const auto at = static_cast<size_t>(offset);
            const size_t count = at < bytes.size() ? std::min(size, bytes.size() - at) : 0;
            std::copy_n(bytes.data() + std::min(at, bytes.size()), count, part);
            return count;
          }};
}

struct ImageWriter::State {
  ImageFileOptions options;
  ImagePlace file;
  void* image = nullptr;
  int next_row = 0;
  std::int64_t size = 0;            // of the file
  std::uint64_t digest = no_bytes;  // of the bytes of a JPEG file, which are written in turn
  std::exception_ptr thrown = {};   // by `file`, which C must not see
  std::string error = {};

  struct Level {
    int width, height;
    MeantRows rows;
  };
  std::vector<Level> levels = {};

  /// Gives an image that is not closed up, also where the writer throws before there is one.
  ~State() {
    file = {};
    if (image) image_codecs().close(image, 1, into(error));
  }

  static int write(void* context, std::int64_t offset, const void* bytes, size_t size) {
    auto& state = *static_cast<State*>(context);
    if (!state.file.write) return 0;  // given up: whoever took the bytes may be gone
    state.size = std::max(state.size, offset + static_cast<std::int64_t>(size));
    if (!state.keeps_samples()) state.digest = digest_with(state.digest, bytes, size);
    return state.guarded(
        [&] {
          state.file.write(offset, {static_cast<const char*>(bytes), size});
          return 0;
        },
        1);
  }

  static size_t read(void* context, std::int64_t offset, void* bytes, size_t size) {
    auto& state = *static_cast<State*>(context);
    if (!state.file.read) return 0;
    return state.guarded([&] { return state.file.read(offset, static_cast<char*>(bytes), size); },
                         size_t{0});
  }

  template <class Work, class Result>
  Result guarded(const Work& work, Result failed) {
    try {
      return work();
    } catch (...) {
      if (!thrown) thrown = std::current_exception();
      return failed;
    }
  }

  void check(bool failed) {
    if (thrown) std::rethrow_exception(thrown);
    if (failed) throw_told("cannot encode the image: ", error);
  }

  bool keeps_samples() const { return options.format != ImageFormat::Jpeg; }
  void add_level(int width, int height) {
    levels.push_back(
        {width, height, {width, options.channels, options.sample_type, keeps_samples()}});
  }
  void read_back();
  void require_bytes();
  void require_texts(const ImageTexts& found) const;
  void require_level(void* written, int number);
  void require_rows(void* written, int number);
};

namespace {

[[noreturn]] void refuse(const std::string& why) {
  throw_told("the image as written, read back: ", why);
}

}  // namespace

/// Where samples are not kept, the bytes are what can be compared exactly.
void ImageWriter::State::require_bytes() {
  std::uint64_t found = no_bytes;
  std::vector<char> bytes(size_t{1} << 16);
  for (std::int64_t at = 0; at < size;) {
    const size_t count = file.read(at, bytes.data(), bytes.size());
    if (count == 0) break;
    found = digest_with(found, bytes.data(), count);
    at += static_cast<std::int64_t>(count);
  }
  if (found != digest) refuse("its bytes are not those that were written");
}

/// JPEG and TIFF have no place for names, so all texts are one.
void ImageWriter::State::require_texts(const ImageTexts& found) const {
  const bool has_names = options.format == ImageFormat::Png || options.format == ImageFormat::Exr;
  for (const auto& wanted : options.metadata) {
    if (!wanted.first.starts_with("sphparam:")) continue;
    const std::string line = wanted.first + "=" + wanted.second;
    const bool there = std::ranges::any_of(found, [&](const auto& text) {
      return has_names
                 ? text == wanted
                 : text.first == "ImageDescription" && text.second.find(line) != std::string::npos;
    });
    if (!there) refuse("its metadata lack " + wanted.first);
  }
}

void ImageWriter::State::require_level(void* written, int number) {
  const Level& level = levels[static_cast<size_t>(number)];
  SphparamImageLevel found{};
  if (image_codecs().level_written(written, number, &found) != 0)
    refuse("level " + std::to_string(number) + " is missing");
  const bool as_meant = found.width == level.width && found.height == level.height &&
                        found.channels == options.channels &&
                        found.tile == (options.tiles ? tile_size : 0) &&
                        found.sample_type == std::string_view(name_of(options.sample_type));
  if (!as_meant) {
    refuse(std::to_string(found.width) + " x " + std::to_string(found.height) + " texels with " +
           std::to_string(found.channels) + " channels of " + found.sample_type + ", not " +
           std::to_string(level.width) + " x " + std::to_string(level.height) + " with " +
           std::to_string(options.channels) + " of " + name_of(options.sample_type));
  }
  if (level.rows.count() != level.height) refuse("rows are missing");
}

void ImageWriter::State::require_rows(void* written, int number) {
  const Level& level = levels[static_cast<size_t>(number)];
  std::vector<float> samples(static_cast<size_t>(level.width) *
                             static_cast<size_t>(options.channels) * MeantRows::rows_at_once);
  for (int row = 0; row < level.height; row += MeantRows::rows_at_once) {
    const int rows = std::min(MeantRows::rows_at_once, level.height - row);
    error.clear();
    const bool failed =
        image_codecs().read_rows(written, number, row, rows, samples.data(), into(error)) != 0;
    if (thrown) std::rethrow_exception(thrown);
    const std::string why = failed ? error : level.rows.difference(samples.data(), row, rows);
    if (failed || !why.empty()) refuse(why);
  }
}

void ImageWriter::State::read_back() {
  const SphparamImageTable& codecs = image_codecs();
  if (!keeps_samples()) require_bytes();
  ImageTexts texts;
  error.clear();
  const std::unique_ptr<void, void (*)(void*)> written(
      codecs.open_written(codec_of(options.format), {read, this}, size, into(texts), into(error)),
      codecs.close_written);
  if (thrown) std::rethrow_exception(thrown);
  if (!written) refuse(error);
  require_texts(texts);
  for (int number = 0; number < static_cast<int>(levels.size()); ++number) {
    require_level(written.get(), number);
    require_rows(written.get(), number);
  }
}

namespace {

/// Throws: ImageError for what the format has no room for.
void require_room(const ImageFileOptions& options) {
  const std::string name = name_of(options.format);
  if (options.width <= 0 || options.height <= 0 || options.channels <= 0)
    throw ImageError("an image without pixels cannot be written");
  if (std::ranges::count(sample_types_of(options.format), options.sample_type) == 0)
    throw ImageError(name + " images have no samples of type " + name_of(options.sample_type));
  if (options.channels > most_channels(options.format)) {
    throw ImageError(name + " images have at most " +
                     std::to_string(most_channels(options.format)) + " channels, not " +
                     std::to_string(options.channels));
  }
  // Beyond it libjpeg ends the process.
  if (const int most = most_texels_a_side(options.format);
      std::max(options.width, options.height) > most) {
    throw ImageError(name + " images have at most " + std::to_string(most) +
                     " texels a side, not " + std::to_string(options.width) + " x " +
                     std::to_string(options.height));
  }
  if (options.tiles && options.format != ImageFormat::Exr)
    throw ImageError(name + " images have no levels");
}

}  // namespace

ImageWriter::ImageWriter(const ImageFileOptions& options, ImagePlace file)
    : state_(std::make_unique<State>(State{options, std::move(file)})) {
  require_room(options);
  std::vector<const char*> metadata;
  for (const auto& [key, value] : options.metadata) {
    metadata.insert(metadata.end(), {key.c_str(), value.c_str()});
  }
  const SphparamImageFile described = {.format = codec_of(options.format),
                                       .sample_type = name_of(options.sample_type),
                                       .width = options.width,
                                       .height = options.height,
                                       .channels = options.channels,
                                       .tile = options.tiles ? tile_size : 0,
                                       .wraps = 1,
                                       .metadata = metadata.data(),
                                       .metadata_count = options.metadata.size(),
                                       .file = {State::write, state_.get()}};
  state_->image = image_codecs().open(&described, into(state_->error));
  state_->check(!state_->image);
  state_->add_level(options.width, options.height);
}

ImageWriter::~ImageWriter() = default;

void ImageWriter::write_rows(const void* samples, int rows) {
  const int failed = image_codecs().write_rows(state_->image, state_->next_row, rows, samples,
                                               into(state_->error));
  state_->check(failed != 0);
  state_->levels.back().rows.add(samples, rows);
  state_->next_row += rows;
}

void ImageWriter::begin_level(int width, int height) {
  state_->check(image_codecs().next_level(state_->image, width, height, into(state_->error)) != 0);
  state_->next_row = 0;
  state_->add_level(width, height);
}

void ImageWriter::close() {
  void* image = std::exchange(state_->image, nullptr);
  state_->check(image_codecs().close(image, 0, into(state_->error)) != 0);
  state_->read_back();
}

}  // namespace sphparam
