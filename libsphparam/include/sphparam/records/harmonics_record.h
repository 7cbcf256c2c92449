#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sphparam/io/harmonic_expansion.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/sphere_file.h"

namespace sphparam {

/// All coefficients and residuals, as `sphparam spharm --json` tells them. `mesh`: its file; `map`:
/// the provenance of the map that was used. Of an expansion without residuals nothing is told of
/// the fit.
std::string to_json(const HarmonicExpansion& expansion, const std::string& mesh,
                    const Provenance& map);

/// The coefficients that a file of `to_json` has, or one of SPHARM-PDM (.coef, of x, y, z), by its
/// name: `functions` and `fit.coefficients`; of the former also `map`, `normalisation`, `aligned`
/// and `radius_about`. Nothing else is known: residuals and values are empty. Throws: ReadError;
/// for names of functions, too, that are not x, y, z and then others, each once.
HarmonicExpansion read_harmonics(const std::string& path);
/// The same from text in memory; `name` is for messages, and tells which of both it is.
HarmonicExpansion parse_harmonics(std::string_view text, const std::string& name);

/// One line a coefficient: l, m, then one number a function; a header line first, commas (or tabs)
/// between. Numbers come back exactly. Names end with " (4pi)" where coefficients are
/// 4π-normalised.
std::string to_csv(const HarmonicExpansion& expansion, char separator = ',');

/// The coefficients of a function as a table of spherical harmonics in ASCII (SHADR of the PDS),
/// always 4π-normalised: a header of reference radius, GM and its uncertainty (0), degree, order,
/// normalisation state (1), reference longitude and latitude (0); then a line a pair l, m ≥ 0: C, S
/// and their uncertainties (0), in the function's unit. The reference radius is C_00. Lines end
/// with CR and LF. Requires: a function that was expanded. Throws: std::invalid_argument if not.
std::string to_shadr(const HarmonicExpansion& expansion, const std::string& function = "radius");

/// For people: "degree 20, RMS distance at the vertices, weighted by solid angle, 0.12 (0.01 % of
/// the diagonal), unweighted 0.13".
std::string residual_line(const HarmonicExpansion& expansion);

/// For people: up to which degree the vertices decide the coefficients, where they do not decide
/// all; else empty.
std::string undecided_line(const HarmonicExpansion& expansion);

/// That one vertex or more stand for 1 % of the sphere and for 20 times what is usual of vertices,
/// as on the rim of a gap: a fit follows what these carry; else empty. Cost: O(#V).
std::string heavy_vertices_line(const MappedMesh& mapped);

/// That coefficients of degrees that vertices do decide are other ones than a fit of these degrees
/// alone has, by 0.1 % of a degree's size or more; else empty.
std::string decided_change_line(const HarmonicExpansion& expansion);

/// For people: the first-order ellipsoid, and what is left of each scalar; a line each.
std::vector<std::string> further_lines(const HarmonicExpansion& expansion);

}  // namespace sphparam
