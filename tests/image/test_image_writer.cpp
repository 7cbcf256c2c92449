#include <unistd.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "image/image_writer.h"
#include "image/meant_rows.h"
#include "image/open_module.h"
#include "image/sinks.h"
#include "support/image_headers.h"
#include "support/leaks_of_others.h"

using namespace sphparam;
using namespace sphparam::tests;
using Catch::Matchers::Contains;

namespace {

constexpr ImageFormat every_format[] = {ImageFormat::Png, ImageFormat::Tiff, ImageFormat::Exr,
                                        ImageFormat::Jpeg};

int bits_of(SampleType type) {
  return type == SampleType::Uint8 ? 8 : type == SampleType::Float ? 32 : 16;
}

/// Of the format's usual samples.
ImageFileOptions plain(ImageFormat format, int width, int height, int channels) {
  return {.width = width,
          .height = height,
          .channels = channels,
          .format = format,
          .sample_type = sample_types_of(format).front()};
}

/// Samples of all sizes: in floats from 0 to 1, in integers over their range.
std::vector<char> samples_for(const ImageFileOptions& options, int rows) {
  const auto count = static_cast<size_t>(options.width) * static_cast<size_t>(rows) *
                     static_cast<size_t>(options.channels);
  const size_t size = is_integer(options.sample_type)
                          ? (options.sample_type == SampleType::Uint8 ? 1 : 2)
                          : sizeof(float);
  std::vector<char> bytes(count * size);
  for (size_t i = 0; i < count; ++i) {
    const auto x = static_cast<std::uint32_t>(i * 2654435761U);
    const float part = static_cast<float>(x) / 4294967296.0F;
    std::memcpy(&bytes[i * size], size == 4 ? static_cast<const void*>(&part) : &x, size);
  }
  return bytes;
}

/// Writes an image of such samples; `change` may alter bytes on their way.
template <class Change>
std::vector<char> written(const ImageFileOptions& options, const Change& change) {
  std::vector<char> bytes;
  const ImagePlace memory = in_memory(bytes);
  ImageWriter writer(options, {[&](std::int64_t offset, std::string_view part) {
                                 std::string altered(part);
                                 change(offset, altered);
                                 memory.write(offset, altered);
                               },
                               memory.read});
  const std::vector<char> samples = samples_for(options, options.height);
  for (int row = 0; row < options.height; row += ImageWriter::tile_size) {
    const int rows = std::min(ImageWriter::tile_size, options.height - row);
    writer.write_rows(samples.data() + samples.size() / static_cast<size_t>(options.height) *
                                           static_cast<size_t>(row),
                      rows);
  }
  for (int w = options.width, h = options.height; options.tiles && (w > 1 || h > 1);) {
    w = std::max(1, w / 2), h = std::max(1, h / 2);
    writer.begin_level(w, h);
    ImageFileOptions level = options;
    level.width = w, level.height = h;
    const std::vector<char> part = samples_for(level, h);
    for (int row = 0; row < h; row += ImageWriter::tile_size)
      writer.write_rows(
          part.data() + part.size() / static_cast<size_t>(h) * static_cast<size_t>(row),
          std::min(ImageWriter::tile_size, h - row));
  }
  writer.close();
  return bytes;
}

std::vector<char> written(const ImageFileOptions& options) {
  return written(options, [](std::int64_t, std::string&) {});
}

}  // namespace

TEST_CASE(
    "image writer: a TIFF names its alpha beside one value and beside three, not multiplied") {
  for (const SampleType type : sample_types_of(ImageFormat::Tiff)) {
    for (int channels = 1; channels <= 4; ++channels) {
      INFO(name_of(type) << " " << channels);
      ImageFileOptions options = plain(ImageFormat::Tiff, 20, 10, channels);
      options.sample_type = type;
      const std::vector<char> bytes = written(options);
      const FileNumbers file({bytes.data(), bytes.size()}, false);
      const TiffDirectory main = tiff_directory(file, file.at(4, 4));
      constexpr unsigned extra_samples = 338;
      constexpr std::uint64_t unassociated_alpha = 2;
      REQUIRE(main.first.contains(extra_samples) == (channels % 2 == 0));
      if (channels % 2 != 0) continue;
      CHECK(main.count.at(extra_samples) == 1);
      CHECK(main.first.at(extra_samples) == unassociated_alpha);
    }
  }
}

