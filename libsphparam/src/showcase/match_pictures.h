#pragma once

#include <vector>

#include "render/heat.h"
#include "showcase/side_by_side.h"
#include "sphparam/correspondence/carried_shape.h"

namespace sphparam {

/// Places of a surface as colours: red, green and blue grow along x, y and z of the box about them.
/// sRGB, one a row.
std::vector<Rgb> place_colours(const Points& positions, const Points& box);

/// Vertices spread over a mesh, these first: each is as far from those before as that goes.
/// Requires: a vertex. Cost: count · #V.
std::vector<Vertex> spread_vertices(const TriangleMesh& mesh, const std::vector<Vertex>& first,
                                    int count);

/// Pictures of a match, the first surface left and the second one right, where the first one is:
/// turned, moved and scaled to its area. Surfaces are seen without what closes their holes.
class MatchPictures {
 public:
  /// `from_landmarks`: vertices of the first that links begin at whatever else is chosen.
  /// Cost: that of `SurfaceMap::forth` twice, and of the distortion.
  MatchPictures(const SurfaceMap& map, const std::vector<Vertex>& from_landmarks,
                const PairLook& look);

  /// Both coloured by places on the second, so that what belongs together has one colour; lines
  /// link points that are seen on both. `from_behind`: of the other side.
  Image places(bool from_behind) const;
  /// Both surfaces with the lines of longitude and latitude that their maps share.
  Image graticules() const;
  /// Both spheres, seen from the one side that the first surface shows, with these lines.
  Image spheres() const;
  /// The first surface, and its triangles in the shape of the second, in the colours of the
  /// distortion between the two. `from_behind`: of the other side.
  Image heat(Heat heat, bool from_behind) const;

  const Distortion& distortion() const { return distortion_; }
  int link_count() const { return static_cast<int>(linked_.size()); }

 private:
  PairLook look_from(bool from_behind) const;
  RenderObject first(Paint paint) const;
  RenderObject second(Paint paint) const;
  std::vector<Link> links(const PairLook& look) const;

  SurfaceMap map_;
  PairLook look_;
  TriangleMesh first_, second_, carried_;  // in the coordinates of the first; all triangles
  Points first_normals_, second_normals_, carried_normals_;
  std::vector<Rgb> first_colours_, second_colours_;
  std::vector<Vertex> linked_;  // of the first
  Distortion distortion_;
};

}  // namespace sphparam
