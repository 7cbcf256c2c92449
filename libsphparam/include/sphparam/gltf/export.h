#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/gltf/asset.h"
#include "sphparam/gltf/gltf_writer.h"
#include "sphparam/gltf/texture_format.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/progress.h"
#include "sphparam/texture/convention.h"

namespace sphparam {

// A mapped mesh → its (u, v) chart → vertex buffers, images, materials → files. Any equirectangular
// image sits right on it: the mesh is split along the date line and at the poles, every pole
// triangle has a vertex of its own there, u runs from 0 to 1 and never folds.

/// What the vertices of an asset are: the mesh, its image on the unit sphere, the (u, v) rectangle.
enum class ShapeKind { Mesh, Sphere, Flat };

/// What an animation turns the mesh into; Flat: first into the sphere, then into the rectangle.
enum class Morph { None, Sphere, Flat };

/// Another shape that an animation turns the mesh into, in the axes of the mesh.
struct OtherShape {
  std::string name;
  Points positions, normals;  // #V×3; normals unit
};

/// What an asset shows. Paths of images; empty: none. Of PNG, JPEG, WebP, TIFF, BMP and TGA.
struct LookOptions {
  std::string texture = {};    // an equirectangular image, row 0 north
  std::string normal = {};     // a normal map in the tangent frame of the asset, as `bake` makes it
  std::string occlusion = {};  // ambient occlusion, in red
  std::string orm = {};        // occlusion, roughness and metallic in red, green and blue
  std::string emissive = {};   // light that is given
  /// Of `bake`: its basecolor, normal-tangent, ao, orm and emissive, but for those above.
  std::string folder = {};
  std::vector<std::string> variants = {};  // more materials to switch to, of `variant_names`
  int image_width = 2048;     // of images that are made here; 16 to 16384, a multiple of 4
  bool unlit = false;         // the colours as they are, without light: no normal map, no occlusion
  bool bake_colours = false;  // of vertices, so that they tint no other material
  /// For an .obj or .ply: a normal map of the folder that is none of .mtl and glTF is left out and
  /// told, not refused.
  bool for_text = false;
  bool tangents = false;                          // also without a normal map: a flat one is bound
  TextureFormat textures = TextureFormat::Given;  // what all images are made at the end
  int webp_quality = 90;  // of TextureFormat::Webp, 1 to 100: of colours, alpha is kept
};

struct ExportOptions {
  std::string name = {};    // of the asset; empty: the mesh's, without its ending
  std::string source = {};  // the mesh for extras and warnings; empty: its name
  LookOptions look = {};
  Convention convention = Convention::Sphparam;  // where longitude goes in the images
  int refine_poles = 1;        // each triangle at a pole is cut into so many, 1 to 1024
  bool keep_topology = false;  // no vertex is added on the surface: triangles fold at the poles
  ShapeKind shape = ShapeKind::Mesh;
  Morph morph = Morph::None;            // from the mesh: with ShapeKind::Mesh
  std::vector<OtherShape> others = {};  // after those of `morph`; of the mesh, not of `coarser`
  Up up = {};              // how the mesh stands; what is made says it, but for z up unasked
  bool theta_phi = false;  // _THETA_PHI, radians; θ in [0, 2π), ϕ in [0, π]
  bool source_uv = false;  // TEXCOORD_1: the texture coordinates of the mesh itself
  bool quantise = false;   // (u, v) and all else as 16-bit numbers: certified so
  bool upward_v = false;   // for USD: (u, v) are certified as (u, 1 − v) in float32
  std::vector<MappedMesh> coarser = {};  // levels of detail on the same sphere, in the same file
  int threads = 0;                       // 0: all cores
  Progress progress = {};
};

/// The words for `LookOptions::variants`: axes, checker, graticule, area, angle.
const std::vector<std::string>& variant_names();

/// A look that the mesh cannot have: a variant that nobody knows, a texture of its own without
/// texture coordinates, a normal map that is none of glTF. Says which.
class LookError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An image that `bake` made for another chart, with triangles at the poles cut otherwise: its
/// texels would stand on the wrong ones there.
class ImageOfOtherChart : public std::runtime_error {
 public:
  ImageOfOtherChart(const std::string& path, int refine_poles);
  const std::string& path() const { return path_; }
  int refine_poles() const { return refine_poles_; }  // of the chart that it was baked for

