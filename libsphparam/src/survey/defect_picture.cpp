// Vertices get colours, which the renderer blends across faces: what is red is or touches a defect.

#include <array>

#include "mesh/face_sides.h"
#include "sphparam/render/picture.h"
#include "sphparam/survey/survey.h"

namespace sphparam {
namespace {

constexpr std::array<double, 3> sound = {205, 205, 200}, bad = {214, 40, 40};

bool names_faces(DefectKind kind) {
  return kind == DefectKind::RepeatedVertex || kind == DefectKind::DuplicateFace ||
         kind == DefectKind::ZeroAreaFace || kind == DefectKind::IndexOutOfRange;
}

class Marks {
 public:
  explicit Marks(const TriangleMesh& mesh)
      : mesh_(mesh), marked_(static_cast<std::size_t>(mesh.vertex_count()), 0) {}

  void add(Vertex v) {
    if (v < 0 || v >= static_cast<Vertex>(marked_.size())) return;
    any_ |= !marked_[static_cast<std::size_t>(v)];
    marked_[static_cast<std::size_t>(v)] = 1;
  }

  void add_places(const MeshDefect& defect) {
    if (!defect.fatal) return;
    for (const int id : defect.elements) {
      if (!names_faces(defect.kind)) {
        add(id);
      } else if (id >= 0 && id < mesh_.face_count()) {
        for (int k = 0; k < 3; ++k) add(mesh_.triangles(id, k));
      }
    }
  }

  void add_odd_edges() {
    const std::vector<FaceSide> sides = sorted_sides(mesh_.triangles, [](Face) { return true; });
    for_each_edge(sides, [&](std::size_t i, std::size_t j) {
      if (j - i == 2 && sides[i].forward != sides[i + 1].forward) return;
      add(sides[i].low);
      add(sides[i].high);
    });
  }

  bool any() const { return any_; }

  Property channel(const char* name, int k) const {
    Property property{name, ScalarType::Uint8, {}};
    for (const char marked : marked_)
      property.values.push_back((marked ? bad : sound)[static_cast<std::size_t>(k)]);
    return property;
  }

 private:
  const TriangleMesh& mesh_;
  std::vector<char> marked_;
  bool any_ = false;
};

}  // namespace

std::string picture_of_defects(const MeshFile& file, const MeshInspection& inspection, int size,
                               int threads) {
  if (file.mesh.face_count() == 0 || !file.mesh.positions.allFinite()) return {};
  Marks marks(file.mesh);
  for (const MeshDefect& defect : inspection.defects) marks.add_places(defect);
  marks.add_odd_edges();
  MeshFile coloured;
  coloured.mesh = file.mesh;
  coloured.comments = file.comments;  // which axis is up
  coloured.vertex_properties = {marks.channel("red", 0), marks.channel("green", 1),
                                marks.channel("blue", 2)};
  return draw_png(coloured, std::nullopt,
                  {.view = View::Mesh, .legend = false, .size = size, .threads = threads});
}

}  // namespace sphparam
