#include <catch2/catch.hpp>
#include <filesystem>

#include "sphparam/bake/bake.h"
#include "support/folder.h"

using namespace sphparam;
namespace fs = std::filesystem;

TEST_CASE("bake requests: {map} is the field, without what no name can hold") {
  const auto requests = requests_for({"ao", "curvature:mean"}, "a_{map}_{map}.exr", "egg");
  REQUIRE(requests.size() == 2);
  CHECK(requests[0].field == "ao");
  CHECK(requests[0].path == "a_ao_ao.exr");
  CHECK(requests[1].field == "curvature:mean");
  CHECK(requests[1].path == "a_curvature-mean_curvature-mean.exr");
  CHECK(requests_for({"ao"}, "-", "egg")[0].path == "-");
}

TEST_CASE("bake requests: a folder gets a file a field, whether it is there or says so") {
  CHECK(requests_for({"ao"}, "new/", "egg")[0].path == "new/egg_ao.png");
  const tests::Folder here;
  const std::string folder = here / "there";
  CHECK(requests_for({"ao"}, folder, "egg")[0].path == folder);
  fs::create_directory(folder);
  CHECK(requests_for({"ao"}, folder, "egg")[0].path == folder + "/egg_ao.png");
}
