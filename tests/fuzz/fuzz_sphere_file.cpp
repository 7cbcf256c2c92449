// What `sphparam verify` does with any bytes: a refusal, or a certificate that means what it says
// and stays the same when the map is written and read again.

#include <cstdint>
#include <optional>
#include <string_view>

#include "expect.h"
#include "io/polygons/welding.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/distortion.h"

namespace {

using namespace sphparam;
using sphparam::tests::expect;

void verify(MeshFile source) {
  const MeshFile file = prepare_for_mapping(std::move(source));
  if (!inspect_mesh(file.mesh).is_sphere()) return;
  const SphereMap map = read_sphere(file).value_or(SphereMap{file.mesh.positions});
  const Topology topology(file.mesh);
  const Certificate certificate = certify(topology, map, 1);
  if (certificate.unusable_points.empty()) measure_distortion(file.mesh, normalised(map.points), 1);

  const std::string bytes = serialise_ply(attach_map(file, map, read_provenance(file)));
  const MeshFile again = read_mesh(bytes, "again.ply", {});
  const std::optional<SphereMap> same = read_sphere(again);
  expect(same.has_value(), "a written map is read again");
  expect(same->points == map.points, "no bit of a ray is lost");
  expect(certify(topology, *same, 1).bijective() == certificate.bijective(),
         "the verdict is about the bytes");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    verify(read_mesh({reinterpret_cast<const char*>(data), size}, "fuzzed.ply", {}));
  } catch (const ReadError&) {
  }
  return 0;
}
