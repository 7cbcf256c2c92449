#include "io/formats/ply/ply_layout.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace sphparam {
namespace {

class LayoutFinder {
 public:
  LayoutFinder(const PlyHeader& header, const std::string& name, const ReadOptions& options)
      : header_(header), name_(name), options_(options) {}

  PlyLayout find() const {
    PlyLayout layout;
    layout.vertices = header_.find("vertex");
    if (!layout.vertices) fail_at(header_.body_line - 1, "the header has no element vertex");
    check_count(*layout.vertices, options_.max_vertices);
    check_axes(*layout.vertices);
    layout.faces = header_.find("face");
    // Strips stand in for faces: of a file with both, the faces are the mesh.
    if (!layout.faces || layout.faces->count == 0) layout.strips = header_.find("tristrips");
    if (layout.strips) layout.faces = nullptr;
    if (layout.faces) layout.corners = corner_list_of(*layout.faces, "face");
    if (layout.strips) layout.corners = corner_list_of(*layout.strips, "strip");
    return layout;
  }

 private:
  void check_count(const PlyElement& element, std::int64_t limit) const {
    constexpr std::int64_t hard_limit = std::numeric_limits<int>::max() / 3;  // ids are ints
    if (element.count > std::min(limit, hard_limit))
      fail_at(element.line, std::to_string(element.count) + " records of element " +
                                sphparam::quoted(element.name) + " are over the limit of " +
                                std::to_string(std::min(limit, hard_limit)));
  }

  void check_axes(const PlyElement& vertices) const {
    for (const char* axis : {"x", "y", "z"}) {
      const PlyProperty* const property = vertices.find(axis);
      if (!property) fail_at(vertices.line, std::string("vertices have no property ") + axis);
      if (property->is_list)
        fail_at(vertices.line, std::string("vertex property ") + axis + " is a list");
    }
  }

  const PlyProperty* corner_list_of(const PlyElement& element, const std::string& what) const {
    check_count(element, options_.max_faces);
    const PlyProperty* const indices = element.find("vertex_indices");
    const PlyProperty* const index = element.find("vertex_index");
    if (indices && index) fail_at(element.line, what + "s have two lists of vertices");
    const PlyProperty* const corners = indices ? indices : index;
    if (!corners) fail_at(element.line, what + "s have no list vertex_indices");
    if (!corners->is_list)
      fail_at(element.line, what + " property " + corners->name + " is no list");
    if (is_floating(corners->type))
      fail_at(element.line, "vertex indices of a floating-point type");
    return corners;
  }

  [[noreturn]] void fail_at(long line, const std::string& message) const {
    throw ReadError::at_line(name_, line, message);
  }

  const PlyHeader& header_;
  const std::string& name_;
  const ReadOptions& options_;
};

}  // namespace

PlyLayout find_layout(const PlyHeader& header, const std::string& name,
                      const ReadOptions& options) {
  return LayoutFinder(header, name, options).find();
}

}  // namespace sphparam
