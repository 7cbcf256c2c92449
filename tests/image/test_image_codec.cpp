#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <new>
#include <sstream>
#include <string>
#include <string_view>

#include "image/image_codec.h"
#include "image/open_module.h"
#include "image/sinks.h"
#include "support/folder.h"
#include "support/leaks_of_others.h"

using namespace sphparam;
using namespace sphparam::tests;
using Catch::Detail::Approx;
using Catch::Matchers::Contains;

namespace {

/// Values that are exact in `levels` steps, all of them occurring, different in every channel.
Image ramp(int width, int height, int channels, int levels) {
  Image image(width, height, channels);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = static_cast<float>((i * 7919) % static_cast<size_t>(levels)) /
                      static_cast<float>(levels - 1);
  }
  return image;
}

/// Equal to the rounding of an integer's way through floats.
bool same_pixels(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.channels == b.channels &&
         std::equal(a.pixels.begin(), a.pixels.end(), b.pixels.begin(), b.pixels.end(),
                    [](float x, float y) { return std::abs(x - y) < 1e-6F; });
}

/// The checksum of a PNG chunk.
std::uint32_t crc(const std::vector<char>& bytes, size_t first, size_t last) {
  std::uint32_t value = ~0U;
  for (size_t i = first; i < last; ++i) {
    value ^= static_cast<unsigned char>(bytes[i]);
    for (int bit = 0; bit < 8; ++bit) value = value & 1 ? (value >> 1) ^ 0xedb88320U : value >> 1;
  }
  return ~value;
}

bool loaded_openimageio() {
  std::ifstream maps("/proc/self/maps");
  const std::string text(std::istreambuf_iterator<char>(maps), {});
  return text.find("libOpenImageIO") != std::string::npos;
}

}  // namespace

TEST_CASE("image codec: what is not an image is refused by its first bytes") {
  const auto refuse = [](const std::string& text) {
    const std::vector<char> bytes(text.begin(), text.end());
    CHECK_THROWS_WITH(
        decode_image(bytes, "x.png"),
        Contains("x.png") && Contains("not a PNG, JPEG, WebP, TIFF, EXR, BMP or TGA"));
  };
  refuse("");
  refuse("GIF89a..........");
  refuse("BM6.............");
  refuse("DICM");
  refuse("\x89PNG\r\n");
}

TEST_CASE("image codec: WebP is read, told by its first bytes") {
  // 64 × 32 of one colour, lossless.
  constexpr unsigned char webp[] = {
      0x52, 0x49, 0x46, 0x46, 0x24, 0x00, 0x00, 0x00, 0x57, 0x45, 0x42, 0x50, 0x56, 0x50, 0x38,
      0x4c, 0x17, 0x00, 0x00, 0x00, 0x2f, 0x3f, 0xc0, 0x07, 0x00, 0x07, 0x50, 0x8f, 0x22, 0x17,
      0xa5, 0xff, 0x01, 0x20, 0x21, 0xfc, 0x3f, 0xaf, 0x46, 0xf4, 0x3f, 0xf5, 0x01, 0x00};
  const Image image = decode_image({std::begin(webp), std::end(webp)}, "x.png");
  CHECK(image.width == 64);
  CHECK(image.height == 32);
  const float* last = image.pixel(63, 31);
  CHECK(last[0] * 255 == Approx(200));
  CHECK(last[1] * 255 == Approx(30));
  CHECK(last[2] * 255 == Approx(40));
}

TEST_CASE("image codec: PNG keeps every 8-bit and 16-bit value, alpha not multiplied in") {
  for (int channels = 1; channels <= 4; ++channels) {
    const Image eight = ramp(64, 33, channels, 256);
    const Image sixteen = ramp(300, 301, channels, 65536);
    const auto round_trip = [](const Image& image, SampleType type) {
      return decode_image(encode_image(image, ImageFormat::Png, {.sample_type = type}), "memory");
    };
    CHECK(same_pixels(round_trip(eight, SampleType::Uint8), eight));
    CHECK(same_pixels(round_trip(sixteen, SampleType::Uint16), sixteen));
  }
}

