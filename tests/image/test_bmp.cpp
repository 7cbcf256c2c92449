#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "image/bmp.h"
#include "image/image_codec.h"
#include "image/mutants.h"
#include "image/samples.h"

using namespace sphparam;
using Catch::Detail::Approx;
using Catch::Matchers::Contains;
using namespace sphparam::tests;

namespace {

std::string little(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i, value >>= 8) text.push_back(static_cast<char>(value));
  return text;
}

struct Bmp {
  int width, height, bits, compression;
  std::string behind_head, rows;  // masks and palette; pixels
  std::string more_of_head = {};  // beyond 40 bytes
  int colours = 0;

  std::string text() const {
    const auto head = 40 + more_of_head.size(), rows_at = 14 + head + behind_head.size();
    return "BM" + little(rows_at + rows.size(), 4) + little(0, 4) + little(rows_at, 4) +
           little(head, 4) + little(static_cast<std::uint32_t>(width), 4) +
           little(static_cast<std::uint32_t>(height), 4) + little(1, 2) +
           little(static_cast<std::uint64_t>(bits), 2) +
           little(static_cast<std::uint64_t>(compression), 4) + little(0, 12) +
           little(static_cast<std::uint64_t>(colours), 4) + little(0, 4) + more_of_head +
           behind_head + rows;
  }
};

Image read(const std::string& text, const ImageLimits& limits = {}) {
  return decode_image({text.begin(), text.end()}, "skin.bmp", limits);
}

const std::string black_red_green_blue =
    bytes({0, 0, 0, 0, 0, 0, 255, 0, 0, 255, 0, 0, 255, 0, 0, 0});

const Bmp of_runs = {4, 3, 8, 1, black_red_green_blue, bytes({2, 1, 0, 2, 1, 1, 2, 2, 0, 0,
                                                              0, 3, 1, 2, 3, 0, 1, 3, 0, 1})};

}  // namespace

TEST_CASE("bmp: 24 bits are blue, green, red, in rows of whole words from the bottom") {
  const Bmp file = {1, 2, 24, 0, "", bytes({1, 2, 3, 0, 4, 5, 6, 0})};
  const Image image = read(file.text());
  CHECK(image.channels == 3);
  CHECK(samples(image) == Samples{6, 5, 4, 3, 2, 1});
  Bmp from_top = file;
  from_top.height = -2;
  CHECK(samples(read(from_top.text())) == Samples{3, 2, 1, 6, 5, 4});
}

TEST_CASE("bmp: a fourth channel is alpha where it is not zero throughout") {
  CHECK(samples(read(Bmp{2, 1, 32, 0, "", bytes({1, 2, 3, 0, 4, 5, 6, 0})}.text())) ==
        Samples{3, 2, 1, 6, 5, 4});
  CHECK(samples(read(Bmp{2, 1, 32, 0, "", bytes({1, 2, 3, 0, 4, 5, 6, 9})}.text())) ==
        Samples{3, 2, 1, 0, 6, 5, 4, 9});
}

TEST_CASE("bmp: 16 bits are five a channel, or as masks say, in the head or behind it") {
  const std::string pixel = little(0x7c1f, 2) + little(0, 2);
  CHECK(samples(read(Bmp{1, 1, 16, 0, "", pixel}.text())) == Samples{255, 0, 255});
  const std::string masks = little(0xf800, 4) + little(0x07e0, 4) + little(0x001f, 4);
  const std::string green = little(0x07e0, 2) + little(0, 2);
  CHECK(samples(read(Bmp{1, 1, 16, 3, masks, green}.text())) == Samples{0, 255, 0});
  CHECK(samples(read(Bmp{1, 1, 16, 3, "", green, masks}.text())) == Samples{0, 255, 0});
  const std::string turned = little(0xff, 4) + little(0xff00, 4) + little(0xff0000, 4) +
                             little(0xff000000, 4) + std::string(68, '\0');
  CHECK(samples(read(Bmp{1, 1, 32, 3, "", bytes({1, 2, 3, 4}), turned}.text())) ==
        Samples{1, 2, 3, 4});
}

TEST_CASE("bmp: palettes of 1, 2, 4 and 8 bits, the first pixel in the highest bits") {
  const Samples red_blue_black = {255, 0, 0, 0, 0, 255, 0, 0, 0};
  const auto with = [](int bits, const std::string& row) {
    return samples(read(Bmp{3, 1, bits, 0, black_red_green_blue, row, "", 4}.text()));
  };
  CHECK(with(8, bytes({1, 3, 0, 0})) == red_blue_black);
  CHECK(with(4, bytes({0x13, 0x00, 0, 0})) == red_blue_black);
  CHECK(with(2, bytes({0x70, 0, 0, 0})) == red_blue_black);
  CHECK(with(1, bytes({0xa0, 0, 0, 0})) == Samples{255, 0, 0, 0, 0, 0, 255, 0, 0});
  CHECK_THROWS_WITH(with(8, bytes({1, 4, 0, 0})), Contains("beyond the palette"));
}

TEST_CASE("bmp: runs, pixels as they come, steps and ends of rows") {
  const Samples k = {0, 0, 0}, r = {255, 0, 0}, g = {0, 255, 0}, b = {0, 0, 255};
  const auto rows = [](std::initializer_list<Samples> pixels) {
    Samples all;
    for (const Samples& pixel : pixels) all.insert(all.end(), pixel.begin(), pixel.end());
    return all;
  };
  // From the bottom: two red; a step by (1, 1); two green beyond the end of that row …
  CHECK_THROWS_WITH(read(of_runs.text()), Contains("a run goes beyond the image"));
  Bmp file = of_runs;
  file.rows = bytes({2, 1, 0, 2, 1, 1, 1, 2, 0, 0, 0, 3, 1, 2, 3, 0, 1, 3, 0, 1});
  CHECK(samples(read(file.text())) == rows({r, g, b, b, k, k, k, g, r, r, k, k}));
  file.bits = 4;
  file.compression = 2;
  file.rows = bytes({3, 0x12, 0, 0, 0, 3, 0x12, 0x30, 0, 1});
  CHECK(samples(read(file.text())) == rows({k, k, k, k, r, g, b, k, r, g, r, k}));
}