TEST_CASE("image writer: every format, depth, kind and channel count is what its header says") {
  for (const ImageFormat format : every_format) {
    for (const SampleType type : sample_types_of(format)) {
      for (const char* kind : {"sRGB", "raw", "Linear"}) {
        for (int channels = 1; channels <= std::min(4, most_channels(format)); ++channels) {
          if (format == ImageFormat::Jpeg && channels == 2) continue;  // grey or colours
          INFO(name_of(format) << " " << name_of(type) << " " << kind << " " << channels);
          const std::vector<char> bytes =
              written({.width = 150,
                       .height = 75,
                       .channels = channels,
                       .format = format,
                       .sample_type = type,
                       .metadata = {{"sphparam:map", "basecolor"}, {"oiio:ColorSpace", kind}}});
          const ImageHeader expected{.width = 150,
                                     .height = 75,
                                     .bits = static_cast<std::uint64_t>(bits_of(type)),
                                     .channels = static_cast<std::uint64_t>(channels),
                                     .floating = !is_integer(type)};
          CHECK(image_header({bytes.data(), bytes.size()}) == expected);
        }
      }
    }
  }
}

TEST_CASE("image writer: an image without texts is one too, in every format") {
  for (const ImageFormat format : every_format) {
    INFO(name_of(format));
    const SampleType type = sample_types_of(format).front();
    CHECK_NOTHROW(
        written({.width = 8, .height = 4, .channels = 3, .format = format, .sample_type = type}));
  }
}

TEST_CASE("image writer: tiles with all levels are read back, of every size") {
  for (const int width : {1, 63, 64, 130, 256}) {
    for (const SampleType type : {SampleType::Half, SampleType::Float}) {
      INFO(width << " " << name_of(type));
      const std::vector<char> bytes = written({.width = width,
                                               .height = std::max(1, width / 2),
                                               .channels = 3,
                                               .format = ImageFormat::Exr,
                                               .sample_type = type,
                                               .tiles = true});
      const ImageHeader header = image_header({bytes.data(), bytes.size()});
      CHECK(header.tiled);
      CHECK(header.width == static_cast<std::uint64_t>(width));
    }
  }
}

TEST_CASE("image writer: a file that reads back otherwise is refused, wherever a byte changed") {
  for (const ImageFormat format : every_format) {
    for (const bool tiles : {false, true}) {
      if (tiles && format != ImageFormat::Exr) continue;
      const SampleType type = sample_types_of(format).back();
      const ImageFileOptions options{.width = 150,
                                     .height = 75,
                                     .channels = 3,
                                     .format = format,
                                     .sample_type = type,
                                     .tiles = tiles};
      const auto size = static_cast<std::int64_t>(written(options).size());
      for (const double place : {0.3, 0.6, 0.9}) {
        INFO(name_of(format) << (tiles ? " in tiles " : " ") << place);
        const auto at = static_cast<std::int64_t>(place * static_cast<double>(size));
        const auto change = [&](std::int64_t offset, std::string& bytes) {
          const std::int64_t k = at - offset;
          if (k >= 0 && k < std::ssize(bytes)) bytes[static_cast<size_t>(k)] ^= 0x20;
        };
        CHECK_THROWS_AS(written(options, change), ImageError);
      }
    }
  }
}

TEST_CASE("image writer: a text or a size that reads back otherwise is named") {
  const auto refused = [](const ImageFileOptions& options, const std::string& place, size_t beyond,
                          const std::string& why) {
    const std::vector<char> bytes = written(options);
    // TIFF writes its directory twice, and means the last.
    const size_t found = std::string_view(bytes.data(), bytes.size()).rfind(place);
    REQUIRE(found != std::string_view::npos);
    const auto at = static_cast<std::int64_t>(found + beyond);
    const auto change = [&](std::int64_t offset, std::string& part) {
      const std::int64_t k = at - offset;
      if (k >= 0 && k < std::ssize(part)) part[static_cast<size_t>(k)] ^= 0x02;
    };
    INFO(name_of(options.format));
    CHECK_THROWS_WITH(written(options, change), Contains(why));
  };
  for (const ImageFormat format : {ImageFormat::Png, ImageFormat::Tiff, ImageFormat::Exr}) {
    refused({.width = 8,
             .height = 4,
             .channels = 3,
             .format = format,
             .sample_type = sample_types_of(format).front(),
             .metadata = {{"sphparam:map", "basecolor"}}},
            "basecolor", 4, "its metadata lack sphparam:map");
  }
  // Its box: the least and the greatest x and y.
  const ImageFileOptions exr{.width = 8,
                             .height = 4,
                             .channels = 3,
                             .format = ImageFormat::Exr,
                             .sample_type = SampleType::Half};
  const std::string box("dataWindow\0box2i\0\x10\0\0\0", 21);
  refused(exr, box, box.size() + 8, "6 x 4 texels with 3 channels of half, not 8 x 4");
}

