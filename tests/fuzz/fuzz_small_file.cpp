// Any bytes are a small file that a subcommand reads beside meshes, or a ReadError: the first byte
// says which. What was read keeps the promises of its header, and manifests, records and
// coefficients come back as they were written.

#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>

#include "batch/manifest.h"
#include "batch/record.h"
#include "expect.h"
#include "sphparam/correspondence/landmark_file.h"
#include "sphparam/group/template_landmarks.h"
#include "sphparam/io/coef_file.h"
#include "sphparam/io/pin_file.h"

namespace {

using namespace sphparam;
using sphparam::tests::expect;

/// Of a mesh of 42 vertices.
const FileNumbers& numbers() {
  static const FileNumbers numbers = [] {
    MeshFile file;
    file.mesh.positions = Points::Zero(42, 3);
    return FileNumbers(file);
  }();
  return numbers;
}

bool is_vertex(Vertex vertex) { return vertex >= 0 && vertex < 42; }

void read_as_pins(std::string_view text) {
  std::set<Vertex> seen;
  for (const Landmark& pin : parse_pins(text, "fuzzed", numbers())) {
    expect(is_vertex(pin.vertex) && seen.insert(pin.vertex).second, "pins are of other vertices");
  }
}

void read_as_landmarks(std::string_view text) {
  for (const LandmarkPair& pair : LandmarkFile(text, "fuzzed").pairs(numbers(), numbers())) {
    expect(is_vertex(pair.from) && is_vertex(pair.to), "landmarks are vertices");
  }
}

void read_as_template(std::string_view text) {
  std::set<std::string> names;
  for (const TemplateLandmark& landmark : parse_template_landmarks(text, "fuzzed", numbers())) {
    expect(is_vertex(landmark.vertex), "landmarks are vertices");
    expect(names.insert(landmark.name).second, "no name is there twice");
  }
}

void read_as_coefficients(std::string_view text) {
  const Functions read = parse_coef(text, "fuzzed");
  const auto degrees = static_cast<Eigen::Index>(std::lround(std::sqrt(read.rows())));
  expect(read.cols() == 3 && degrees * degrees == read.rows(), "coefficients of whole degrees");
  if (!read.allFinite()) return;
  const Functions again = parse_coef(to_coef(read), "again");
  expect(again.rows() == read.rows(), "coefficients survive writing and reading");
}

void read_as_manifest(std::string_view text) {
  const std::string written = manifest_text(parse_manifest(text, "fuzzed"));
  expect(manifest_text(parse_manifest(written, "again")) == written,
         "writing what was read changes nothing");
}

void read_as_record(std::string_view text) {
  const auto head = read_head(text);
  if (!head) return;
  const BatchRecord record{.head = *head};
  const BatchRecordHead again = read_head(to_json(record)).value();
  expect(again.outcome == record.head.outcome && again.code == record.head.code &&
             again.input == record.head.input && again.files.size() == record.head.files.size(),
         "a record survives writing and reading");
}

constexpr void (*readers[])(std::string_view) = {read_as_pins,     read_as_landmarks,
                                                 read_as_template, read_as_coefficients,
                                                 read_as_manifest, read_as_record};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    readers[data[0] % std::size(readers)](text);
  } catch (const ReadError&) {
  }
  return 0;
}
