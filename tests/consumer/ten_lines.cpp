// The ten lines of README: a mesh file becomes textures, a coarser mesh, an asset, and a figure.

#include <sphparam/bake/bake.h>
#include <sphparam/gltf/export.h>
#include <sphparam/io/mapped_mesh.h>
#include <sphparam/measure/surface_distance.h>
#include <sphparam/remesh/remesh.h>

#include <iostream>

int main() {
  const auto statue = sphparam::load_mapped("statue.obj");  // reads, maps, certifies
  sphparam::bake(statue, {{"normal-object", "n.png"}, {"ao", "ao.exr"}});
  const auto low = sphparam::remesh(statue, sphparam::parse_grid("ico:6"));
  sphparam::save_mapped("low.sph.ply", low);
  sphparam::write_asset("low.glb", sphparam::make_asset(low));
  std::cout << sphparam::measure_distance(statue.mesh(), low.mesh()).rms() << "\n";
}