TEST_CASE("image codec: EXR keeps floats bit by bit, beyond 0 to 1 too") {
  Image image(17, 5, 3);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = std::sin(static_cast<float>(i)) * 1e6F;
  }
  const auto bytes = encode_image(image, ImageFormat::Exr, {.sample_type = SampleType::Float});
  CHECK((decode_image(bytes, "memory").pixels == image.pixels));
}

TEST_CASE("image codec: one pixel is an image, as are rows that are handed on 64 at a time") {
  for (const ImageFormat format : {ImageFormat::Png, ImageFormat::Tiff}) {
    for (const Image& image : {ramp(1, 1, 1, 256), ramp(2, 64, 3, 256), ramp(2, 128, 1, 256)})
      CHECK(same_pixels(decode_image(encode_image(image, format), "memory"), image));
  }
}

TEST_CASE("image codec: the texts of an image are told, and nothing that is no text") {
  const auto texts_of = [](ImageFormat format) {
    ImageTexts texts;
    const ImageWriteOptions about{.sample_type = sample_types_of(format).front(),
                                  .metadata = {{"sphparam:map", "ao"}, {"sphparam:source", "a"}}};
    decode_image(encode_image(ramp(2, 2, 3, 256), format, about), "m", {}, &texts);
    return texts;
  };
  CHECK(texts_of(ImageFormat::Png) == ImageTexts{{"sphparam:samples", "uint8"},
                                                 {"oiio:ColorSpace", "sRGB"},
                                                 {"sphparam:map", "ao"},
                                                 {"sphparam:source", "a"}});
  const ImageTexts tiff = texts_of(ImageFormat::Tiff);
  const auto is_number = [](const auto& text) {
    return text.first == "ResolutionUnit" || text.second.empty();
  };
  CHECK(std::ranges::none_of(tiff, is_number));
  CHECK(
      std::ranges::count(tiff, std::pair<std::string, std::string>{
                                   "ImageDescription", "sphparam:map=ao\nsphparam:source=a"}) == 1);
}

TEST_CASE("image codec: texts of a PNG beyond ASCII are in iTXt, what is no UTF-8 in tEXt") {
  const std::string umlauts = "Büste, 像", latin = "B\xfcste";
  const std::vector<char> png =
      encode_image(ramp(2, 2, 3, 256), ImageFormat::Png,
                   {.metadata = {{"sphparam:source", umlauts}, {"sphparam:map", "ao"}}});
  const std::string_view bytes(png.data(), png.size());
  const size_t chunk = bytes.find("iTXt");
  REQUIRE(chunk == 33 + 4);  // behind the head
  CHECK(bytes.substr(chunk + 4).starts_with("sphparam:source" + std::string(5, '\0') + umlauts));
  CHECK(bytes.find("tEXtsphparam:map") != std::string_view::npos);
  CHECK(bytes.find("tEXtsphparam:source") == std::string_view::npos);
  ImageTexts texts;
  CHECK(same_pixels(decode_image(png, "m", {}, &texts), ramp(2, 2, 3, 256)));
  CHECK(std::ranges::count(texts,
                           std::pair<std::string, std::string>("sphparam:source", umlauts)) == 1);
  texts.clear();
  decode_image(encode_image(ramp(2, 2, 3, 256), ImageFormat::Png,
                            {.metadata = {{"sphparam:source", latin}}}),
               "m", {}, &texts);
  CHECK(std::ranges::count(texts, std::pair<std::string, std::string>("sphparam:source", latin)) ==
        1);
}

