#pragma once

#include "sphparam/image/image.h"
#include "sphparam/io/mesh_file.h"

/// Meshes to try the toolkit on: closed, genus 0, z up, vertex colours red green blue (Uint8).
/// All are made by formulas from fixed seeds: the same on every run.
namespace sphparam::samples {

/// A lumpy small body with craters, star-shaped about the origin, with texture coordinates a corner
/// (v upwards) into the image of `make_body_texture`. Ensures: 20·frequency² triangles.
sphparam::MeshFile make_body(int frequency = 32);

/// What the body's surface looks like, finer than its mesh: 5 × 2 squares of `square` pixels, each
/// two neighbouring faces of the icosahedron. RGB, sRGB.
sphparam::Image make_body_texture(int square = 176);

/// A four-legged creature with a long neck, horns and a long tail; about 20,000 triangles of equal
/// size on a smooth surface.
sphparam::MeshFile make_creature();

/// A comet of two lobes, in kilometres, that is not star-shaped: the smaller lobe leans over the
/// larger, and about the neck a ray from the origin meets the surface three times.
sphparam::MeshFile make_comet();

/// A deeply folded surface like a brain's cortex, with overhangs; 40,500 triangles.
sphparam::MeshFile make_cortex();

/// Names each vertex of the cortex: property `lobe`, 1 to 8, and a label table of what the numbers
/// stand for, four lobes of two halves, as comments that GIFTI files keep as theirs.
void add_lobes(sphparam::MeshFile& cortex);

}  // namespace sphparam::samples
