#include "errands.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>

#include "hurt_meshes.h"

namespace sphparam::campaign {
namespace {

using Words = std::vector<std::string>;

/// An errand in the making.
class Maker {
 public:
  Maker(Random& random, const std::string& picture) : random_(random), picture_(picture) {}

  Errand errand;

  /// A mesh file that is written before. `with_map`: and, by chance, mapped first.
  std::string mesh(const std::string& stem, bool with_map = true) {
    const HurtMesh hurt = make_hurt_mesh(random_);
    errand.story += (errand.story.empty() ? "" : "; ") + hurt.story;
    has_texcoords = hurt.texcoords.rows() > 0;
    const std::string extension = has_texcoords ? ".obj" : one_of({".off", ".obj", ".ply"});
    has_scalar = extension == ".ply";
    errand.files.emplace_back(stem + extension, as_file(hurt, extension));
    if (!with_map || random_.chance(0.5)) return stem + extension;
    Words map = {"map", stem + extension, "-o", stem + ".sph.ply"};
    add_map_options(map);
    errand.commands.push_back(map);
    return stem + ".sph.ply";
  }

  /// A surface that is none: of one or more hurt meshes, with faces missing, doubled and turned
  /// over, vertices without a place. `parts`: how many meshes at most.
  std::string broken_mesh(const std::string& stem, int parts) {
    HurtMesh hurt = make_hurt_mesh(random_);
    const int more = random_.below(parts);
    for (int i = 0; i < more; ++i) append(hurt.mesh, make_hurt_mesh(random_).mesh);
    hurt.polygons.clear();
    hurt.texcoords.resize(0, 2);
    errand.story += (errand.story.empty() ? "" : "; ") + hurt.story + " and " +
                    std::to_string(more) + " more, " + break_faces(hurt.mesh);
    const std::string extension = one_of({".off", ".obj", ".ply"});
    errand.files.emplace_back(stem + extension, as_file(hurt, extension));
    return stem + extension;
  }

  void add_map_options(Words& words) {
    maybe(words, 0.2, {"--quality", one_of({"draft", "best"})});
    maybe(words, 0.2, {"--lambda", one_of({"0.01", "5", "1000"})});
    maybe(words, 0.1, {"--balance", one_of({"conformal", "equal-area"})});
    maybe(words, 0.1, {"--poles", "none"});
    maybe(words, 0.1, {"--energy", "symmetric-dirichlet"});
  }

  std::string picture() {
    if (!has_picture_) errand.files.emplace_back("picture.png", picture_);
    has_picture_ = true;
    return "picture.png";
  }

  std::string one_of(const Words& words) {
    return words[static_cast<size_t>(random_.below(static_cast<int>(words.size())))];
  }

  void maybe(Words& words, double share, const Words& more) {
    if (random_.chance(share)) words.insert(words.end(), more.begin(), more.end());
  }

  /// Some of the words, at least one, with commas between.
  std::string some_of(const Words& words) {
    std::string list = one_of(words);
    for (const std::string& word : words) {
      if (random_.chance(0.15) && list.find(word) == std::string::npos) list += "," + word;
    }
    return list;
  }

  std::string number(int least, int most) { return std::to_string(random_.between(least, most)); }

  std::string grid_of_triangles() {
    return one_of({"ico:" + number(0, 2), "ico:f=" + number(1, 9),
                   "octa:" + std::to_string(2 * random_.between(1, 12) + 1)});
  }

  std::string grid_of_quads() {
    const std::string rows = number(2, 12);
    return one_of({"cube:" + number(1, 12), "uv:" + number(3, 24) + "x" + rows});
  }

  std::string any_grid() {
    return one_of(
        {grid_of_triangles(), grid_of_triangles(), grid_of_quads(), "healpix:" + number(1, 5)});
  }

  bool chance(double share) { return random_.chance(share); }

  bool has_texcoords = false, has_scalar = false;  // of the mesh made last

