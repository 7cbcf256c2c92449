#include "io/formats/freesurfer_writer.h"

#include <cstdint>
#include <cstdlib>

#include "io/files/byte_reader.h"
#include "io/formats/float32_points.h"
#include "io/formats/freesurfer_comments.h"

// No date: what is written depends on what was read alone.

namespace sphparam {
namespace {

/// What follows the first comment of this prefix; or else.
std::string value_of(const MeshFile& file, std::string_view prefix, const std::string& otherwise) {
  for (const std::string& comment : file.comments)
    if (comment.starts_with(prefix)) return one_line(comment.substr(prefix.size()));
  return otherwise;
}

void append_footer(std::string& bytes, const MeshFile& file) {
  std::vector<std::string> lines;
  for (const std::string& comment : file.comments)
    if (comment.starts_with(freesurfer_geometry))
      lines.push_back(one_line(comment.substr(freesurfer_geometry.size())));
  const std::string real_ras = value_of(file, freesurfer_real_ras, "");
  const bool has_geometry = lines.size() == freesurfer_geometry_lines;
  if (real_ras.empty() && !has_geometry) return;
  append_number(bytes, std::int32_t{freesurfer_ras_tag}, std::endian::big);
  append_number(bytes, static_cast<std::int32_t>(std::atoi(real_ras.c_str())), std::endian::big);
  if (!has_geometry) return;
  append_number(bytes, std::int32_t{freesurfer_geometry_tag}, std::endian::big);
  for (const std::string& line : lines) bytes += line + "\n";
}

}  // namespace

std::string serialise_freesurfer(const MeshFile& file) {
  std::string bytes =
      "\xff\xff\xfe"
      "created " +
      value_of(file, freesurfer_created, "by sphparam") + "\n\n";
  const TriangleMesh& mesh = file.mesh;
  bytes.reserve(bytes.size() +
                4 * static_cast<std::size_t>(mesh.positions.size() + mesh.triangles.size()));
  append_number(bytes, static_cast<std::int32_t>(mesh.vertex_count()), std::endian::big);
  append_number(bytes, static_cast<std::int32_t>(mesh.face_count()), std::endian::big);
  append_points32(bytes, mesh.positions, std::endian::big, "a FreeSurfer surface");
  append_triangles32(bytes, mesh.triangles, std::endian::big);
  append_footer(bytes, file);
  return bytes;
}

}  // namespace sphparam
