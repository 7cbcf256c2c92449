#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/bake/bake_errors.h"
#include "sphparam/bake/fields.h"
#include "sphparam/bake/interpolation.h"
#include "sphparam/image/image_format.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/progress.h"
#include "sphparam/texture/convention.h"
#include "sphparam/texture/texture_options.h"

namespace sphparam {

/// One image that is asked for.
struct BakeRequest {
  std::string field;  // "normal-object", "ao", "scalar:NAME", …: see `all_fields`; or a test image
  std::string path;   // .png, .jpg, .tif or .exr; "-": standard output, as PNG
};

/// A request a field, named by a pattern: {map} in a file's name stands for the field, without what
/// no name can hold ("curvature:mean" is curvature-mean); a folder, which is there or ends with
/// "/", gets STEM_{map}.png.
std::vector<BakeRequest> requests_for(const std::vector<std::string>& fields,
                                      const std::string& pattern, const std::string& stem);

struct BakeSettings {
  int width = 2048;  // texels a row, even, 2 to 65536 (JPEG: 65500); half as many rows. A multiple
                     // of 4 for conventions that are a quarter turn away
  int samples = 1;   // N: N × N a texel, their mean; 1 to 32
  Interpolation interpolation = Interpolation::Uv;
  Convention convention = Convention::Sphparam;
  // Of a channel; none: 8 bits for colours and directions, in EXR half; 16 bits for data where the
  // format has them, in EXR float.
  std::optional<SampleType> depth = {};
  bool mip = false;  // tiles, and all levels down to one texel; EXR only
  FieldOptions fields = {};
  std::string texture = {};  // the mesh's own texture, for its base colour; empty: as its file says
  TextureWrap wrap = TextureWrap::Repeat;  // what `texture` says beyond its borders
  // The mesh that the images are for, on the same sphere: its chart, its frame of normals, its
  // surface as base of heights; none: the source itself.
  std::optional<MappedMesh> target = {};
  // Another surface, about where the mesh lies, closed or not: fields are of it, images for the
  // mesh. Each point of the mesh shows what the line along its smooth normal meets near it, else
  // the nearest point. Finite, with a triangle at least. Not together with `target`.
  std::optional<MeshFile> from = {};
  // Walls, which are farther than this from `from`, show a smooth mean of what stands about them,
  // not streaks of what is nearest: colours, what materials say; tangent normals a mean of the
  // mesh's own. What is masked out shows what lies less than twice as far behind it, where the mesh
  // is about both and would have a hole. 0: neither; else finite and above.
  double calm_beyond = 0;
  // Such walls are masked out of the base colour: its alpha is 0 there, and its metadata say so.
  bool clear_walls = false;
  int refine_poles = 1;          // the images are for that chart: see `refine_poles`; 1 to 1024
  std::string source_name = {};  // in metadata and messages; empty: the source's own
  int threads = 0;               // 0: all cores
  Progress progress = {};        // stages: of the chart, "texture", "range", "bake", "write", …
};

/// What was baked.
struct BakedImage {
  std::string field;  // "curvature:mean" of "curvature"
  std::string about;  // unit, space, convention
  std::string path;
  SampleType sample_type = SampleType::Uint8;
  int channels = 1;
  std::optional<std::pair<double, double>> range = {};  // what 0 and 1 of integers stand for
  double beyond = 0;         // share of the texels whose values lie beyond the range, and end there
  std::string sidecar = {};  // the file beside it that says where it lies; empty: none
};

/// How a mesh finds the surface that is baked on it, by shares of its area; distances in diagonals
/// of that surface.
struct ProjectionShares {
  double back = 0;     // shows what faces the other way, its normals turned round
  double nearest = 0;  // the line along the normal met nothing near
  double median = 0;   // half of the area is no farther away
  double farthest = 0;
};

struct BakeReport {
  std::vector<BakedImage> images;                   // as they were asked for
  std::optional<double> target_distance;            // from the source, median, in its diagonals
  std::optional<ProjectionShares> projection = {};  // of the settings' `from`
  double wall_share = 0;  // of the mesh's area, what is a wall (the settings' `calm_beyond`)
  std::vector<std::string> warnings;  // what the user should look at
  // What the sidecars call longitude and latitude: "Vesta (2015) - Sphere / Ocentric"; empty: none.
  std::string coordinate_system = {};
};

/// Bakes fields of a mesh into equirectangular images: longitude along the rows, the north pole is
/// the first one; every texel has the value of the one point of the surface that maps there. All
/// images are baked together, row by row, and get their names at the end: all of them or none.
/// Images of heat maps have their scale beside them, as `scale_path` says; with a body
/// (`FieldOptions::body`), images in Convention::Gis have what tells GDAL, QGIS and others their
/// coordinates, scale, offset and unit beside them, as `sidecar_path` says. That calls longitudes
/// planetocentric only where the map is one by Method::Radial about the body's centre that moved no
/// vertex, and texels show what lies in their direction (Interpolation::Sphere, without `from`);
/// else it says by how much they are off, measured, or that they are the map's.
///
/// Ensures: the same bytes for any number of threads. Each file is read back before it gets its
/// name.
/// With `from`, what needs a map of the surface itself (area, angle, stretch, curvature) is
/// refused. Throws: BakeSettingError and FieldError before anything is baked; NotCertifiedError
/// where the chart of a mesh is not one-to-one; OtherSphereError; ImageError for textures that
/// cannot be read and for what a format cannot hold (HalfRangeError); UnmeasurableMesh for lengths
/// of a mesh that is not between 1e-31 and 1e31 long; WriteError; Cancelled. Cost:
/// linear in texels and triangles; memory for some rows a field. 1 µs a texel and field, but for
/// those that cast rays.
BakeReport bake(const MappedMesh& source, const std::vector<BakeRequest>& images,
                const BakeSettings& settings = {});

/// The same into files that the caller publishes, with others of his.
BakeReport bake(const MappedMesh& source, const std::vector<BakeRequest>& images,
                const BakeSettings& settings, PendingFiles& files);

/// Throws what `bake` would throw before it looks at a mesh: BakeSettingError; FieldError.
void require_bakeable(const std::vector<BakeRequest>& images, const BakeSettings& settings);

/// Where what geographic programs read beside an image goes: map.tif.aux.xml.
std::string sidecar_path(const std::string& image);
/// Whether an image has one where a body is given: those of .png and .tif have.
bool has_sidecar(const std::string& image);

/// Where the scale of a heat map goes: heat.png has it in heat_scale.png beside it.
std::string scale_path(const std::string& image);

/// A field whose values are wanted, not an image of it.
struct BakedField {
  std::string name;           // "curvature:mean" of "curvature"
  std::string about;          // unit, space, convention
  int channels = 1;           // 1, 3 or 4; where there are fillers one more, 0 on them, 4 at most
  std::string rounding = {};  // what float32 loses of values that are far from 0; empty: nothing
};

/// Takes rows of the field with this index, from the top, one call after the other for a field; for
/// several fields at the same time. `values`: channels · width · rows numbers, interleaved.
using BakedRows = std::function<void(size_t index, const BakedField& field, int first_row, int rows,
                                     const float* values)>;

/// The values of fields, before they become samples of a file: colours are linear light, directions
/// unit vectors, labels numbers, columns in u = θ/2π whatever the convention. Of the settings,
/// `depth` and `mip` are not looked at. Test images are no fields.
/// Throws: as `bake`, but for files; what `rows` throws.
std::vector<BakedField> bake_values(const MappedMesh& source,
                                    const std::vector<std::string>& fields,
                                    const BakeSettings& settings, const BakedRows& rows);

}  // namespace sphparam
