#include <signal.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "program.h"
#include "support/holed.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;

/// A folder in the test's own with two meshes that map, one of them after repair.
std::string good_scans(const Folder& folder) {
  fs::create_directory(folder / "scans");
  write_bytes(folder / "scans/ball.obj", obj_text(icosphere(2)));
  write_bytes(folder / "scans/open.obj", obj_text(with_a_hole()));
  return folder / "scans";
}

}  // namespace

TEST_CASE("survey: it ends with 0 where all map, and with 4 where one does not") {
  const Folder folder;
  const std::string scans = good_scans(folder), page = folder / "page.html";
  const Ended good = sphparam_program({"survey", scans, "-o", page, "--size", "32"});
  CHECK(good.code == 0);
  CHECK_THAT(good.out + good.err, Contains("of 2 1 map as they are, 1 after --repair, 0 if asked"));
  CHECK_THAT(bytes_of(page), Contains("2 of 2 files map") && Contains("data:image/png;base64,"));

  write_bytes(folder / "scans/broken.ply", "ply\nformat ascii 1.0\n");
  const Ended bad = sphparam_program({"survey", scans, "-o", page, "--size", "0", "--json", "-"});
  CHECK(bad.code == 4);
  CHECK_THAT(bytes_of(page), Contains("2 of 3 files map") && Contains("broken.ply"));
  CHECK(Json::parse(bad.out)["counts"]["unreadable"] == 1);
  const Ended quiet = sphparam_program({"survey", scans, "-o", page, "--size", "0", "--quiet"});
  CHECK(quiet.code == 4);
  CHECK_THAT(quiet.err, Contains("1 do not"));
}

TEST_CASE(
    "survey: what is wrong with the command line or the folder is said, and nothing written") {
  const Folder folder;
  const std::string scans = good_scans(folder), page = folder / "page.html";
  CHECK(sphparam_program({"survey", folder / "nowhere", "-o", page}).code == 3);
  const Ended none = sphparam_program({"survey", folder / "scans/ball.obj", "-o", page});
  CHECK(none.code == 3);
  CHECK_THAT(none.err, Contains("Not a directory"));
  CHECK(sphparam_program({"survey", scans, "-o", folder / "page.png"}).code == 2);
  CHECK(sphparam_program({"survey", scans, "-o", page, "--size", "9"}).code == 2);
  CHECK(sphparam_program({"survey", scans, "-o", page, "--records", folder / "no"}).code == 3);
  CHECK(folder.names() == std::vector<std::string>{"scans"});
}

TEST_CASE("survey: a file that memory does not hold is told, and the others go on") {
  const Folder folder;
  const std::string scans = good_scans(folder), page = folder / "page.html";
  write_bytes(folder / "scans/large.obj", obj_text(icosphere(7)));
  const Ended ended = sphparam_program({"survey", scans, "-o", page, "--size", "0", "--threads",
                                        "1", "--max-memory", "48M", "--json", "-"});
  CHECK(ended.code == 4);
  CHECK_THAT(ended.err, Contains("0 do not, 1 were stopped: the page says why"));
  const Json json = Json::parse(ended.out);
  CHECK(json["counts"]["stopped"] == 1);
  CHECK(json["counts"]["maps"] == 1);
  CHECK(json["counts"]["maps-mended"] == 1);
}

TEST_CASE("survey: where no pictures can be made no mesh is to blame, and no record says so") {
  const Folder folder;
  const std::string scans = good_scans(folder), page = folder / "page.html";
  for (const char* name : {"found", "modules"}) fs::create_directory(folder / name);
  write_bytes(folder / "modules/sphparam_image_oiio.so", "no module");
  const auto survey = [&](const std::string& size) {
    const Ended ended = sphparam_program({"survey", scans, "-o", page, "--size", size, "--records",
                                          folder / "found", "--json", "-"});
    return Json::parse(ended.out);
  };
  const auto records = [&] {
    return std::distance(fs::directory_iterator(folder / "found"), fs::directory_iterator());
  };
  REQUIRE(setenv("SPHPARAM_MODULES", (folder / "modules").c_str(), 1) == 0);
  const Json without = survey("32"), unseen = survey("0");
  REQUIRE(unsetenv("SPHPARAM_MODULES") == 0);
  CHECK(without["counts"]["maps"] == 1);
  CHECK(without["counts"]["stopped"] == 1);
  const Json& open = without["meshes"][1];
  CHECK_THAT(open["reasons"][0].get<std::string>(),
             Contains("pictures cannot be made") && Contains("`--size 0`"));
  CHECK(open["ways"].empty());
  CHECK(unseen["counts"]["maps-mended"] == 1);
  CHECK(records() == 3);  // of the ball twice: with pictures it is another question
  CHECK(survey("32")["counts"]["maps-mended"] == 1);
  CHECK(records() == 4);
}

TEST_CASE("survey: a signal ends it in good order, and from its records it goes on") {
  const Folder folder;
  const std::string scans = good_scans(folder), page = folder / "page.html";
  write_bytes(folder / "scans/slow.obj", obj_text(icosphere(8)));
  fs::create_directory(folder / "found");
  const std::vector<std::string> words = {"survey", scans,       "-o",
                                          page,     "--records", folder / "found"};
  Running running(words, "");
  while (std::distance(fs::directory_iterator(folder / "found"), fs::directory_iterator()) < 2)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  running.signal(SIGTERM);
  CHECK(running.wait().code == 130);
  CHECK(folder.names() == std::vector<std::string>{"found", "scans"});
  fs::remove(folder / "scans/slow.obj");
  CHECK(sphparam_program(words).code == 0);
  CHECK_THAT(bytes_of(page), Contains("2 of 2 files map"));
}

}  // namespace sphparam::tests