TEST_CASE("image writer: levels are of EXR alone, and only they wrap, and dates of EXR and TIFF") {
  const auto has = [](const std::vector<char>& bytes, std::string_view word) {
    return std::string_view(bytes.data(), bytes.size()).find(word) != std::string_view::npos;
  };
  for (const ImageFormat format : every_format) {
    INFO(name_of(format));
    ImageFileOptions options = plain(format, 8, 4, 3);
    const std::vector<char> rows = written(options);
    CHECK_FALSE(has(rows, "periodic,clamp"));
    CHECK(has(rows, "1970:01:01") == (format == ImageFormat::Tiff || format == ImageFormat::Exr));
    CHECK_FALSE(has(rows, "tIME"));  // of PNG
    options.tiles = true;
    if (format == ImageFormat::Exr) {
      CHECK(has(written(options), "periodic,clamp"));
    } else {
      CHECK_THROWS_WITH(written(options), Contains(name_of(format)) && Contains("no levels"));
    }
  }
}

TEST_CASE("image writer: one that is given up writes no more") {
  for (const ImageFormat format : every_format) {
    INFO(name_of(format));
    const ImageFileOptions options = plain(format, 32, 16, 1);
    std::vector<char> bytes;
    std::optional<ImageWriter> writer(std::in_place, options, in_memory(bytes));
    writer->write_rows(samples_for(options, 8).data(), 8);
    const std::vector<char> before = bytes;
    writer.reset();
    CHECK(bytes == before);
  }
}

namespace {

/// What a work writes to standard error.
template <class Work>
std::string printed_by(const Work& work) {
  std::FILE* const caught = std::tmpfile();
  const int standard = dup(STDERR_FILENO);
  std::fflush(stderr);
  dup2(fileno(caught), STDERR_FILENO);
  work();
  std::fflush(stderr);
  dup2(standard, STDERR_FILENO);
  close(standard);
  std::string text(static_cast<size_t>(lseek(fileno(caught), 0, SEEK_END)), '\0');
  std::rewind(caught);
  text.resize(std::fread(text.data(), 1, text.size(), caught));
  std::fclose(caught);
  return text;
}

}  // namespace

TEST_CASE("image writer: nothing is printed where one is given up, however little was written") {
  for (const ImageFormat format : every_format) {
    for (const auto& [width, given] : {std::pair{4096, 0}, {4096, 64}, {2, 1}, {2, 2}}) {
      const int rows = given;  // clang 14 captures no bindings
      INFO(name_of(format) << " " << width << " " << rows);
      const ImageFileOptions options = plain(format, width, width > 2 ? 2048 : 2, 3);
      const std::vector<char> blank(samples_for(options, rows).size(), 0);
      const std::string printed = printed_by([&] {
        std::vector<char> bytes;
        ImageWriter writer(options, in_memory(bytes));
        if (rows > 0) writer.write_rows(blank.data(), rows);
      });
      CHECK(printed.empty());
    }
  }
}

TEST_CASE("image writer: a file that ends early is refused") {
  for (const ImageFormat format : every_format) {
    INFO(name_of(format));
    const ImageFileOptions options = plain(format, 150, 75, 3);
    const auto most = static_cast<std::int64_t>(written(options).size()) / 2;
    CHECK_THROWS_AS(written(options,
                            [&](std::int64_t offset, std::string& bytes) {
                              const std::int64_t left = std::max<std::int64_t>(0, most - offset);
                              if (std::ssize(bytes) > left)
                                std::fill(bytes.begin() + left, bytes.end(), '\0');
                            }),
                    ImageError);
  }
}

TEST_CASE("image writer: a file that is shorter when it is read back is refused") {
  for (const ImageFormat format : every_format) {
    INFO(name_of(format));
    const LeaksOfOthers leaks;
    const ImageFileOptions options = plain(format, 150, 75, 3);
    std::vector<char> bytes;
    const ImagePlace memory = in_memory(bytes);
    ImageWriter writer(options, {memory.write, [&](std::int64_t offset, char* part, size_t size) {
                                   bytes.resize(std::min(bytes.size(), size_t{500}));
                                   return memory.read(offset, part, size);
                                 }});
    writer.write_rows(samples_for(options, options.height).data(), options.height);
    CHECK_THROWS_AS(writer.close(), ImageError);
  }
}

