#include "io/files/text_buffer.h"

// Numbers are appended by std::to_chars: no locale, no format to parse.

namespace sphparam {

std::size_t expected_text_bytes(const MeshFile& file) {
  constexpr Eigen::Index vertex_bytes = 64, face_bytes = 32;
  return static_cast<std::size_t>(vertex_bytes * file.mesh.vertex_count() +
                                  face_bytes * file.mesh.face_count());
}

void put_comments(TextBuffer& text, const MeshFile& file) {
  for (const std::string& comment : file.comments) text << "# " << one_line(comment) << '\n';
}

}  // namespace sphparam
