// Any bytes are a 3MF file or a ReadError: archives as they are; whatever else is the XML of the
// model in one, which a fuzzer could not change without its checksum.

#include <cstdint>
#include <string>

#include "expect.h"
#include "io/files/zip_archive.h"
#include "io/formats/three_mf/three_mf_reader.h"
#include "support/zipped.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sphparam;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const bool is_archive = looks_like_zip(bytes);
  try {
    const MeshFile file = read_three_mf(
        is_archive ? bytes : tests::zipped({{"3D/3dmodel.model", bytes}}), "fuzzed.3mf",
        {.max_file_bytes = 1 << 24, .max_vertices = 1 << 20, .max_faces = 1 << 20});
    tests::expect(file.mesh.positions.allFinite(), "positions are finite");
    tests::expect(file.mesh.triangles.size() == 0 ||
                      (file.mesh.triangles.minCoeff() >= 0 &&
                       file.mesh.triangles.maxCoeff() < file.mesh.vertex_count()),
                  "indices are in range");
    for (const Property& property : file.face_properties)
      tests::expect(static_cast<Eigen::Index>(property.values.size()) == file.mesh.face_count(),
                    "a face property has a value a face");
  } catch (const ReadError&) {
  }
  return 0;
}
