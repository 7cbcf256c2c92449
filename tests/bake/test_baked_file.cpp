#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "bake/baked_file.h"
#include "bake/image_level.h"
#include "image/image_codec.h"

using namespace sphparam;

namespace {

/// The bytes of a file whose texel (row, column) has the value value(row, column, channel).
template <class Value>
std::vector<char> file_of(const SurfaceField& field, const BakedFileOptions& options,
                          const Value& value) {
  std::vector<char> bytes;
  BakedFile file(field, options, in_memory(bytes));
  for (int row = 0; row < options.height; row += 3) {
    const int rows = std::min(3, options.height - row);
    std::vector<float> values;
    for (int r = row; r < row + rows; ++r) {
      for (int c = 0; c < options.width; ++c) {
        for (int k = 0; k < field.channels; ++k) {
          values.push_back(static_cast<float>(value(r, c, k)));
        }
      }
    }
    file.write_rows(rows, values.data());
  }
  file.close();
  return bytes;
}

Image read(const std::vector<char>& bytes) { return decode_image(bytes, "test"); }

}  // namespace

TEST_CASE("baked file: what it stores comes back, in every format and sample type") {
  const SurfaceField data{.name = "height", .range = std::pair(-2.0, 6.0)};
  const auto value = [](int row, int column, int) { return -2 + 8 * (row * 16 + column) / 127.0; };
  for (const ImageFormat format :
       {ImageFormat::Png, ImageFormat::Tiff, ImageFormat::Exr, ImageFormat::Jpeg}) {
    for (const SampleType type : sample_types_of(format)) {
      INFO(name_of(format) << " " << name_of(type));
      const Image image = read(
          file_of(data, {.width = 16, .height = 8, .format = format, .sample_type = type}, value));
      REQUIRE(image.width == 16);
      REQUIRE(image.channels == 1);
      const bool integer = type == SampleType::Uint8 || type == SampleType::Uint16;
      const double exact = type == SampleType::Uint8    ? 0.5 / 255
                           : type == SampleType::Uint16 ? 0.5 / 65535
                           : type == SampleType::Half   ? 4e-3
                                                        : 1e-6;
      const double tolerance = format == ImageFormat::Jpeg ? 0.03 : 1.01 * exact;
      for (int i = 0; i < 128; ++i) {
        const double stored = static_cast<double>(image.pixels[static_cast<size_t>(i)]);
        const double wanted = value(i / 16, i % 16, 0);
        CHECK(std::abs(stored - (integer ? (wanted + 2) / 8 : wanted)) <= tolerance);
      }
    }
  }
}

TEST_CASE("baked file: colours are sRGB in integers and linear in others") {
  const SurfaceField colour{.name = "basecolor", .channels = 3, .kind = FieldKind::Colour};
  const auto light = [](int, int, int) { return 0.21404; };
  CHECK(read(file_of(colour, {.width = 4, .height = 2}, light)).pixels[0] ==
        Approx(0.5).margin(0.003));
  CHECK(read(file_of(colour,
                     {.width = 4,
                      .height = 2,
                      .format = ImageFormat::Exr,
                      .sample_type = SampleType::Float},
                     light))
            .pixels[0] == Approx(0.21404).margin(1e-6));
}

TEST_CASE("baked file: values beyond the range are counted where they end there, in integers") {
  const SurfaceField data{.name = "height", .range = std::pair(-2.0, 6.0)};
  const auto share = [&](ImageFormat format, SampleType type, FieldKind kind) {
    SurfaceField field = data;
    field.kind = kind;
    std::vector<char> bytes;
    BakedFile file(field, {.width = 4, .height = 2, .format = format, .sample_type = type},
                   in_memory(bytes));
    CHECK(range_in_file(field, type).has_value() ==
          (is_integer(type) || kind == FieldKind::Colour));
    const std::vector<float> values = {-2.0F, 6.0F, 6.1F, -3.0F, 0, 1, 6.00001F, NAN};
    file.write_rows(2, values.data());
    file.close();
    return file.share_beyond();
  };
  CHECK(share(ImageFormat::Png, SampleType::Uint16, FieldKind::Data) == 0.25);
  CHECK(share(ImageFormat::Png, SampleType::Uint8, FieldKind::Data) == 0.25);
  CHECK(share(ImageFormat::Tiff, SampleType::Float, FieldKind::Data) == 0);
  CHECK(share(ImageFormat::Png, SampleType::Uint16, FieldKind::Label) == 0);
}

