// A subcommand each, by its name, on the smallest mesh that gives it all its work; and:
//   holes        map with holes kept           parts      map of all components
//   threads      map by three threads          data       numbers of vertices, in files beside
//   repair.EXT   writes that format of meshes  read.EXT   reads it
//   data.EXT     reads and writes that format of numbers a vertex

#include "faults/errands.h"

#include <map>
#include <stdexcept>

#include "support/joined.h"
#include "support/test_meshes.h"

namespace sphparam::tests {
namespace {

/// A ball with a hole and a doubled face, or two whole balls.
TriangleMesh damaged_ball() {
  TriangleMesh mesh = icosphere(1);
  mesh.triangles.row(7) = mesh.triangles.row(8);
  mesh.triangles.conservativeResize(mesh.face_count() - 1, 3);
  return mesh;
}

TriangleMesh two_balls() { return joined(icosphere(1), icosphere(1), {5, 5, 5}); }

const Words map_it = {"map", "@scans/mesh.off", "-o", "@in.sph.ply"};
const Words make_another = {"remesh", "@in.sph.ply", "--grid", "ico:1", "-o", "@other.sph.ply"};
const Words make_image = {"remesh", "@in.sph.ply",   "--grid",           "octa:5",
                          "-o",     "@octa.sph.ply", "--geometry-image", "@image.exr"};
const Words bake_it = {"bake",   "@in.sph.ply", "--map", "position",
                       "--size", "16",          "-o",    "@baked.png"};
const Words texture_it = {"export", "@in.sph.ply", "--image", "@baked.png", "-o", "@textured.glb"};

const std::map<std::string, Errand>& errands() {
  static const std::map<std::string, Errand> all = {
      {"map",
       {icosphere(1),
        {"map", "@scans/mesh.off", "-o", "@map.sph.ply", "--write-sphere", "@sphere.obj", "--json",
         "@report.json", "--threads", "1"},
        {"map.sph.ply", "sphere.obj", "report.json"},
        "map.sph.ply"}},
      {"threads",  // more vertices than one thread takes alone
       {icosphere(4),
        {"map", "@scans/mesh.off", "-o", "@map.sph.ply", "--threads", "3"},
        {"map.sph.ply"},
        "map.sph.ply"}},
      {"holes",
       {damaged_ball(),
        {"map", "@scans/mesh.off", "-o", "@map.sph.ply", "--repair", "--keep-holes", "--json",
         "@report.json", "--threads", "1"},
        {"map.sph.ply", "report.json"},
        "map.sph.ply"}},
      {"parts",
       {two_balls(),
        {"map", "@scans/mesh.off", "-o", "@map.sph.ply", "--all-components", "--json",
         "@report.json", "--threads", "1"},
        {"map_0001.sph.ply", "map_0002.sph.ply", "report.json"},
        "map_0002.sph.ply"}},
      {"survey",  // of a file that a fault meets it says so and goes on
       {damaged_ball(),
        {"survey", "@scans", "-o", "@page.html", "--records", "@found", "--size", "16", "--json",
         "@report.json", "--threads", "1"},
        {"page.html", "report.json"},
        "",
        {0, 4}}},
      {"data",  // in a file of their own and in another beside
       {icosphere(1),
        {"repair", "@scans/mesh.off", "--data", "@rh.depth", "-o", "@lh.white", "--json",
         "@report.json"},
        {"lh.white", "lh.depth", "report.json"},
        "",
        {},
        "lh.depth"}},
      {"info",
       {octahedron(), {"info", "@scans/mesh.off", "--json", "@report.json"}, {"report.json"}}},
      {"verify",
       {.mesh = octahedron(),
        .words = {"verify", "@in.sph.ply", "--json", "@report.json", "--threads", "1"},
        .outputs = {"report.json"},
        .before = {map_it}}},
      {"bake",
       {.mesh = octahedron(),
        .words = {"bake", "@in.sph.ply", "--map", "position,normal-object", "--size", "16", "-o",
                  "@baked_{map}.png", "--json", "@report.json", "--threads", "1"},
        .outputs = {"baked_position.png", "baked_normal-object.png", "report.json"},
        .before = {map_it}}},
      {"export",
       {.mesh = octahedron(),
        .words = {"export", "@in.sph.ply", "--image", "@baked.png", "-o", "@made.glb", "--json",
                  "@report.json", "--threads", "1"},
        .outputs = {"made.glb", "report.json"},
        .before = {map_it, bake_it}}},
      {"paint",
       {.mesh = octahedron(),
        .words = {"paint", "@in.sph.ply", "--image", "@baked.png", "-o", "@painted.ply"},
        .outputs = {"painted.ply"},
        .before = {map_it, bake_it}}},
      {"render",
       {.mesh = octahedron(),
        .words = {"render", "@in.sph.ply", "--size", "32", "-o", "@picture.png", "--threads", "1"},
        .outputs = {"picture.png"},
        .before = {map_it}}},
      {"report",
       {.mesh = octahedron(),
        .words = {"report", "@in.sph.ply", "-o", "@page.html", "--no-viewer", "--size", "64",
                  "--threads", "1"},
        .outputs = {"page.html"},
        .before = {map_it}}},
      {"compare",
       {.mesh = octahedron(),
        .words = {"compare", "@scans/mesh.off", "-o", "@found", "--methods",
                  "progressive,tangential", "--size", "64", "--threads", "1"}}},
      {"remesh",
       {.mesh = octahedron(),
        .words = {"remesh", "@in.sph.ply", "--grid", "octa:5", "-o", "@made.sph.ply",
                  "--geometry-image", "@made.exr", "--json", "@report.json", "--threads", "1"},
        .outputs = {"made.sph.ply", "made.exr", "report.json"},
        .map = "made.sph.ply",
        .before = {map_it}}},
      {"unimage",
       {.mesh = octahedron(),
        .words = {"unimage", "@image.exr", "-o", "@made.sph.ply"},
        .outputs = {"made.sph.ply"},
        .map = "made.sph.ply",
        .before = {map_it, make_image}}},
      {"match",
       {.mesh = octahedron(),
        .words = {"match", "@in.sph.ply", "@other.sph.ply", "-o", "@matched.ply", "--write-shape",
                  "@shape.ply", "--json", "@report.json", "--threads", "1"},
        .outputs = {"matched.ply", "shape.ply", "report.json"},
        .before = {map_it, make_another}}},
      {"group",
       {.mesh = octahedron(),
        .words = {"group", "@in.sph.ply", "@other.sph.ply", "-o", "@found", "--grid", "ico:1",
                  "--size", "0", "--threads", "1"},
        .before = {map_it, make_another}}},
      {"measure",
       {.mesh = octahedron(),
        .words = {"measure", "@scans/mesh.off", "@other.sph.ply", "--per-vertex", "@far.ply",
                  "--json", "@report.json", "--threads", "1"},
        .outputs = {"far.ply", "report.json"},
        .before = {map_it, make_another}}},
      {"spharm",
       {.mesh = octahedron(),
        .words = {"spharm", "@in.sph.ply", "--degree", "2", "--coef", "@made.coef", "--reconstruct",
                  "@made.ply", "--csv", "@made.csv", "--json", "@report.json", "--threads", "1"},
        .outputs = {"made.coef", "made.ply", "made.csv", "report.json"},
        .before = {map_it}}},
      {"wrap",
       {.mesh = damaged_ball(),
        .words = {"wrap", "@scans/mesh.off", "--resolution", "8", "-o", "@wrapped.ply", "--json",
                  "@report.json", "--threads", "1"},
        .outputs = {"wrapped.ply", "report.json"}}},
      {"asset",
       {.mesh = octahedron(),
        .words = {"asset", "@textured.glb", "-o", "@found", "--size", "16", "--threads", "1"},
        .before = {map_it, bake_it, texture_it}}},
  };
  return all;
}

/// Numbers of four vertices, to other vertices.
Errand data_errand(const std::string& extension) {
  const std::string packed = extension == ".mgz" ? "packed" : "plain";
  const std::string output = "made" + extension;
  return {.mesh = tetrahedron(),
          .words = {"remesh", "@scans/mesh.off", "--grid", "ico:0", "--data", "@given" + extension,
                    "--write-data", "@" + output, "--json", "@report.json", "--threads", "1"},
          .outputs = {output, "report.json"},
          .given = "values_ok_" + packed + extension};
}

Errand read_errand(const std::string& extension) {
  const std::string kind = extension == ".icq"   ? "icq"
                           : extension == ".tab" ? "plates"
                                                 : "freesurfer";
  return {.mesh = tetrahedron(),
          .words = {"repair", "@given" + extension, "-o", "@made.ply", "--json", "@report.json"},
          .outputs = {"made.ply", "report.json"},
          .given = kind + "_ok_plain" + extension};
}

Errand repair_errand(const std::string& extension) {
  const std::string output = "mended" + extension;
  return {damaged_ball(),
          {"repair", "@scans/mesh.off", "-o", "@" + output, "--json", "@report.json"},
          {output, "report.json"}};
}

}  // namespace

Errand errand_named(const std::string& name) {
  if (const auto found = errands().find(name); found != errands().end()) return found->second;
  const std::string kind = name.substr(0, name.find('.')), extension = name.substr(kind.size());
  if (kind == "data" && !extension.empty()) return data_errand(extension);
  if (kind == "read" && !extension.empty()) return read_errand(extension);
  if (kind == "repair" && !extension.empty()) return repair_errand(extension);
  throw std::runtime_error("no errand " + name);
}

}  // namespace sphparam::tests