 private:
  static void append(TriangleMesh& mesh, const TriangleMesh& other) {
    const Eigen::Index vertices = mesh.positions.rows(), faces = mesh.triangles.rows();
    mesh.positions.conservativeResize(vertices + other.positions.rows(), 3);
    mesh.positions.bottomRows(other.positions.rows()) = other.positions;
    mesh.triangles.conservativeResize(faces + other.triangles.rows(), 3);
    mesh.triangles.bottomRows(other.triangles.rows()) =
        (other.triangles.array() + static_cast<int>(vertices)).matrix();
  }

  /// Returns the story of it.
  std::string break_faces(TriangleMesh& mesh) {
    const auto any_face = [&] { return random_.below(static_cast<int>(mesh.face_count())); };
    const int missing = std::min(random_.below(8), static_cast<int>(mesh.face_count()) - 1);
    for (int i = 0; i < missing; ++i) {
      mesh.triangles.row(any_face()) = mesh.triangles.row(mesh.face_count() - 1).eval();
      mesh.triangles.conservativeResize(mesh.face_count() - 1, 3);
    }
    const int turned = random_.below(3), doubled = random_.below(3), shared = random_.below(3);
    for (int i = 0; i < turned; ++i) {
      const int face = any_face();
      std::swap(mesh.triangles(face, 0), mesh.triangles(face, 1));
    }
    for (int i = 0; i < doubled; ++i) mesh.triangles.row(any_face()) = mesh.triangles.row(0).eval();
    const auto vertices = static_cast<int>(mesh.vertex_count());
    for (int i = 0; i < shared; ++i) {  // fans and edges of many faces come of it
      const int face = any_face(), vertex = random_.below(vertices);
      if ((mesh.triangles.row(face).array() != vertex).all()) mesh.triangles(face, 0) = vertex;
    }
    const bool placeless = random_.chance(0.3);
    if (placeless)
      mesh.positions(random_.below(vertices), 1) = std::numeric_limits<double>::quiet_NaN();
    return std::to_string(missing) + " faces missing, " + std::to_string(turned) + " turned, " +
           std::to_string(doubled) + " doubled, " + std::to_string(shared) + " elsewhere" +
           (placeless ? ", a vertex without a place" : "");
  }