TEST_CASE("image writer: what the file throws comes through, the first of it") {
  for (const ImageFormat format : every_format) {
    INFO(name_of(format));
    const LeaksOfOthers leaks;
    const ImageFileOptions options = plain(format, 150, 75, 3);
    std::vector<char> bytes;
    const ImagePlace memory = in_memory(bytes);
    const std::vector<char> samples = samples_for(options, options.height);
    const auto write_all = [&](const ImagePlace& file) {
      ImageWriter writer(options, file);
      writer.write_rows(samples.data(), options.height);
      writer.close();
    };
    int thrown = 0;
    const auto fail = [&](std::int64_t, const auto&...) -> size_t {
      throw std::runtime_error("fault " + std::to_string(++thrown));
    };
    CHECK_THROWS_WITH(write_all({fail, memory.read}), "fault 1");
    thrown = 0;
    CHECK_THROWS_WITH(write_all({memory.write, fail}), "fault 1");
  }
}

TEST_CASE(
    "image writer: what the file throws while it begins comes through, and nothing is leaked") {
  for (const ImageFormat format : every_format) {
    INFO(name_of(format));
    if (format == ImageFormat::Png) continue;  // where OpenImageIO loses bytes itself
    const ImageFileOptions options = plain(format, 150, 75, 3);
    const auto begin = [&] {
      ImageWriter writer(options, {[](std::int64_t, std::string_view) -> void {
                                     throw std::runtime_error("no room");
                                   },
                                   {}});
      throw std::runtime_error("nothing is written yet");
    };
    CHECK_THROWS_AS(begin(), std::runtime_error);
  }
}

TEST_CASE("image writer: memory has no bytes beyond its end") {
  std::vector<char> bytes;
  const ImagePlace memory = in_memory(bytes);
  memory.write(2, "abc");
  CHECK(bytes == std::vector<char>{0, 0, 'a', 'b', 'c'});
  std::array<char, 4> part{};
  CHECK(memory.read(3, part.data(), part.size()) == 2);
  CHECK(part == std::array{'b', 'c', '\0', '\0'});
  CHECK(memory.read(5, part.data(), part.size()) == 0);
  CHECK(memory.read(50, part.data(), part.size()) == 0);
}

TEST_CASE("image writer: JPEG of more texels than libjpeg takes is refused, which ends processes") {
  const auto jpeg = [](int width, int height) {
    return written({.width = width,
                    .height = height,
                    .channels = 1,
                    .format = ImageFormat::Jpeg,
                    .sample_type = SampleType::Uint8});
  };
  const int most = most_texels_a_side(ImageFormat::Jpeg);
  CHECK_NOTHROW(jpeg(most, 1));
  CHECK_NOTHROW(jpeg(1, most));
  CHECK_THROWS_WITH(jpeg(most + 1, 1), Contains("at most 65500 texels a side, not 65501 x 1"));
  CHECK_THROWS_WITH(jpeg(1, most + 1), Contains("at most 65500 texels a side, not 1 x 65501"));
}

TEST_CASE("image writer: an environment map in rows has one level, in tiles all") {
  for (const bool tiles : {false, true}) {
    std::vector<char> bytes = written({.width = 256,
                                       .height = 128,
                                       .channels = 3,
                                       .format = ImageFormat::Exr,
                                       .sample_type = SampleType::Half,
                                       .tiles = tiles,
                                       .metadata = {{"textureformat", "LatLong Environment"}}});
    CHECK(image_header({bytes.data(), bytes.size()}).tiled == tiles);
    const ImagePlace memory = in_memory(bytes);
    const SphparamBytesFrom from{[](void* place, std::int64_t offset, void* part, size_t size) {
                                   return static_cast<const ImagePlace*>(place)->read(
                                       offset, static_cast<char*>(part), size);
                                 },
                                 const_cast<ImagePlace*>(&memory)};
    ImageTexts texts;
    std::string error;
    void* file =
        image_codecs().open_written("openexr", from, std::ssize(bytes), into(texts), into(error));
    REQUIRE(file != nullptr);
    for (int level = 1; level < 10; ++level) {
      SphparamImageLevel found{};
      const bool there = image_codecs().level_written(file, level, &found) == 0;
      CHECK(there == (tiles && level <= 8));
      if (there) CHECK(found.width == 256 >> level);
    }
    image_codecs().close_written(file);
  }
}