TEST_CASE("baked file: PNG of colours says that they are sRGB, of other numbers not") {
  const auto has_chunk = [](FieldKind kind) {
    const SurfaceField field{
        .name = "x", .channels = 3, .kind = kind, .range = std::pair(0.0, 1.0)};
    const std::vector<char> bytes =
        file_of(field, {.width = 4, .height = 2}, [](int, int, int) { return 0.5; });
    return std::string_view(bytes.data(), bytes.size()).find("sRGB") != std::string_view::npos;
  };
  CHECK(has_chunk(FieldKind::Colour));
  CHECK_FALSE(has_chunk(FieldKind::Data));
}

TEST_CASE("baked file: conventions move texels to where their viewers look for them") {
  // The value is our longitude in turns; in column c of the convention, turns·θ/2π + offset is
  // (c + ½)/W.
  const SurfaceField data{.name = "longitude"};
  for (const ConventionInfo& convention : all_conventions()) {
    INFO(convention.name);
    const Image image = read(file_of(data,
                                     {.width = 16,
                                      .height = 8,
                                      .format = ImageFormat::Exr,
                                      .sample_type = SampleType::Float,
                                      .convention = convention.convention},
                                     [](int, int column, int) { return (column + 0.5) / 16; }));
    for (int c = 0; c < 16; ++c) {
      const double u =
          convention.turns * static_cast<double>(image.pixel(c, 3)[0]) + convention.offset;
      CHECK(std::abs(std::remainder(u - (c + 0.5) / 16, 1.0)) < 1e-6);
    }
  }
}

TEST_CASE("baked file: EXR of the convention of environment maps says that it is one, no other") {
  const SurfaceField data{.name = "x"};
  struct Case {
    ImageFormat format;
    SampleType sample_type;
    bool tiles;
  };
  for (const Case& c : {Case{ImageFormat::Exr, SampleType::Float, false},
                        Case{ImageFormat::Exr, SampleType::Half, true},
                        Case{ImageFormat::Png, SampleType::Uint16, false}}) {
    for (const Convention convention : {Convention::Envmap, Convention::Sphparam}) {
      const std::vector<char> bytes = file_of(data,
                                              {.width = 256,
                                               .height = 128,
                                               .format = c.format,
                                               .sample_type = c.sample_type,
                                               .convention = convention,
                                               .tiles = c.tiles},
                                              [](int, int, int) { return 0.5; });
      const std::string_view text(bytes.data(), bytes.size());
      const bool wanted = c.format == ImageFormat::Exr && convention == Convention::Envmap;
      // Name, type, size and value: 0 is a latitude-longitude map.
      const std::string_view attribute("envmap\0envmap\0\1\0\0\0\0", 19);
      CHECK((text.find(attribute) != std::string_view::npos) == wanted);
      CHECK((text.find(std::string_view("envmap\0", 7)) != std::string_view::npos) == wanted);
    }
  }
}

TEST_CASE("baked file: same bytes for the same rows") {
  const SurfaceField data{.name = "x", .range = std::pair(0.0, 1.0)};
  const auto value = [](int row, int column, int) { return (row ^ column) / 8.0; };
  for (const bool tiles : {false, true}) {
    const BakedFileOptions options{.width = 300,
                                   .height = 150,
                                   .format = ImageFormat::Exr,
                                   .sample_type = SampleType::Half,
                                   .tiles = tiles};
    CHECK(file_of(data, options, value) == file_of(data, options, value));
  }
}

