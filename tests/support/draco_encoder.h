#pragma once

#include <string>
#include <vector>

namespace sphparam::tests {

/// Triangles by Draco's own encoder, with no quantisation: the numbers are as they were. Attribute
/// 0 holds the positions. It is in a library of its own, whose symbols nobody else sees: the
/// encoder comes with another tinygltf than ours.
__attribute__((visibility("default"))) std::string encode_by_draco(
    const std::vector<float>& positions, const std::vector<int>& corners, bool edge_breaker);

}  // namespace sphparam::tests
