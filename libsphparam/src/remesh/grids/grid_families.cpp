// The list of all families of grids.

#include <stdexcept>

#include "remesh/grids/grid_family.h"

namespace sphparam {

namespace {

constexpr const GridFamily* families[] = {&icosahedron_family, &cut_icosahedron_family,
                                          &octahedron_family,  &cube_family,
                                          &geographic_family,  &healpix_family};

}  // namespace

std::span<const GridFamily* const> grid_families() { return families; }

const GridFamily& family_of(GridKind kind) {
  for (const GridFamily* family : families) {
    if (family->kind == kind) return *family;
  }
  throw std::invalid_argument("an unknown kind of grid");
}

ImageLayout::ImageLayout(const ImageSize& size)
    : width(size.width),
      height(size.height),
      vertex(static_cast<size_t>(size.width) * static_cast<size_t>(size.height), -1) {}

}  // namespace sphparam
