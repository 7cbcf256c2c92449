#include <catch2/catch.hpp>
#include <cstddef>
#include <type_traits>

#include "sphparam/gltf/asset.h"

namespace sphparam::tests {

namespace {

/// Made on one side and freed on the other, whatever either was compiled for.
template <class Table>
constexpr bool comes_from_malloc = (int{Table::Options} & int{Eigen::DontAlign}) != 0;

static_assert(comes_from_malloc<FloatRows>);
static_assert(comes_from_malloc<std::decay_t<decltype(Surface::positions)>>);
static_assert(comes_from_malloc<std::decay_t<decltype(MorphTarget::tangents)>>);
static_assert(comes_from_malloc<std::decay_t<decltype(CustomAttribute::values)>>);
static_assert(comes_from_malloc<decltype(Surface::texcoords)::value_type>);

// No member of fixed size asks for wider places than the ABI of all x86-64 has.
static_assert(alignof(Asset) <= alignof(std::max_align_t));
static_assert(alignof(Surface) <= alignof(std::max_align_t));

}  // namespace

TEST_CASE("asset: its buffers come from malloc, so that programs may be compiled for AVX") {
  FloatRows rows = FloatRows::Zero(5, 3);
  const void* const before = rows.data();
  Surface surface;
  surface.positions = std::move(rows);
  CHECK(surface.positions.data() == before);
  CHECK(surface.vertex_count() == 5);
}

}  // namespace sphparam::tests
