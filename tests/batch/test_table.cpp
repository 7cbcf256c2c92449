#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "batch/record.h"
#include "batch/tables.h"
#include "sphparam/batch/results.h"
#include "support/folder.h"

/// What of the reports of steps stands in the table.
namespace sphparam::tests {

namespace {

namespace fs = std::filesystem;

/// The row of a shape whose steps told this, cell by cell below the names of the columns.
std::vector<std::pair<std::string, std::string>> row_of(BatchRecord record) {
  const Folder folder;
  const BatchItem item{.id = "a", .path = "/a.obj", .input = "x", .options = "y"};
  record.head.planned = "x";
  record.head.options = "y";
  record.head.outcome = BatchOutcome::Done;
  const fs::path place = result_folder(folder.path.string(), item.id);
  fs::create_directories(place);
  std::ofstream(place / "record.json") << to_json(record);
  const std::string text =
      batch_table(folder.path.string(), {.steps = {{"bake", "{input}"}}, .items = {item}});
  const TextTable table = read_table(text, ',', "table");
  std::vector<std::pair<std::string, std::string>> cells;
  for (std::size_t i = 0; i < table.header.size(); ++i)
    cells.emplace_back(table.header[i], table.rows.at(0)[i]);
  return cells;
}

}  // namespace

TEST_CASE("table: how many warnings there are stands in a column") {
  BatchRecord record;
  record.head.warnings = {"one", "two"};
  const auto row = row_of(record);
  CHECK(row[7] == std::pair<std::string, std::string>("repairs", ""));
  CHECK(row[8] == std::pair<std::string, std::string>("warnings", "2"));
}

TEST_CASE("table: fields of a manifest are escaped, at the end of a line too") {
  CHECK(tsv_fields("a\tb") == std::vector<std::string>{"a", "b"});
  for (const std::string field : {"\t", "a\n", "\r\r", "b\\", "", "\\t"})
    CHECK(tsv_fields(tsv_field(field)) == std::vector<std::string>{field});
  CHECK(tsv_fields("a\\") == std::vector<std::string>{"a\\"});  // nothing follows
}

TEST_CASE("table: whole numbers keep all their digits, what is nothing has no column") {
  BatchRecord record;
  record.steps.push_back({{"map"}, 0, 1, R"({"large":9007199254740993,"none":null,"yes":true})"});
  const auto row = row_of(record);
  using Cell = std::pair<std::string, std::string>;
  CHECK(row[9] == Cell("map.large", "9007199254740993"));
  CHECK(row[10] == Cell("map.yes", "true"));
}

TEST_CASE("table: short lists of real numbers and entries with names have columns, no others") {
  BatchRecord record;
  record.steps.push_back({{"bake"}, 0, 1, R"({
    "box":[[0.0,-1.5],[2.0,1e300]],
    "images":[{"map":"radius","range":[1.5,2.5],"beyond":0.0,"file":"a","sidecar":"b"},
              {"map":"radius","channels":3}],
    "functions":[{"name":"x y","rms":0.25,"power":[1.0,null,2.0]}],
    "textures":[{"name":"skin","bytes":3}],
    "repairs":[{"kind":"hole-filled","count":2}],
    "faces":[1,2],"notes":["a"],"none":[],
    "sixteen":[0.5,1.5,2.5,3.5,4.5,5.5,6.5,7.5,8.5,9.5,10.5,11.5,12.5,13.5,14.5,15.5],
    "seventeen":[0.5,1.5,2.5,3.5,4.5,5.5,6.5,7.5,8.5,9.5,10.5,11.5,12.5,13.5,14.5,15.5,16.5]})"});
  const auto row = row_of(record);
  std::vector<std::pair<std::string, std::string>> wanted = {{"bake.box.0.0", "0"},
                                                             {"bake.box.0.1", "-1.5"},
                                                             {"bake.box.1.0", "2"},
                                                             {"bake.box.1.1", "1e+300"},
                                                             {"bake.images.radius.range.0", "1.5"},
                                                             {"bake.images.radius.range.1", "2.5"},
                                                             {"bake.images.radius.beyond", "0"},
                                                             {"bake.images.radius2.channels", "3"},
                                                             {"bake.functions.x y.rms", "0.25"},
                                                             {"bake.functions.x y.power.0", "1"},
                                                             {"bake.functions.x y.power.2", "2"}};
  for (int i = 0; i < 16; ++i)
    wanted.emplace_back("bake.sixteen." + std::to_string(i), std::to_string(i) + ".5");
  const std::size_t first = 9, last = 6;  // columns before and behind those of reports
  REQUIRE(row.size() == first + wanted.size() + last);
  CHECK(std::vector(row.begin() + first, row.end() - last) == wanted);
}

}  // namespace sphparam::tests
