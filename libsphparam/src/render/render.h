#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "render/colour.h"
#include "sphparam/image/image.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/mesh/triangle_mesh.h"
#include "texture/source_texture.h"
#include "texture/texture_seams.h"

namespace sphparam {

/// Looks at `target` from the side `direction`; `height` of the world fits into the picture there.
struct Camera {
  Vector3 target = Vector3::Zero();
  Vector3 direction = Vector3::UnitX();  // from the target towards the eye, any length
  Vector3 up = Vector3::UnitZ();
  double height = 2;
  double field_of_view = 0;  // degrees, vertical; 0: orthographic
};

/// One colour everywhere.
struct UniformPaint {
  Rgb colour{0.80F, 0.80F, 0.82F};
};
/// A colour a vertex, interpolated; or that of the nearest corner.
struct VertexPaint {
  std::vector<Rgb> colours;
  bool blends = true;
  std::vector<Rgb> of_corners = {};  // 3·#F, interpolated instead; empty: those of vertices
};
/// A colour a triangle.
struct FacePaint {
  std::vector<Rgb> colours;
};
/// Fields of the (θ, ϕ) grid in turn dark and light, exact in every pixel.
struct CheckerPaint {
  Points rays;       // #V×3
  double step = 15;  // degrees
  Rgb light{0.93F, 0.92F, 0.88F};
  Rgb dark{0.22F, 0.42F, 0.55F};
};
/// Textures through texture coordinates, v upwards, filtered by what a pixel covers of them.
struct TexturePaint {
  SeamedTexcoords texcoords;            // empty where no texture has an image
  std::vector<SourceTexture> textures;  // alpha is not looked at
  std::vector<int> texture_of = {};     // a face, −1: white; empty: the first for all
  std::vector<Rgb> tints = {};          // 3·#F, interpolated, which multiply them; empty: none
};
using Paint = std::variant<UniformPaint, VertexPaint, FacePaint, CheckerPaint, TexturePaint>;

/// Lines of equal θ and ϕ, the date line θ = 0 in a colour of its own.
struct Graticule {
  Points rays;             // #V×3
  double step = 15;        // degrees
  double width = 1.1;      // pixels
  double date_line = 2.6;  // its width in pixels; 0: none
  float opacity = 0.55F;
  Rgb colour{0.08F, 0.10F, 0.13F};
  Rgb date_line_colour{0.84F, 0.05F, 0.08F};
};

/// The edges of the triangles.
struct Wireframe {
  double width = 0.8;  // pixels
  float opacity = 0.6F;
  Rgb colour{0.10F, 0.12F, 0.16F};
  std::vector<std::uint8_t> hidden_sides = {};  // #F, bit k: not the side that faces corner k
  bool fades = true;                            // where triangles are of a few pixels
};

enum class Shading { Smooth, Flat };

/// One thing to draw.
struct RenderObject {
  TriangleMesh mesh;
  std::optional<Points> normals = std::nullopt;  // unit, one a vertex; else the mesh's own
  /// Unit, 3·#F rows: what it is lit by where the shading is smooth and edges may be hard.
  std::optional<CornerNormals> corner_normals = std::nullopt;
  Paint paint = UniformPaint{};
  Shading shading = Shading::Smooth;
  bool occlusion = false;  // darken what little light reaches; costs a second or so
  std::optional<Graticule> graticule = std::nullopt;
  std::optional<Wireframe> wireframe = std::nullopt;
};

struct RenderScene {
  std::vector<RenderObject> objects;
  Camera camera;
  int width = 800;
  int height = 800;
  int samples = 3;                               // samples² a pixel
  std::optional<Rgb> background = Rgb(1, 1, 1);  // none: transparent
};

/// Draws triangles with a depth buffer, two lights and light from above.
///
/// Returns RGB, or RGBA with alpha not multiplied in where there is no background.
/// Ensures: the same pixels for any number of threads.
/// Requires: paints and overlays as long as their mesh.
/// Cost: about 0.2 µs a sample that is covered, plus one pass over the triangles.
Image render(const RenderScene& scene, int threads = 0);

}  // namespace sphparam