TEST_CASE("bmp: the head of OS/2 has sizes of 16 bits and colours of three bytes") {
  const std::string file = "BM" + little(0, 8) + little(32, 4) + little(12, 4) + little(2, 2) +
                           little(2, 2) + little(1, 2) + little(1, 2) + bytes({7, 8, 9, 1, 2, 3}) +
                           bytes({0x40, 0, 0, 0, 0, 0, 0, 0});
  CHECK(samples(read(file)) == Samples{9, 8, 7, 9, 8, 7, 9, 8, 7, 3, 2, 1});
}

TEST_CASE("bmp: heads of all sizes that are in use are known, by the first 18 bytes") {
  Bmp file = {1, 1, 8, 0, black_red_green_blue, bytes({2, 0, 0, 0}), "", 4};
  for (const size_t size : {40, 52, 56, 64, 108, 124}) {
    INFO(size);
    file.more_of_head = std::string(size - 40, '\x7f');
    CHECK(samples(read(file.text())) == Samples{0, 255, 0});
    CHECK(looks_like_bmp(file.text().substr(0, 18)));
    CHECK_FALSE(looks_like_bmp(file.text().substr(0, 17)));
    file.more_of_head.push_back('\x7f');
    CHECK_FALSE(looks_like_bmp(file.text()));
  }
}

TEST_CASE("bmp: what is cut short is refused wherever it ends") {
  Bmp runs = of_runs;
  runs.rows = bytes({1, 1, 0, 3, 1, 2, 3, 0, 0, 1});
  const std::vector<std::string> files = {
      runs.text(), Bmp{1, 2, 24, 0, "", bytes({1, 2, 3, 0, 4, 5, 6, 0})}.text(),
      Bmp{3, 1, 8, 0, black_red_green_blue, bytes({1, 3, 0, 0})}.text()};
  for (const std::string& file : files) {
    CHECK_NOTHROW(read(file));
    for (std::size_t size = 0; size < file.size(); ++size)
      CHECK_THROWS_AS(read(file.substr(0, size)), ImageError);
  }
}

TEST_CASE("bmp: absurd heads are refused before anything is made for them") {
  const auto refused = [](Bmp file, const std::string& why, const ImageLimits& limits = {}) {
    CHECK_THROWS_WITH(read(file.text(), limits), Contains("skin.bmp") && Contains(why));
  };
  const Bmp good = {1, 1, 24, 0, "", bytes({1, 2, 3, 0})};
  for (const int absurd : {0, -1, INT32_MIN}) {
    Bmp file = good;
    file.width = absurd;
    refused(file, "at least one pixel");
  }
  Bmp file = good;
  file.height = INT32_MIN;
  refused(file, "more than the limit");
  file.width = 10000;
  file.height = 10000;
  refused(file, "ends within its rows");
  file.compression = 1;
  refused(file, "compression 1 and 24 bits");
  file.bits = 8;
  refused(file, "far larger than its bytes can hold");
  for (const int bits : {0, 3, 5, 64, 65535}) {
    file = good;
    file.bits = bits;
    refused(file, "bits a pixel are not read");
  }
  for (const auto& [compression, bits] : {std::pair{4, 24}, {5, 16}, {5, 32}, {1, 24}, {2, 8}}) {
    file = good;
    file.compression = compression;
    file.bits = bits;
    refused(file, "compression " + std::to_string(compression));
  }
  file = good;
  file.compression = 3;
  file.behind_head = little(0xf800, 4) + little(0x07e0, 4) + little(0x001f, 4);
  refused(file, "compression 3 and 24 bits");
  std::string text = good.text();
  text[13] = 0x7f;
  CHECK_THROWS_WITH(read(text), Contains("rows are said to begin"));
  const Bmp large = {1000, 1000, 24, 0, "", std::string(3000000, 'x')};
  CHECK_NOTHROW(read(large.text(), {.decoded_megabytes = 3}));
  refused(large, "limit of 2 MB", {.decoded_megabytes = 2});
}

TEST_CASE("bmp: whatever is wrong in a file, it is read or refused") {
  Bmp runs = of_runs;
  runs.rows = bytes({2, 1, 0, 2, 1, 1, 1, 2, 0, 0, 0, 3, 1, 2, 3, 0, 1, 3, 0, 1});
  const std::string masks = little(0xf800, 4) + little(0x07e0, 4) + little(0x001f, 4);
  const std::vector<std::string> files = {
      runs.text(), Bmp{2, 2, 16, 3, masks, bytes({1, 2, 3, 4, 5, 6, 7, 8})}.text(),
      Bmp{3, 1, 4, 0, black_red_green_blue, bytes({0x13, 0, 0, 0})}.text(),
      Bmp{5, 2, 4, 2, black_red_green_blue, bytes({3, 0x12, 0, 0, 0, 3, 0x12, 0x30, 0, 1})}.text(),
      Bmp{1, 1, 32, 0, "", bytes({1, 2, 3, 4}), std::string(84, '\0')}.text()};
  check_mutants(files, 14, [](const std::string& file) { return read(file); });
}