 private:
  std::string path_;
  int refine_poles_;
};

/// The images of an asset and the materials made of them, the one that is seen first.
struct Look {
  std::vector<AssetImage> images;
  std::vector<Material> materials;
  bool normals_given = false;                 // by a map for the tangent frame of one mesh
  bool vertex_colours = false;                // what is seen are the colours of the vertices
  std::vector<TextureFigures> textures = {};  // what became of the images, one each
  std::vector<std::string> warnings = {};     // for people: materials that disagree
  std::vector<std::string> remarks = {};      // likewise: images that are one colour, made small

  bool has_normals() const { return !materials.empty() && materials.front().normal >= 0; }
};

/// Images that `bake` made say in their metadata how alpha is meant, whether surfaces are seen from
/// both sides, without light, with which finish, and how strong emission is; alpha of others that
/// is used is a mask where it is 0 or 1 everywhere, else blended. Normal maps that say of
/// themselves that they show other things or have y down are refused, those for a mesh of another
/// name told. Occlusion is that of `orm` where no other is given. What is the same all over takes
/// no image: roughness and metallic are numbers then, occlusion that darkens nothing and emission
/// that is black are left out; other occlusion and emission are one texel.
///
/// What is seen: the images that are named; else the mesh's own textures, baked; else the colours
/// of its vertices; else white under a normal or occlusion map, a checker without. The variants
/// follow. Of `options`: look, convention, refine_poles, source, threads, progress.
/// Throws: LookError; ImageOfOtherChart; ImageError and ReadError for images that cannot be read;
/// NotCertifiedError where something must be baked and (u, v) is not one-to-one;
/// std::invalid_argument, before any work, for options outside their domains, and for more
/// `refine_poles` than a chart can hold; Cancelled.
Look make_look(const MappedMesh& mapped, const ExportOptions& options = {});

/// The look of a mesh that was made of `source`, on the same sphere: where it carries texture
/// coordinates, which are only as fine as its vertices, the source's own textures, baked; else as
/// above.
Look make_look(const MappedMesh& made, const MappedMesh& source, const ExportOptions& options = {});

/// The same for another mesh on the same sphere, whose tangent frame is another: no normal map that
/// was given.
Look without_given_normals(Look look);

/// The warning that goes with it.
inline constexpr char normals_left_out[] =
    "the normal map is of the finest mesh: coarser levels are without";

/// The mesh as vertex buffers with (u, v) certified as a file will store them, and its look.
/// Coarser levels share the look, but for a normal map that was given. Ensures: the same asset for
/// any number of threads. Throws: as `make_look`; NotCertifiedError, named by the mesh's name,
/// where the (u, v) of a level are not one-to-one, unless the topology is kept; std::range_error
/// where a position is beyond float32; UnmeasurableMesh where the mesh is less than 1e-31 long, too
/// small for it, while a coarser level that seems to be on another sphere is but a warning;
/// std::invalid_argument for options
/// outside their domains, where another shape has not a row a vertex, `keep_topology` and
/// `refine_poles` are both wanted, more `refine_poles` than a chart can hold, or the texture
/// coordinates of a mesh that has none. Cost: some 2 µs a triangle; images that are baked, as
/// `bake`.
Asset make_asset(const MappedMesh& mapped, const ExportOptions& options = {});

/// The same with a look made before, of this mesh or of another one on the same sphere.
Asset make_asset(const MappedMesh& mapped, const Look& look, const ExportOptions& options = {});

/// Names and sizes of files.
using WrittenFiles = std::vector<std::pair<std::string, std::size_t>>;

/// "statue.glb 3.4 MB, 62 % of it images": for people. `image_bytes`: of the images in them.
std::string words_of(const WrittenFiles& files, std::size_t image_bytes);

std::size_t bytes_of(const std::vector<AssetImage>& images);

/// The files that an asset becomes, the one named first: of .gltf also a .bin and images, unless
/// they are embedded, of .usda images.
std::vector<std::string> asset_files(const std::string& path, const Asset& asset,
                                     const GltfOptions& options = {});

/// Adds the files of an asset: one .glb; a .gltf beside a .bin and images, or by
/// GltfContainer::Embedded alone; a .usda beside images, or one .usdz, whose options are none. The
/// path decides: container and stem of the options do not count
/// otherwise; "-" is a .glb on standard output. Where it is compressed, triangles and vertices come
/// in an order that makes it small, without vertices that no triangle has. Places that 16-bit
/// numbers would make one are set apart by some of their steps, as far as there is room: who welds
/// what is at one place would find no closed surface. What is on the disk is
/// read back and compared number by number. Throws: WriteError, also where a .bin or an image of
/// that name is there that no export of the name wrote; NotCertifiedError where 16-bit numbers are
/// asked for here alone, not of `make_asset`, and fold triangles in (u, v) that do not fold in the
/// asset, as for USD where (u, 1 − v) does; std::length_error where a .glb or .usdz would be beyond
/// 4 GiB; std::runtime_error where what was
/// read back differs; std::invalid_argument for other endings, and as `write_usd`.
WrittenFiles add_asset(PendingFiles& files, const std::string& path, const Asset& asset,
                       const GltfOptions& options = {});

/// Writes the files of an asset, all or none; the path decides which. Throws: as `add_asset`.
void write_asset(const std::string& path, const Asset& asset, const GltfOptions& options = {});

// The same for programs that read texts: numbers are doubles, properties of vertices and faces come
// along, axes stay as they are, and comments say which were asked for. One material with the first
// image of the look, of an .obj also with its normals, roughness, metallic and emission; what else
// the look has is among the warnings.

struct TexturedFiles {
  ChartFigures chart;                 // `stored`: of the texture coordinates read back
  std::vector<std::string> warnings;  // for people
  WrittenFiles files;
  std::vector<TextureFigures> textures = {};  // of the images in them, where the look has figures
  std::size_t image_bytes = 0;                // of these, all together
};

/// Of an .obj its .mtl and the images that it names, of a .ply an image that a comment names.
std::vector<std::string> textured_files(const std::string& path, const Look& look);

/// For programs that want to know before work. Throws: WriteError where the .mtl of an .obj of this
/// name, or the .bin of a .gltf in several files, is there and was not written by an export, as
/// other meshes may need it; where the name of an .obj, .ply or .usda cannot stand in a line of
/// text, in which what is beside it is named.
void require_export_place(const std::string& path);

/// Adds an .obj or .ply with (u, v) at corners, and what it names. What is on the disk is read back
/// and its (u, v) are certified. Of `options`: convention, refine_poles, keep_topology, source,
/// threads, progress; `shape`: the mesh or its sphere.
/// Throws: WriteError, as `require_export_place` and for an image that no export wrote too;
/// UnmeasurableMesh for positions that are no finite numbers; std::runtime_error where what was
/// read back differs; NotCertifiedError and std::invalid_argument as `make_asset`, for a look
/// without an image, and for other endings.
TexturedFiles add_textured_mesh(PendingFiles& files, const std::string& path,
                                const MappedMesh& mapped, const Look& look,
                                const ExportOptions& options = {});

/// Writes an .obj or .ply and what it names, with the look of the options, all or none. Throws: as
/// `make_look` and `add_textured_mesh`.
TexturedFiles write_textured_mesh(const std::string& path, const MappedMesh& mapped,
                                  const ExportOptions& options = {});

}  // namespace sphparam
