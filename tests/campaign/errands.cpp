#include "errands.h"

#include <functional>
#include <stdexcept>

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
  add({"-o", make.one_of({"low.ply", "low.obj", "low.glb"})});
  make.maybe(words, 0.4, {"--adaptive"});
  make.maybe(words, 0.3, {"--sample", "cell"});
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
  make.maybe(words, 0.5,
             {"--reconstruct", make.one_of({"smooth.ply", "smooth.obj", "smooth.off"})});
  make.maybe(words, 0.3, {"--csv", "harmonics.csv"});
  make.maybe(words, 0.3, {"--radius", "--centre", make.one_of({"0,0,0", "1e300,-1,2"})});
  make.maybe(words, 0.3, {"--shadr", "radius.sha"});
  make.maybe(words, 0.3, {"--normalisation", "4pi"});
  words.insert(words.end(), {"--json", "harmonics.json"});
  make.errand.commands.push_back(words);
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
  make.maybe(words, 0.3, {"--up", make.one_of({"y", "z"})});
  make.maybe(words, 0.3, {"--json", "out.json"});
  make.errand.commands.push_back(words);
}

struct Kind {
  std::string name;
  void (*make)(Maker&);
};

const std::vector<Kind> kinds = {
    {"render", render},      {"report", report},   {"bake", bake},       {"remesh", remesh},
    {"export", export_mesh}, {"spharm", spharm},   {"measure", measure}, {"paint", paint},
    {"unimage", unimage},    {"compare", compare}, {"map", map},         {"info", info}};

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
      if (words.front() == "info" || words.front() == "verify") continue;  // have no threads
      words.insert(words.end(), {"--threads", random.chance(0.2) ? "2" : "1"});
    }
    return maker.errand;
  }
  throw std::invalid_argument("no errands for " + command);
}

}  // namespace sphparam::campaign