TEST_CASE("image codec: a JPEG that ends early or is damaged is refused") {
  const std::vector<char> whole = encode_image(ramp(64, 64, 3, 256), ImageFormat::Jpeg, {});
  CHECK(decode_image(whole, "w.jpg").width == 64);
  std::vector<char> longer = whole;
  longer.resize(whole.size() + 200, '\0');  // what follows the end is nobody's
  CHECK(decode_image(longer, "l.jpg").pixels == decode_image(whole, "w.jpg").pixels);
  longer.insert(longer.end(), {'\xff', '\xda'});  // in a film behind a picture, say
  CHECK(decode_image(longer, "l.jpg").pixels == decode_image(whole, "w.jpg").pixels);
  for (const double share : {0.3, 0.5, 0.9}) {
    const auto size = static_cast<std::ptrdiff_t>(share * static_cast<double>(whole.size()));
    CHECK_THROWS_WITH(decode_image({whole.begin(), whole.begin() + size}, "cut.jpg"),
                      Contains("cut.jpg: is cut off"));
  }
  CHECK_THROWS_WITH(decode_image({whole.begin(), whole.end() - 3}, "cut.jpg"),
                    Contains("cut.jpg: is cut off"));
  std::vector<char> with_thumbnail = whole;  // a whole JPEG in an APP1 segment, behind the start
  const std::string head = {'\xff', '\xe1', static_cast<char>((whole.size() + 2) >> 8),
                            static_cast<char>(whole.size() + 2)};
  with_thumbnail.insert(with_thumbnail.begin() + 2, whole.begin(), whole.end());
  with_thumbnail.insert(with_thumbnail.begin() + 2, head.begin(), head.end());
  CHECK(decode_image(with_thumbnail, "t.jpg").pixels == decode_image(whole, "w.jpg").pixels);
  CHECK_THROWS_WITH(decode_image({with_thumbnail.begin(), with_thumbnail.end() - 3}, "cut.jpg"),
                    Contains("cut.jpg: is cut off"));
  std::vector<char> damaged = whole;
  std::fill_n(damaged.end() - static_cast<std::ptrdiff_t>(whole.size() / 3), 64, '\xff');
  CHECK_THROWS_WITH(decode_image(damaged, "damaged.jpg"),
                    Contains("damaged.jpg: damaged, or ends early"));
  std::vector<char> stray = whole;  // between segments of the head
  const auto second =
      4 + 256 * static_cast<unsigned char>(whole[4]) + static_cast<unsigned char>(whole[5]);
  stray.insert(stray.begin() + second, {'a', 'b'});
  CHECK(decode_image(stray, "stray.jpg").pixels == decode_image(whole, "w.jpg").pixels);
  CHECK_THROWS_WITH(decode_image({stray.begin(), stray.end() - 2}, "cut.jpg"),
                    Contains("cut.jpg: is cut off"));
}

TEST_CASE("image codec: a JPEG that lacks nothing but its end is read, and says so") {
  const ImageTexts::value_type lacks_end{lacks_end_text, "1"};
  for (const int channels : {1, 3}) {
    const std::vector<char> whole =
        encode_image(ramp(50, 70, channels, 256), ImageFormat::Jpeg, {});
    ImageTexts texts;
    const Image image = decode_image(whole, "w.jpg", {}, &texts);
    CHECK(std::ranges::count(texts, lacks_end) == 0);
    for (const std::ptrdiff_t missing : {1, 2}) {
      texts.clear();
      const Image read = decode_image({whole.begin(), whole.end() - missing}, "e.jpg", {}, &texts);
      CHECK(read.pixels == image.pixels);
      CHECK(std::ranges::count(texts, lacks_end) == 1);
    }
    for (std::ptrdiff_t missing = 3; missing < 200; ++missing)
      CHECK_THROWS_WITH(decode_image({whole.begin(), whole.end() - missing}, "cut.jpg"),
                        Contains("cut.jpg: is cut off"));
  }
}

