// Any bytes are a file of numbers a vertex or a ReadError. What was read keeps the promises of
// vertex_data.h, comes back from the writers that take it, and goes through a mesh and back.

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "expect.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/vertex_data.h"

namespace {

using namespace sphparam;
using sphparam::tests::expect;

constexpr Eigen::Index some_vertices = 12;  // that a label needs to be told

bool are_same(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto rounded = static_cast<double>(static_cast<float>(a[i]));
    if (rounded != b[i] && !(std::isnan(a[i]) && std::isnan(b[i]))) return false;
  }
  return true;
}

void expect_promises(const VertexData& data) {
  expect(!data.columns.empty() && data.vertex_count() > 0, "there are columns, and vertices");
  for (const DataColumn& column : data.columns) {
    expect(static_cast<Eigen::Index>(column.values.size()) == data.vertex_count(),
           "columns are of one length");
    for (const double value : column.values)
      expect(data.kind != DataKind::Labels || value == std::floor(value),
             "labels are whole numbers");
  }
}

void expect_round_trip(const VertexData& data, const std::string& name) {
  std::string bytes;
  try {
    bytes = serialise_vertex_data(name, data);
  } catch (const WriteError&) {  // colours that are not apart, several columns, large numbers
    return;
  }
  const VertexData again = read_vertex_data(bytes, name, data.vertex_count());
  expect(again.columns.size() == data.columns.size(), "columns survive writing and reading");
  if (data.kind == DataKind::Labels) return;  // large keys have more digits than float32
  for (std::size_t k = 0; k < data.columns.size(); ++k)
    expect(are_same(data.columns[k].values, again.columns[k].values), "values survive");
}

void expect_way_through_a_mesh(const VertexData& data) {
  constexpr Eigen::Index most_vertices = 1000;
  constexpr std::size_t most_columns = 100;
  std::vector<std::string> losses;
  const VertexData finite = without_missing(data, losses);
  if (finite.columns.empty() || finite.vertex_count() > most_vertices ||
      finite.columns.size() > most_columns)
    return;
  MeshFile mesh;
  mesh.mesh.positions = Points::Zero(finite.vertex_count(), 3);
  attach_data(mesh, finite);
  const std::vector<VertexData> back = attached_data(read_mesh(serialise_ply(mesh), "a.ply", {}));
  expect(back.size() == 1 && back[0].columns.size() == finite.columns.size(),
         "a mesh carries data");
  for (std::size_t k = 0; k < finite.columns.size(); ++k)
    expect(back[0].columns[k].values == finite.columns[k].values, "a mesh carries its values");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  std::optional<VertexData> values;
  for (const Eigen::Index vertices : {Eigen::Index{0}, some_vertices}) {
    try {
      values = read_vertex_data(bytes, SPHPARAM_FUZZED_NAME, vertices);
    } catch (const ReadError&) {
      continue;
    }
    expect_promises(*values);
    for (const char* name : {"a.gii", "a.annot", "a.label", "a.mgh", "a.curv"})
      expect_round_trip(*values, name);
    expect_way_through_a_mesh(*values);
  }
  return 0;
}