TEST_CASE("image writer: an image whose rows did not all come is refused") {
  for (const ImageFormat format : every_format) {
    INFO(name_of(format));
    const LeaksOfOthers leaks;
    std::vector<char> bytes;
    const ImageFileOptions options = plain(format, 32, 16, 1);
    CHECK_THROWS_AS(
        [&] {
          ImageWriter writer(options, in_memory(bytes));
          writer.write_rows(samples_for(options, 8).data(), 8);
          writer.close();
        }(),
        ImageError);
  }
}

TEST_CASE(
    "image writer: texts come back whatever is in them, where the format has room for names") {
  const ImageTexts odd = {{"sphparam:source", "größe \xe7\x90\x83.ply"},
                          {"sphparam:about", "two = words; \"quoted\", 100 %"},
                          {"sphparam:note", " blanks "}};
  for (const ImageFormat format : every_format) {
    INFO(name_of(format));
    CHECK_NOTHROW(written({.width = 8,
                           .height = 4,
                           .channels = 3,
                           .format = format,
                           .sample_type = sample_types_of(format).front(),
                           .metadata = odd}));
  }
}

TEST_CASE("image writer: colours that JPEG keeps worst are close enough") {
  for (const int stripe : {1, 2, 3}) {
    std::vector<char> bytes;
    ImageWriter writer({.width = 64, .height = 64, .channels = 3, .format = ImageFormat::Jpeg},
                       in_memory(bytes));
    std::vector<unsigned char> samples(size_t{64} * 64 * 3);
    for (size_t i = 0; i < samples.size(); ++i) {
      const bool yellow = i / 3 % 64 / static_cast<size_t>(stripe) % 2 != 0;
      samples[i] = yellow && i % 3 != 2 ? 255 : 0;
    }
    writer.write_rows(samples.data(), 64);
    CHECK_NOTHROW(writer.close());
  }
}

TEST_CASE("image writer: halves and floats without bounds, and what is no number, come back") {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const std::vector<float> values = {
      0,     -0.0F,  1,    1e-8F,    6e-8F,     3e-5F,         6.1e-5F, 65504,    65519,
      65520, -65520, 1e9F, infinity, -infinity, std::nanf(""), 0.1F,    1.0F / 3, 1e-40F};
  for (const SampleType type : {SampleType::Half, SampleType::Float}) {
    INFO(name_of(type));
    std::vector<char> bytes;
    ImageWriter writer({.width = static_cast<int>(values.size()),
                        .height = 1,
                        .channels = 1,
                        .format = ImageFormat::Exr,
                        .sample_type = type},
                       in_memory(bytes));
    writer.write_rows(values.data(), 1);
    CHECK_NOTHROW(writer.close());
  }
}

TEST_CASE("meant rows: halves are the nearest ones, even where two are as near") {
  CHECK(rounded_to_half(2049) == 2048);
  CHECK(rounded_to_half(2051) == 2052);
  CHECK(rounded_to_half(65519.9F) == 65504);
  CHECK(rounded_to_half(65520) == std::numeric_limits<float>::infinity());
  CHECK(rounded_to_half(-0x1p-25F) == 0);
  CHECK(std::signbit(rounded_to_half(-0x1p-25F)));
  CHECK(rounded_to_half(0x1.8p-24F) == 0x1p-23F);
  CHECK(std::isnan(rounded_to_half(std::nanf(""))));
  for (int i = 0; i < 0x7c00; ++i) {  // all halves are themselves
    const int digits = i & 0x3ff, exponent = i >> 10;
    const float half = exponent == 0
                           ? std::ldexp(static_cast<float>(digits), -24)
                           : std::ldexp(static_cast<float>(digits | 0x400), exponent - 25);
    if (rounded_to_half(half) != half) FAIL(half);
  }
}

TEST_CASE("meant rows: one changed sample is found in its row, whichever it is") {
  for (int row = 0; row < 7; ++row) {
    std::vector<std::uint16_t> samples(size_t{30} * 7, 9);
    MeantRows rows(10, 3, SampleType::Uint16, true);
    rows.add(samples.data(), 7);
    CHECK(rows.difference(samples.data(), 0, 7).empty());
    samples[size_t{30} * static_cast<size_t>(row) + 29] = 8;
    CHECK_THAT(rows.difference(samples.data(), 0, 7), Contains("row " + std::to_string(row)));
  }
}