namespace {

// 8 × 8 greys in a progressive JPEG: the mean, and what differs from it, which is nothing.
using namespace std::string_literals;
const std::string progressive = "\xff\xd8\xff\xdb\0\x43\0"s + std::string(64, '\x01') +
                                "\xff\xc2\0\x0b\x08\0\x08\0\x08\x01\x01\x11\0"s +
                                "\xff\xc4\0\x14\0\x01"s + std::string(16, '\0') +
                                "\xff\xc4\0\x14\x10\x01"s + std::string(16, '\0');
const std::string mean_scan = "\xff\xda\0\x08\x01\x01\0\0\0\0\x7f"s;

/// Of coefficients 1 to `last`, to the bit `low`.
std::string other_scan(char last, char low) {
  return "\xff\xda\0\x08\x01\x01\0\x01"s + last + low + '\x7f';
}

std::vector<char> characters(const std::string& bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace

TEST_CASE("image codec: a progressive JPEG that lacks nothing but its end is read, and says so") {
  const std::string scans = mean_scan + other_scan(63, 0);
  ImageTexts texts;
  const Image image = decode_image(characters(progressive + scans), "p.jpg", {}, &texts);
  CHECK(image.pixels == std::vector<float>(64, 128 / 255.0F));
  CHECK(std::ranges::count(texts, ImageTexts::value_type{lacks_end_text, "1"}) == 1);
  for (const std::string& lacking :
       {other_scan(62, 0), other_scan(63, 1), other_scan(63, 0).substr(0, 10)})
    CHECK_THROWS_WITH(decode_image(characters(progressive + mean_scan + lacking), "p.jpg"),
                      Contains("p.jpg: is cut off"));
}

TEST_CASE("image codec: a progressive JPEG without an end may lack scans, and is refused") {
  const std::vector<char> whole = characters(progressive + mean_scan + "\xff\xd9");
  const Image image = decode_image(whole, "p.jpg");
  CHECK(image.width == 8);
  CHECK(image.pixels == std::vector<float>(64, 128 / 255.0F));
  CHECK_THROWS_WITH(decode_image({whole.begin(), whole.end() - 2}, "p.jpg"),
                    Contains("p.jpg: is cut off"));
}

TEST_CASE("image codec: an EXR whose pixels have depths is refused") {
  const auto number = [](int value) {
    return std::string{static_cast<char>(value), 0, 0, 0};  // from the lowest byte on
  };
  const auto named = [&](const std::string& name, const std::string& type,
                         const std::string& value) {
    return name + '\0' + type + '\0' + number(static_cast<int>(value.size())) + value;
  };
  const std::string zero = number(0), one = number(1), half = {0, 0, 0, 0x3f},
                    whole = {0, 0, -128, 0x3f};
  const std::string channel = std::string("Z") + '\0' + number(2) + zero + one + one + '\0';
  const std::string head =
      "\x76\x2f\x31\x01\x02\x08" + std::string(2, '\0') + named("channels", "chlist", channel) +
      named("chunkCount", "int", one) + named("compression", "compression", std::string(1, '\0')) +
      named("dataWindow", "box2i", zero + zero + zero + zero) +
      named("displayWindow", "box2i", zero + zero + zero + zero) +
      named("lineOrder", "lineOrder", std::string(1, '\0')) +
      named("pixelAspectRatio", "float", whole) + named("screenWindowCenter", "v2f", zero + zero) +
      named("screenWindowWidth", "float", whole) + named("type", "string", "deepscanline") +
      named("version", "int", one) + '\0';
  const std::string row =
      zero + number(4) + zero + number(4) + zero + number(4) + zero + one + half;
  const std::string rows_at = {static_cast<char>((head.size() + 8) & 255),
                               static_cast<char>((head.size() + 8) >> 8),
                               0,
                               0,
                               0,
                               0,
                               0,
                               0};
  const std::string file = head + rows_at + row;
  CHECK_THROWS_WITH(decode_image({file.begin(), file.end()}, "smoke.exr"),
                    Contains("smoke.exr") && Contains("deep images are not supported"));
}

TEST_CASE("image codec: a name's ending says the kind, of two spellings where there are two") {
  using enum ImageFormat;
  const std::vector<std::pair<const char*, ImageFormat>> kinds = {
      {"a.png", Png},   {"a.exr", Exr},  {"a.jpg", Jpeg},  {"a.jpeg", Jpeg},
      {"a.JPEG", Jpeg}, {"a.tif", Tiff}, {"a.tiff", Tiff}, {"b/a.b.tif", Tiff}};
  for (const auto& [name, kind] : kinds) CHECK(image_format_of(name) == kind);
  for (const char* name : {"png", "a.webp", "a.png.gz", ".png/a", ""})
    CHECK(image_format_of(name) == std::nullopt);
}

TEST_CASE("image codec: a file's kind is its name's ending, in whatever case") {
  const Folder folder;
  const std::string path = folder / "a.PNG";
  write_image(path, ramp(4, 3, 3, 256));
  CHECK(same_pixels(read_image(path), ramp(4, 3, 3, 256)));
  CHECK_THROWS_WITH(write_image("x.gif", ramp(4, 3, 3, 256)), Contains(".png or .exr"));
}

TEST_CASE("image codec: integer formats clamp") {
  Image image(3, 1, 1);
  image.pixels = {-1, 0.5F, 7};
  const Image back = decode_image(encode_image(image, ImageFormat::Png), "memory");
  CHECK(back.pixels[0] == 0);
  CHECK(back.pixels[1] == Approx(128 / 255.0));
  CHECK(back.pixels[2] == 1);
}

TEST_CASE("image codec: the same image gives the same bytes") {
  const Image image = ramp(200, 100, 3, 256);
  const ImageWriteOptions exr{.sample_type = SampleType::Half,
                              .metadata = {{"sphparam:map", "ao"}}};
  CHECK((encode_image(image, ImageFormat::Png) == encode_image(image, ImageFormat::Png)));
  CHECK((encode_image(image, ImageFormat::Exr, exr) == encode_image(image, ImageFormat::Exr, exr)));
}

TEST_CASE("image codec: limits are judged before pixels are allocated, exactly at the limit") {
  const auto bytes = encode_image(ramp(1024, 1024, 3, 256), ImageFormat::Png);  // 3 MB decoded
  CHECK_NOTHROW(decode_image(bytes, "memory", {.decoded_megabytes = 3}));
  CHECK_THROWS_AS(decode_image(bytes, "memory", {.decoded_megabytes = 2}), ImageError);
  CHECK_NOTHROW(decode_image(bytes, "memory", {.channels = 3}));
  CHECK_THROWS_AS(decode_image(bytes, "memory", {.channels = 2}), ImageError);
}

TEST_CASE("image codec: a truncated or a bomb-like file is an error, never a crash") {
  const LeaksOfOthers leaks;
  const auto bytes = encode_image(ramp(256, 256, 3, 256), ImageFormat::Png);
  for (const size_t keep : {size_t{8}, size_t{20}, size_t{40}, bytes.size() / 2}) {
    const std::vector<char> cut(bytes.begin(), bytes.begin() + static_cast<long>(keep));
    CHECK_THROWS_AS(decode_image(cut, "cut.png"), ImageError);
  }
  // Before libpng would print it too.
  CHECK_THROWS_WITH(decode_image({bytes.begin(), bytes.end() - 20}, "cut.png"),
                    "cut.png: is cut off, the PNG ends within its pixels: copy or save it again");
  // A header that claims 12,000 × 12,000 pixels in front of next to nothing: 432 MB are within the
  // limit, but not for so few bytes.
  std::vector<char> bomb = bytes;
  for (const size_t at : {size_t{16}, size_t{20}}) {
    bomb[at] = bomb[at + 1] = 0;
    bomb[at + 2] = 0x2e;
    bomb[at + 3] = static_cast<char>(0xe0);
  }
  const std::uint32_t checksum = crc(bomb, 12, 29);  // of IHDR's name and content
  for (size_t k = 0; k < 4; ++k) bomb[29 + k] = static_cast<char>(checksum >> (24 - 8 * k));
  CHECK_THROWS_WITH(decode_image(bomb, "bomb.png"), Contains("far larger"));
}

TEST_CASE("image codec: the pixels of an EXR lie where its display window has them") {
  const Image image = ramp(4, 2, 3, 24);
  const std::vector<char> bytes =
      encode_image(image, ImageFormat::Exr, {.sample_type = SampleType::Float});
  const auto shown_in = [&](const std::array<std::int32_t, 4>& window) {
    using namespace std::string_view_literals;
    constexpr std::string_view head = "displayWindow\0box2i\0\x10\0\0\0"sv;
    std::vector<char> changed = bytes;
    const auto at = std::search(changed.begin(), changed.end(), head.begin(), head.end());
    REQUIRE(at != changed.end());
    std::memcpy(&*at + head.size(), window.data(), sizeof window);
    return decode_image(changed, "window.exr");
  };
  CHECK(same_pixels(shown_in({0, 0, 3, 1}), image));
  const Image wide = shown_in({-1, -1, 5, 1});
  REQUIRE(wide.width == 7);
  REQUIRE(wide.height == 3);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 7; ++x) {
      INFO(x << ", " << y);
      const bool there = y > 0 && x > 0 && x < 5;
      for (int c = 0; c < 3; ++c)
        CHECK(wide.pixel(x, y)[c] == (there ? image.pixel(x - 1, y - 1)[c] : 0));
    }
  }
  const Image part = shown_in({2, 1, 2, 1});
  CHECK(part.pixels == std::vector<float>(image.pixel(2, 1), image.pixel(2, 1) + 3));
  CHECK(shown_in({9, 9, 10, 9}).pixels == std::vector<float>(6, 0));
  CHECK(shown_in({0, 5, 3, 6}).pixels == std::vector<float>(24, 0));
  CHECK_THROWS_WITH(shown_in({0, 0, 1 << 20, 1 << 20}), Contains("limit"));
}