TEST_CASE("baked file: levels are means of boxes, from odd sizes too") {
  for (const int fine : {2, 3, 5, 8, 37}) {
    ImageLevel level(2 * fine, fine, 1, FieldKind::Data);
    double sum = 0;
    for (int row = 0; row < fine; ++row) {
      std::vector<float> values;
      for (int c = 0; c < 2 * fine; ++c) {
        values.push_back(static_cast<float>(std::sin(row + 3 * c)));
        sum += static_cast<double>(values.back());
      }
      level.add_rows(values.data(), 1);
    }
    level.finish();
    CHECK(level.width() == fine);
    CHECK(level.height() == std::max(1, fine / 2));
    double coarse = 0;
    for (const float value : level.values()) coarse += static_cast<double>(value);
    CHECK(coarse / (level.width() * level.height()) ==
          Approx(sum / (2.0 * fine * fine)).margin(1e-5));
  }
}

TEST_CASE("baked file: what a format cannot hold is refused") {
  const SurfaceField four{.name = "basecolor", .channels = 4, .kind = FieldKind::Colour};
  const ImagePlace nowhere;
  CHECK_THROWS_AS(BakedFile(four, {.width = 4, .height = 2, .format = ImageFormat::Jpeg}, nowhere),
                  ImageError);
  CHECK_THROWS_AS(
      BakedFile(four, {.width = 4, .height = 2, .sample_type = SampleType::Float}, nowhere),
      ImageError);
  CHECK_THROWS_AS(BakedFile(four, {.width = 4, .height = 2, .tiles = true}, nowhere), ImageError);
}

TEST_CASE("baked file: halves are not written where they would be infinite") {
  const SurfaceField position{.name = "position", .channels = 1};
  BakedFileOptions options{.width = 4, .height = 2, .format = ImageFormat::Exr};
  options.sample_type = SampleType::Half;
  const auto baked = [&](double largest) {
    return read(file_of(position, options, [&](int, int, int) { return -largest; }));
  };
  CHECK(baked(65504).pixels[0] == -65504);
  CHECK_THROWS_AS(baked(65505), ImageError);
  options.sample_type = SampleType::Float;
  CHECK(baked(65505).pixels[0] == -65505);
}

TEST_CASE("baked file: a file that cannot be written says so") {
  const SurfaceField data{.name = "x", .range = std::pair(0.0, 1.0)};
  CHECK_THROWS_AS(
      [&] {
        BakedFile file(data, {.width = 64, .height = 32},
                       {[](std::int64_t, std::string_view) { throw std::runtime_error("full"); },
                        [](std::int64_t, char*, size_t) { return size_t{0}; }});
        const std::vector<float> rows(64 * 32, 0.5F);
        file.write_rows(32, rows.data());
        file.close();
      }(),
      std::runtime_error);
}

TEST_CASE("baked file: one that is given up writes nothing more") {
  const SurfaceField field{.name = "height", .range = std::pair(0.0, 1.0)};
  for (const ImageFormat format :
       {ImageFormat::Png, ImageFormat::Tiff, ImageFormat::Exr, ImageFormat::Jpeg}) {
    INFO(name_of(format));
    const SampleType type = sample_types_of(format).front();
    const std::vector<float> rows(64 * 16, 0.5F);
    bool given_up = false, written = false;
    {
      BakedFile file(field, {.width = 64, .height = 32, .format = format, .sample_type = type},
                     {[&](std::int64_t, std::string_view) { written |= given_up; },
                      [](std::int64_t, char*, size_t) { return size_t{0}; }});
      file.write_rows(16, rows.data());
      given_up = true;
    }
    CHECK_FALSE(written);
  }
}

TEST_CASE("baked file: what is no number becomes 0, what is out of range its end") {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const float values[] = {std::nanf(""), -infinity, infinity, -3.4e38F, 3.4e38F, 0, -1, 1};
  const auto pixels = [&](double low, double high) {
    const SurfaceField field{.name = "wide", .range = std::pair(low, high)};
    return read(file_of(field, {.width = 8, .height = 1},
                        [&](int, int column, int) { return values[column]; }))
        .pixels;
  };
  const auto wide = pixels(-3.4e38, 3.4e38);
  CHECK(wide[0] == 0);
  CHECK(wide[1] == 0);
  CHECK(wide[2] == 1);
  CHECK(wide[3] == 0);
  CHECK(wide[4] == 1);
  CHECK(wide[5] == Approx(0.5).margin(0.01));
  const auto narrow = pixels(-1, 1);
  CHECK(narrow[6] == 0);
  CHECK(narrow[7] == 1);
}