  Random& random_;
  const std::string& picture_;
  bool has_picture_ = false;
};

void info(Maker& make) {
  Words words = {"info", make.mesh("mesh")};
  make.maybe(words, 0.5, {"--json", "-"});
  make.errand.commands.push_back(words);
}

/// Maps that lie as the body does. No vertex is at these centres.
void map_of_body(Maker& make) {
  Words words = {"map",      make.mesh("mesh", false),
                 "-o",       "map.sph.ply",
                 "--centre", make.one_of({"0.3,-0.2,1e-9", "-1e-7,0.1234567,1e200"})};
  make.maybe(words, 0.5, {"--align", "body"});
  if (words.back() != "body") words.insert(words.end(), {"--method", "radial"});
  make.maybe(words, 0.3, {"--json", "map.json"});
  make.errand.commands.push_back(words);
  make.errand.commands.push_back({"verify", "map.sph.ply"});
}

void map(Maker& make) {
  if (make.one_of({"own", "own", "own", "own", "body"}) == "body") return map_of_body(make);
  Words words = {"map", make.mesh("mesh", false), "-o", "map.sph.ply"};
  make.add_map_options(words);
  make.maybe(words, 0.1, {"--method", make.one_of({"curvilinear", "paper", "tangential"})});
  make.maybe(words, 0.3, {"--json", "map.json"});
  make.maybe(words, 0.2, {"--plots", "plots"});
  make.maybe(words, 0.3,
             {"--repair", "--handles", make.one_of({"shortest", "cut", "fill", "area"}),
              "--max-handle", make.one_of({"1e-9", "5%", "1e300%"}), "--loops", "loops.obj"});
  make.maybe(words, 0.2, {make.one_of({"--keep-holes", "--keep-holes=20%"})});
  make.errand.commands.push_back(words);
  make.errand.commands.push_back({"verify", "map.sph.ply", "--chart"});
}

void render(Maker& make) {
  const std::string mesh = make.mesh("mesh");
  const bool mapped = mesh.ends_with(".sph.ply");
  Words words = {"render", mesh, "-o", "mesh.png", "--size", make.number(16, 120)};
  if (mapped) {
    make.maybe(words, 0.3, {"--view", make.one_of({"mesh", "sphere", "both"})});
    make.maybe(words, 0.6, {"--colour", make.one_of({"area", "angle", "checker"})});
    make.maybe(words, 0.4, {"--graticule"});
  } else {
    make.maybe(words, 0.5, {"--colour", make.one_of({"plain", "normals"})});
  }
  if (make.has_texcoords) make.maybe(words, 0.4, {"--texture", make.picture()});
  make.maybe(words, 0.5, {"--wire"});
  make.maybe(words, 0.5, {"--occlusion"});
  make.maybe(words, 0.2,
             {"--from", make.one_of({"1,2,3", "0,0.001,1", "-1e200,1,0", "1e-300,0,1"})});
  make.maybe(words, 0.2, {"--up", "y"});
  make.errand.commands.push_back(words);
}

void compare(Maker& make) {
  Words words = {"compare", make.mesh("mesh", false), "-o", "pages", "--size", "48"};
  make.maybe(
      words, 0.9,
      {"--methods", make.one_of({"progressive", "progressive,curvilinear", "paper,tangential",
                                 "progressive,conformal", "stereographic,progressive",
                                 "hemispheres", "flow,progressive", "brechbuehler"})});
  make.maybe(words, 0.2, {"--no-pictures"});
  make.errand.commands.push_back(words);
}

void report(Maker& make) {
  Words words = {"report", make.mesh("mesh"), "-o", "page.html", "--size", "64"};
  if (make.has_texcoords) make.maybe(words, 0.4, {"--texture", make.picture()});
  make.maybe(words, 0.5, {"--no-viewer"});
  make.maybe(words, 0.3, {"--up", "y"});
  make.maybe(words, 0.3, {"--json", "page.json"});
  make.errand.commands.push_back(words);
}

void bake(Maker& make) {
  const std::string mesh = make.mesh("mesh");
  Words maps = {"normal-object", "normal-tangent",
                "position",      "height",
                "height:radial", "ao",
                "bent",          "thickness",
                "curvature",     "curvature:gauss",
                "area",          "angle",
                "stretch",       "id",
                "id:component",  "axes",
                "checker",       "graticule",
                "lonlat",        "radius",
                "slope",         "elevation"};
  if (make.has_texcoords) maps.insert(maps.end(), {"uv", "basecolor"});
  if (make.has_scalar) maps.insert(maps.end(), {"scalar:depth", "vcolor"});
  const std::string format = make.one_of({".png", ".exr", ".tif"});
  Words words = {"bake",   mesh,
                 "--map",  make.some_of(maps),
                 "-o",     "mesh_{map}" + format,
                 "--size", std::to_string(4 * std::stoi(make.number(2, 16)))};
  if (make.has_texcoords) words.insert(words.end(), {"--texture", make.picture()});
  make.maybe(words, 0.4, {"--rays", make.number(1, 16)});
  make.maybe(words, 0.3, {"--samples", make.number(1, 3)});
  make.maybe(words, 0.3, {"--interp", "sphere"});
  make.maybe(words, 0.2, {"--max-dist", make.one_of({"1e-9", "1", "1000"})});
  make.maybe(words, 0.2, {"--filter", make.one_of({"nearest", "bicubic"})});
  make.maybe(words, 0.2, {"--heat"});
  make.maybe(words, 0.2, {"--normal-y", "dx"});
  make.maybe(words, 0.2, {"--convention", make.one_of({"three", "gis", "envmap", "blender"})});
  make.maybe(words, 0.3,
             {"--body", make.one_of({"vesta", "1,2,3", "1e-300", "1e300"}), "--unit", "km"});
  make.maybe(words, 0.1, {"--west"});
  make.maybe(words, 0.1, {"--centre", make.one_of({"0,0,0", "1e300,-1,2"})});
  make.maybe(words, 0.3, {"--json", "bake.json"});
  if (format == ".exr") {
    make.maybe(words, 0.3, {"--depth", "half"});
    make.maybe(words, 0.3, {"--mip"});
  } else {
    make.maybe(words, 0.4, {"--depth", make.one_of({"u8", "u16"})});
  }
  if (make.chance(0.2)) {
    make.errand.commands.push_back(
        {"remesh", mesh, "--grid", make.any_grid(), "-o", "low.sph.ply"});
    words.insert(words.end(), {"--for", "low.sph.ply"});
  }
  make.errand.commands.push_back(words);
}

void remesh(Maker& make) {
  Words words = {"remesh", make.mesh("mesh")};
  const auto add = [&](const Words& more) { words.insert(words.end(), more.begin(), more.end()); };
  if (make.chance(0.15)) {  // fits take ten times as long as the rest
    const bool quads = make.chance(0.5);
    add({"--grid", quads ? make.grid_of_quads() : make.grid_of_triangles()});
    add({"--subdiv-fit", quads ? "catmark" : "loop"});
    make.maybe(words, 0.3, {"--limit-mesh", "limit.ply"});
    if (make.chance(0.5)) {
      add({"--displace", make.one_of({"detail.exr", "detail.png"})});
      add({"--displace-size", make.one_of({"32x16", "48x20"})});
      make.maybe(words, 0.5, {"--rebuild", "again.obj"});
    }
  } else if (make.chance(0.3)) {
    add({"--grid", make.one_of({"ico:2", "octa:9", "cube:4"}), "--lods", make.number(1, 2)});
  } else {
    add({"--grid", make.any_grid()});
  }
  add({"-o", make.one_of({"low.ply", "low.obj", "low.glb", "lh.low.surf.gii"})});
  make.maybe(words, 0.4, {"--adaptive"});
  make.maybe(words, 0.4, {"--sample", make.one_of({"cell", "adap-bary-area"})});
  make.maybe(words, 0.2, {"--transfer", make.one_of({"none", "uv", "normal", "color"})});
  make.maybe(words, 0.2, {"--csv", "low.csv"});
  make.maybe(words, 0.3, {"--json", "low.json"});
  make.errand.commands.push_back(words);
}

void unimage(Maker& make) {
  const std::string mesh = make.mesh("mesh");
  const std::string grid = make.chance(0.5)
                               ? "cube:" + make.number(1, 12)
                               : "octa:" + std::to_string(2 * std::stoi(make.number(1, 12)) + 1);
  const std::string extension = make.one_of({".exr", ".png"});
  Words words = {"remesh", mesh, "--grid", grid, "--geometry-image", "points" + extension};
  if (extension == ".exr") make.maybe(words, 0.3, {"--depth", "half"});
  Words back = {"unimage", "points" + extension, "-o", make.one_of({"again.ply", "again.obj"})};
  if (make.chance(0.5)) {
    words.insert(words.end(), {"--normal-image", "normals" + extension});
    back.insert(back.end(), {"--normals", "normals" + extension});
  }
  make.errand.commands.push_back(words);
  make.errand.commands.push_back(back);
}

void measure(Maker& make) {
  const std::string first = make.mesh("first", false);
  Words words = {"measure", first};
  if (make.chance(0.5)) {
    words.push_back(make.mesh("second", false));
  } else {
    make.errand.commands.push_back({"remesh", first, "--grid", make.any_grid(), "-o", "low.ply"});
    words.push_back("low.ply");
  }
  words.insert(words.end(), {"--samples", make.number(1, 3000)});
  make.maybe(words, 0.4, {"--over", make.some_of({"faces", "edges", "vertices"})});
  make.maybe(words, 0.3, {"--per-vertex", "error.ply"});
  make.maybe(words, 0.2, {"--growth"});
  make.maybe(words, 0.3, {"--max-rms", make.one_of({"0.1%", "1e-300", "1"})});
  make.maybe(words, 0.3, {"--json", "distance.json"});
  make.errand.commands.push_back(words);
}

void paint(Maker& make) {
  Words words = {"paint", make.mesh("mesh"), "--image", make.picture()};
  if (make.has_texcoords && make.chance(0.6)) {
    words.insert(words.end(), {"-o", "atlas.png", "--atlas", make.number(1, 64)});
    make.maybe(words, 0.3, {"--padding", make.number(0, 8)});
  } else {
    words.insert(words.end(), {"-o", make.one_of({"painted.ply", "painted.obj", "painted.off"})});
  }
  make.maybe(words, 0.2, {"--convention", make.one_of({"three", "gis", "envmap", "blender"})});
  make.errand.commands.push_back(words);
}

void spharm(Maker& make) {
  Words words = {"spharm", make.mesh("mesh"), "--degree", make.number(0, 12)};
  if (make.has_scalar) make.maybe(words, 0.3, {"--scalar", "depth"});
  make.maybe(words, 0.4, {"--fit", "quadrature"});
  const std::string smooth = make.one_of({"smooth.ply", "smooth.obj", "smooth.off"});
  if (make.chance(0.5)) {
    words.insert(words.end(), {"--reconstruct", smooth});
    make.maybe(words, 0.4, {"--grid", make.any_grid()});
  }
  make.maybe(words, 0.3, {"--csv", "harmonics.csv"});
  make.maybe(words, 0.3, {"--radius", "--centre", make.one_of({"0,0,0", "1e300,-1,2"})});
  make.maybe(words, 0.3, {"--shadr", "radius.sha"});
  make.maybe(words, 0.3, {"--normalisation", "4pi"});
  words.insert(words.end(), {"--json", "harmonics.json"});
  make.errand.commands.push_back(words);
  if (make.chance(0.3))
    make.errand.commands.push_back({"spharm", "harmonics.json", "--grid", make.any_grid(),
                                    "--degree", make.number(0, 12), "--reconstruct", "again.ply"});
}

void export_mesh(Maker& make) {
  const std::string extension = make.one_of({".glb", ".glb", ".gltf", ".obj", ".ply"});
  Words words = {"export", make.mesh("mesh"), "-o", "out" + extension};
  const auto add = [&](const Words& more) { words.insert(words.end(), more.begin(), more.end()); };
  make.maybe(words, 0.3, {"--image", make.picture()});
  make.maybe(words, 0.3, {"--convention", make.one_of({"three", "gis", "blender"})});
  if (make.chance(0.3)) {
    add({"--refine-poles", make.number(2, 9)});
  } else if (make.chance(0.3)) {
    add({"--keep-topology"});
  }
  if (extension == ".glb" || extension == ".gltf") {
    make.maybe(
        words, 0.3,
        {"--variants", make.some_of({"axes", "checker", "area", "angle"}), "--image-size", "64"});
    make.maybe(words, 0.3, {"--tangents"});
    make.maybe(words, 0.3, {"--theta-phi"});
    make.maybe(words, 0.3, {"--quantize"});
    make.maybe(words, 0.3, {"--compress"});
    if (make.chance(0.3)) {
      add({"--morph", make.one_of({"sphere", "flat"})});
    } else if (make.chance(0.3)) {
      add({"--shape", make.one_of({"sphere", "flat"})});
    } else if (make.chance(0.3)) {
      add({"--lods", "1", "--lod", make.one_of({"files", "msft"})});
    }
  } else {
    make.maybe(words, 0.3, {"--shape", "sphere"});
  }
  make.maybe(words, 0.3, {"--up", make.one_of({"x", "-x", "y", "-y", "z", "-z", "1,2,3"})});
  make.maybe(words, 0.3, {"--json", "out.json"});
  make.errand.commands.push_back(words);
}

void add_repair_options(Maker& make, Words& words) {
  make.maybe(words, 0.3,
             {"--handles", make.one_of({"shortest", "cut", "fill", "area"}), "--max-handle",
              make.one_of({"1e-9", "5%", "1e300%"})});
  make.maybe(words, 0.2, {"--weld", make.one_of({"0", "1e-300", "1%", "1e300"})});
}

/// Where the mended mesh is what is written.
void add_repair_and_loops(Maker& make, Words& words) {
  add_repair_options(make, words);
  make.maybe(words, 0.2, {"--loops", make.one_of({"loops.obj", "loops.ply"})});
}

/// Every format out and in again.
void repair(Maker& make) {
  const std::string mended =
      "mended" + make.one_of({".ply", ".obj", ".off", ".vtk", ".vtp", ".mz3", ".surf.gii", ".white",
                              ".ply.gz", ".vtk.gz", ".obj.gz"});
  Words words = {"repair", make.broken_mesh("mesh", 3), "-o", mended};
  add_repair_and_loops(make, words);
  make.maybe(words, 0.2, {"--keep-holes"});
  make.maybe(words, 0.3, {"--component", "1"});
  make.maybe(words, 0.3, {"--json", "repair.json"});
  make.errand.commands.push_back(words);
  make.errand.commands.push_back({"map", mended, "-o", "map.sph.ply", "--repair"});
}

/// What follows a map with holes that stay.
void holes(Maker& make) {
  Words words = {"map",      make.broken_mesh("mesh", 1),
                 "-o",       "map.sph.ply",
                 "--repair", make.one_of({"--keep-holes", "--keep-holes=20%"})};
  add_repair_and_loops(make, words);
  make.errand.commands.push_back(words);
  const std::vector<Words> uses = {
      {"verify", "map.sph.ply"},
      {"bake", "map.sph.ply", "--map", make.some_of({"normal-object", "ao", "curvature", "area"}),
       "-o", "map_{map}.png", "--size", "32"},
      {"remesh", "map.sph.ply", "--grid", make.any_grid(), "-o", "low.ply"},
      {"export", "map.sph.ply", "-o", make.one_of({"map.glb", "map.obj"})},
      {"report", "map.sph.ply", "-o", "page.html", "--size", "32"},
      {"measure", "map.sph.ply", "map.sph.ply"},
      {"spharm", "map.sph.ply", "--degree", "4"},
      {"render", "map.sph.ply", "-o", "map.png", "--size", "32"}};
  make.errand.commands.push_back(
      uses[static_cast<std::size_t>(std::stoi(make.number(0, static_cast<int>(uses.size()) - 1)))]);
}

void parts(Maker& make) {
  Words words = {"map", make.broken_mesh("mesh", 5), "-o", "map.sph.ply", "--all-components"};
  make.maybe(words, 0.8, {"--repair"});
  if (words.back() == "--repair") {
    make.maybe(words, 0.3, {"--keep-holes"});
    add_repair_and_loops(make, words);
  }
  make.maybe(words, 0.3, {"--json", "map.json"});
  make.errand.commands.push_back(words);
  make.errand.commands.push_back({"verify", "map_0001.sph.ply"});
}

/// Any subcommand that takes a mesh, of one that is none before it is mended.
void mended(Maker& make) {
  const std::string mesh = make.broken_mesh("mesh", 2);
  const std::vector<Words> uses = {
      {"bake", mesh, "--map", make.some_of({"normal-object", "ao", "curvature", "area"}), "-o",
       "map_{map}.png", "--size", "32"},
      {"remesh", mesh, "--grid", make.any_grid(), "-o", "low.ply"},
      {"export", mesh, "-o", make.one_of({"map.glb", "map.obj"}), "--image-size", "64"},
      {"report", mesh, "-o", "page.html", "--size", "64", "--no-viewer"},
      {"measure", mesh, mesh, "--samples", "500"},
      {"spharm", mesh, "--degree", "4", "--json", "harmonics.json"},
      {"paint", mesh, "--image", make.picture(), "-o", "painted.ply"},
      {"compare", mesh, "-o", "pages", "--methods", "progressive", "--no-pictures"},
      {"group", mesh, "-o", "group", "--start", "maps", "--hold", "--size", "0", "--grid", "ico:2"},
      {"render", mesh, "-o", "map.png", "--size", "32"}};
  Words words =
      uses[static_cast<std::size_t>(std::stoi(make.number(0, static_cast<int>(uses.size()) - 1)))];
  words.push_back(make.one_of({"--repair", "--repair", "--repair=holes,unused"}));
  add_repair_options(make, words);
  make.maybe(words, 0.2, {"--keep-holes"});
  make.maybe(words, 0.3, {"--component", "1"});
  make.errand.commands.push_back(words);
}

/// A surface about what is none.
void wrap(Maker& make) {
  const std::string wrapped =
      "wrapped" + make.one_of({".ply", ".obj", ".off", ".vtp", ".surf.gii"});
  Words words = {"wrap", make.broken_mesh("mesh", 4), "-o", wrapped};
  if (make.chance(0.7))
    words.insert(words.end(), {"--resolution", make.number(4, 40)});
  else
    words.insert(words.end(), {"--voxel", make.one_of({"1e-300", "0.01", "0.1", "1", "1e300"})});
  make.maybe(words, 0.3, {"--distance", make.one_of({"1e-9", "0.2", "1", "1e200"})});
  make.maybe(words, 0.3, {"--largest"});
  make.maybe(words, 0.4, {"--faces", make.one_of({"1", "4", "100", "1000"})});
  make.maybe(words, 0.3, {"--json", "wrap.json"});
  make.errand.commands.push_back(words);
  make.errand.commands.push_back({"map", wrapped, "-o", "map.sph.ply"});
}

/// The whole way of what may be whole or not.
void asset(Maker& make) {
  const std::string mesh =
      make.chance(0.5) ? make.mesh("mesh", false) : make.broken_mesh("mesh", 3);
  Words words = {"asset",        mesh,
                 "-o",           "made",
                 "--size",       std::to_string(4 * std::stoi(make.number(8, 16))),
                 "--resolution", make.number(8, 32)};
  make.maybe(words, 0.4, {"--faces", make.one_of({"0", "4", "200"})});
  make.maybe(words, 0.2, {"--keep", make.one_of({"0", "0.5", "1"})});
  make.maybe(words, 0.2, {"--samples", "2"});
  make.maybe(words, 0.3, {"--compress"});
  make.maybe(words, 0.3, {"--occlusion"});
  make.maybe(words, 0.3, {"--up", make.one_of({"x", "-y", "z", "1,2,3"})});
  make.maybe(words, 0.5, {"--no-page"});
  make.maybe(words, 0.3, {"--json", "asset.json"});
  make.errand.commands.push_back(words);
  make.errand.commands.push_back({"verify", "made/mesh.sph.ply"});
}

/// Of the folder with all its files.
void survey(Maker& make) {
  const int count = std::stoi(make.number(1, 3));
  for (int i = 0; i < count; ++i) make.broken_mesh("mesh" + std::to_string(i), 2);
  if (make.chance(0.5))
    make.errand.files.emplace_back("text.ply", "ply\nformat ascii 1.0\nnonsense\n");
  Words words = {"survey", ".", "-o", "page.html", "--size", make.one_of({"0", "16", "64"})};
  make.maybe(words, 0.3, {"--json", "survey.json"});
  make.maybe(words, 0.3, {"--records", "."});
  make.maybe(words, 0.2, {"--max-seconds", make.one_of({"1e-9", "0.05", "60"})});
  make.errand.commands.push_back(words);
}

struct Kind {
  std::string name;
  void (*make)(Maker&);
};

const std::vector<Kind> kinds = {
    {"render", render},      {"report", report},   {"bake", bake},       {"remesh", remesh},
    {"export", export_mesh}, {"spharm", spharm},   {"measure", measure}, {"paint", paint},
    {"unimage", unimage},    {"compare", compare}, {"map", map},         {"info", info},
    {"repair", repair},      {"holes", holes},     {"parts", parts},     {"survey", survey},
    {"mended", mended},      {"wrap", wrap},       {"asset", asset}};

}  // namespace

const std::vector<std::string>& errand_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Kind& kind : kinds) all.push_back(kind.name);
    return all;
  }();
  return names;
}

Errand make_errand(const std::string& command, std::uint64_t seed, std::uint64_t number,
                   const std::string& picture) {
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15;  // keeps neighbouring seeds apart
  std::uint64_t kind_number = 0;
  for (const Kind& kind : kinds) {
    ++kind_number;
    if (kind.name != command) continue;
    Random random(((seed * 1'000'003 + number) * 101 + kind_number) * golden);
    Maker maker(random, picture);
    kind.make(maker);
    for (Words& words : maker.errand.commands) {
      const std::string& word = words.front();
      if (word == "info" || word == "verify" || word == "repair") continue;  // have no threads
      words.insert(words.end(), {"--threads", random.chance(0.2) ? "2" : "1"});
    }
    return maker.errand;
  }
  throw std::invalid_argument("no errands for " + command);
}

}  // namespace sphparam::campaign