TEST_CASE("image codec: files are written and read by name, wrong names and types are refused") {
  const Image image = ramp(20, 10, 4, 256);
  const Folder folder;
  const std::string path = folder / "ramp.png";
  write_image(path, image);
  CHECK(same_pixels(read_image(path), image));
  CHECK_THROWS_WITH(read_image(path, {.file_bytes = 10}), Contains("limit"));
  CHECK_THROWS_WITH(read_image(folder / "absent.png"), Contains("absent.png"));
  CHECK_THROWS_WITH(write_image(folder / "x.gif", image), Contains(".png or .exr"));
  CHECK_THROWS_AS(write_image(folder / "no/x.png", image), ImageError);
  CHECK_THROWS_AS(encode_image(image, ImageFormat::Png, {.sample_type = SampleType::Float}),
                  ImageError);
  for (const Image& empty : {Image(), Image(0, 1, 1), Image(1, 0, 1), Image(1, 1, 0)})
    CHECK_THROWS_WITH(encode_image(empty, ImageFormat::Png), Contains("without pixels"));
  for (const ImageFormat format : {ImageFormat::Png, ImageFormat::Tiff})
    CHECK_THROWS_WITH(encode_image(Image(1, 1, 5), format), Contains("at most 4 channels, not 5"));
  CHECK(loaded_openimageio());
}

TEST_CASE("image codec: memory that ran out is no broken image") {
  const std::vector<char> bytes = encode_image(ramp(20, 10, 3, 256), ImageFormat::Png);
  const SphparamPixelRoom no_room{[](void*, int, int, int) -> float* { return nullptr; }, nullptr};
  std::string told;
  CHECK(image_codecs().decode("png", bytes.data(), bytes.size(), {1, 4}, no_room, {}, into(told)) ==
        1);
  CHECK_THROWS_AS(throw_told("x.png: ", told), std::bad_alloc);
  CHECK_THROWS_WITH(throw_told("x.png: ", "cut short"), "x.png: cut short");
}
