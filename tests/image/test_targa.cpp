#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "image/image_codec.h"
#include "image/mutants.h"
#include "image/samples.h"
#include "image/targa.h"

using namespace sphparam;
using Catch::Matchers::Contains;
using namespace sphparam::tests;

namespace {

struct Targa {
  int type, width, height, bits;
  std::string pixels;
  int places = 0;  // 0x20: from the top, 0x10: from the right
  std::string palette = {};
  int colours = 0, colour_bits = 0, first_colour = 0;
  std::string words = {};

  std::string text() const {
    return bytes({static_cast<int>(words.size()), colours > 0, type, first_colour & 255,
                  first_colour >> 8, colours & 255, colours >> 8, colour_bits, 0, 0, 0, 0,
                  width & 255, width >> 8, height & 255, height >> 8, bits, places}) +
           words + palette + pixels;
  }
};

Image read(const std::string& text, const ImageLimits& limits = {}) {
  return decode_image({text.begin(), text.end()}, "skin.tga", limits);
}

const Targa two_by_two = {2, 2, 2, 24, bytes({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12})};
const Targa of_runs = {10, 3, 2, 24,
                       bytes({0x81, 1, 2, 3, 0x03, 4, 5, 6, 7, 8, 9, 1, 1, 1, 2, 2, 2})};
const Targa of_palette = {1, 3, 1, 8, bytes({5, 6, 5}), 0, bytes({1, 2, 3, 4, 5, 6}), 2, 24, 5};

}  // namespace

TEST_CASE("targa: colours are blue, green, red, from whichever corner the file says") {
  Targa file = two_by_two;
  CHECK(samples(read(file.text())) == Samples{9, 8, 7, 12, 11, 10, 3, 2, 1, 6, 5, 4});
  file.places = 0x20;
  CHECK(samples(read(file.text())) == Samples{3, 2, 1, 6, 5, 4, 9, 8, 7, 12, 11, 10});
  file.places = 0x30;
  CHECK(samples(read(file.text())) == Samples{6, 5, 4, 3, 2, 1, 12, 11, 10, 9, 8, 7});
  file.words = "made by hand";
  CHECK(samples(read(file.text())) == Samples{6, 5, 4, 3, 2, 1, 12, 11, 10, 9, 8, 7});
}

TEST_CASE("targa: a fourth channel is alpha where it is not zero throughout") {
  CHECK(samples(read(Targa{2, 2, 1, 32, bytes({1, 2, 3, 0, 4, 5, 6, 0})}.text())) ==
        Samples{3, 2, 1, 6, 5, 4});
  CHECK(samples(read(Targa{2, 2, 1, 32, bytes({1, 2, 3, 0, 4, 5, 6, 8}), 8}.text())) ==
        Samples{3, 2, 1, 0, 6, 5, 4, 8});
}

TEST_CASE("targa: grey, grey with alpha, and five bits a channel") {
  const Image grey = read(Targa{3, 2, 1, 8, bytes({7, 200})}.text());
  CHECK(grey.channels == 1);
  CHECK(samples(grey) == Samples{7, 200});
  const Image with_alpha = read(Targa{3, 1, 1, 16, bytes({7, 200})}.text());
  CHECK(with_alpha.channels == 2);
  CHECK(samples(with_alpha) == Samples{7, 200});
  CHECK(samples(read(Targa{2, 2, 1, 16, bytes({0x1f, 0x7c, 0xe0, 0x83})}.text())) ==
        Samples{255, 0, 255, 0, 255, 0});
}

TEST_CASE("targa: palettes, which need not begin at zero") {
  CHECK(samples(read(of_palette.text())) == Samples{3, 2, 1, 6, 5, 4, 3, 2, 1});
  for (const int beyond : {4, 7}) {
    Targa file = of_palette;
    file.pixels[1] = static_cast<char>(beyond);
    CHECK_THROWS_WITH(read(file.text()), Contains("beyond the palette"));
  }
  Targa passed_over = two_by_two;
  passed_over.palette = bytes({1, 2, 3, 4, 5, 6});
  passed_over.colours = 2;
  passed_over.colour_bits = 24;
  CHECK(samples(read(passed_over.text())) == samples(read(two_by_two.text())));
}

TEST_CASE("targa: runs go on from row to row, and not beyond the image") {
  CHECK(samples(read(of_runs.text())) ==
        Samples{9, 8, 7, 1, 1, 1, 2, 2, 2, 3, 2, 1, 3, 2, 1, 6, 5, 4});
  Targa too_long = of_runs;
  too_long.pixels[0] = static_cast<char>(0x82);
  CHECK_THROWS_WITH(read(too_long.text()), Contains("a run goes beyond the image"));
}

TEST_CASE("targa: what is cut short is refused wherever it ends") {
  for (const std::string& file : {two_by_two.text(), of_runs.text(), of_palette.text()})
    for (std::size_t size = 0; size < file.size(); ++size)
      CHECK_THROWS_AS(read(file.substr(0, size)), ImageError);
}

TEST_CASE("targa: absurd heads are refused before anything is made for them") {
  Targa file = two_by_two;
  file.width = file.height = 65535;
  CHECK_THROWS_WITH(read(file.text()), Contains("skin.tga") && Contains("more than the limit"));
  file.width = file.height = 10000;
  CHECK_THROWS_WITH(read(file.text()), Contains("ends within its pixels"));
  file.type = 10;
  CHECK_THROWS_WITH(read(file.text()), Contains("far larger than its bytes can hold"));
  const Targa large = {2, 1000, 1000, 24, std::string(3000000, 'x')};
  CHECK_NOTHROW(read(large.text(), {.decoded_megabytes = 3}));
  CHECK_THROWS_WITH(read(large.text(), {.decoded_megabytes = 2}), Contains("limit of 2 MB"));
}

TEST_CASE("targa: a head in which a field makes no sense is that of another format") {
  CHECK(looks_like_targa(two_by_two.text().substr(0, 18)));
  CHECK_FALSE(looks_like_targa(two_by_two.text().substr(0, 17)));
  const auto refused = [](const Targa& file) {
    CHECK_FALSE(looks_like_targa(file.text()));
    CHECK_THROWS_WITH(read(file.text()), Contains("not a PNG"));
  };
  for (const int type : {0, 4, 8, 12, 32, 33}) {
    Targa file = two_by_two;
    file.type = type;
    refused(file);
  }
  for (const int bits : {0, 1, 8, 23, 33, 64}) {
    Targa file = two_by_two;
    file.bits = bits;
    refused(file);
  }
  Targa file = two_by_two;
  file.width = 0;
  refused(file);
  file = two_by_two;
  file.places = 0x40;
  refused(file);
  file = of_palette;
  file.colours = 0;
  refused(file);
}

TEST_CASE("targa: whatever is wrong in a file, it is read or refused") {
  const Targa with_alpha = {10, 2, 1, 32, bytes({0x00, 1, 2, 3, 4, 0x80, 5, 6, 7, 8})};
  const std::vector<std::string> files = {two_by_two.text(), of_runs.text(), of_palette.text(),
                                          with_alpha.text(),
                                          Targa{3, 1, 1, 16, bytes({7, 200})}.text()};
  check_mutants(files, 0, [](const std::string& file) { return read(file); });
}
