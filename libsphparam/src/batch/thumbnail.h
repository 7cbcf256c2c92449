#pragma once

namespace sphparam {

/// Draws the first map in the current folder (*.sph.ply), the mesh and its sphere side by side in
/// the colours of area, as thumbnail.png, each `pixels` wide. 0, and where there is no map:
/// nothing. What goes wrong is told on standard error: a batch is not about its pictures.
void add_thumbnail(int pixels);

}  // namespace sphparam
