#pragma once

#include <optional>
#include <vector>

#include "embedding/energy/packed_triangles.h"
#include "embedding/twists/limb_search.h"

namespace sphparam {

/// The ring of triangles between two layers of a limb, one beside the other, and its image.
class Strip {
 public:
  /// Nothing: what lies between the layers is no ring of triangles.
  static std::optional<Strip> between(const Topology& topology, const RestTriangles& source,
                                      const std::vector<ImagePoint>& image, const VertexLoop& fixed,
                                      const VertexLoop& moved);

  /// The turn of the moved layer that lowers the energy most; nothing: none is worth it. Every
  /// determinant stays certainly positive, and the strip winds about the sphere as it did.
  std::optional<Eigen::Matrix3d> better_turn(const DistortionEnergy& energy) const;

  /// Each vertex of a layer gets the image of the one so many places on in the order of the layer.
  struct Slide {
    int by = 0;
    double falls_by = 0;  // the strip's energy
  };

  /// The slide of the moved layer that lowers the energy most; by 0: none is worth it. Ensures: as
  /// above. Requires: both layers have their orders in the same sense.
  Slide better_slide(const DistortionEnergy& energy) const;

 private:
  using Points = std::vector<ImagePoint>;

  Points turned(const Eigen::Matrix3d& turn) const;
  Points slid(int by) const;
  bool winds_alike(const Points& points) const;

  PackedTriangles triangles_;
  Points points_;  // of the fixed layer, then of the moved one
  size_t fixed_ = 0;
};

}  // namespace sphparam
