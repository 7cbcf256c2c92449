#include "io/files/text_buffer.h"

// Numbers are appended by std::to_chars: no locale, no format to parse.

namespace sphparam {

std::size_t expected_text_bytes(const MeshFile& file) {
  constexpr Eigen::Index kVertexBytes = 64, kFaceBytes = 32;
  return static_cast<std::size_t>(kVertexBytes * file.mesh.vertex_count() +
                                  kFaceBytes * file.mesh.face_count());
}

void put_comments(TextBuffer& text, const MeshFile& file) {
  for (const std::string& comment : file.comments) text << "# " << one_line(comment) << '\n';
}

}  // namespace sphparam
