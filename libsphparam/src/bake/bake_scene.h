#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bake/source_coordinates.h"
#include "sphparam/bake/fields.h"
#include "sphparam/chart/spherical_chart.h"
#include "sphparam/io/mapped_mesh.h"
#include "texture/source_texture.h"

namespace sphparam {

class CalmWalls;
class ProjectedSurface;

/// The mesh that images are baked of: one with a map, or any surface about where the target is.
struct BakeSource {
  std::optional<MappedMesh> mapped;  // none: `surface` is it
  Points normals;                    // #V×3, unit: those of the file, or the mean of the faces'
  // One a material of the file, or the first for all faces; empty: no textures.
  std::vector<SourceTexture> textures;
  bool one_texture_for_all = false;  // whatever the materials; else faces without one are white
  std::shared_ptr<const ProjectedSurface> surface = nullptr;
  std::shared_ptr<SourceCoordinates> coordinates = std::make_shared<SourceCoordinates>();

  const MeshFile& file() const;
  const TriangleMesh& mesh() const { return file().mesh; }
  const FillerMarks& fillers() const;  // none of a surface without a map
  /// Throws: FieldError where there is none, for a field that needs it.
  const MappedMesh& map_for(const char* field) const;
};

/// The mesh that images are baked for, by its chart: the source itself, or another mesh on the same
/// sphere, whose surface is the base of heights and whose frame that of tangent normals.
struct BakeTarget {
  SphericalChart chart;
  Points positions, normals;  // of the refined vertices, chart.points.rows()×3; normals unit
  // Unit, #W×3, where the mesh has hard edges; else `normals` light it.
  std::optional<Points> wedge_normals = std::nullopt;
  bool is_source = true;
  // Where it is not: which way another surface is sought, as `normals`, but weighted by angle,
  // whatever normals the file has.
  Points outward = {};
};

/// All that fields are made of. They refer to it: it must outlive them.
struct BakeScene {
  BakeSource source;
  BakeTarget target;
  FieldOptions options;  // with the body's centre, where it is not the origin
  int threads = 0;
  bool mirrored = false;   // u of the image runs against longitude: see `Convention`
  double calm_beyond = 0;  // as in `BakeSettings`
  std::shared_ptr<const CalmWalls> walls = nullptr;  // none: nothing is calm
  bool clear_walls = false;                          // as in `BakeSettings`
  bool ids_as_colours = false;  // in integer images, which cannot hold large numbers
  Eigen::Matrix3d body_axes = Eigen::Matrix3d::Identity();  // as in io/planetocentric.h
};

/// "m", "km", "0.3 m"; nothing where no body says what the mesh's unit is.
std::string unit_of_lengths(const FieldOptions& options);

}  // namespace sphparam
