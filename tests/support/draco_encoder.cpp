#include "support/draco_encoder.h"

#include <stdexcept>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Woverloaded-virtual"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <draco/compression/expert_encode.h>
#pragma GCC diagnostic pop

namespace sphparam::tests {
namespace {

void add_positions(const std::vector<float>& positions, draco::Mesh& mesh) {
  const auto count = static_cast<std::uint32_t>(positions.size() / 3);
  mesh.set_num_points(count);
  draco::GeometryAttribute description;
  description.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false,
                   3 * sizeof(float), 0);
  const int id = mesh.AddAttribute(description, true, count);
  for (std::uint32_t v = 0; v < count; ++v)
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(v), positions.data() + 3 * v);
}

void add_faces(const std::vector<int>& corners, draco::Mesh& mesh) {
  const auto corner = [&](std::size_t i) {
    return draco::PointIndex(static_cast<std::uint32_t>(corners[i]));
  };
  for (std::size_t i = 0; i < corners.size(); i += 3)
    mesh.AddFace({corner(i), corner(i + 1), corner(i + 2)});
}

}  // namespace

std::string encode_by_draco(const std::vector<float>& positions, const std::vector<int>& corners,
                            bool edge_breaker) {
  draco::Mesh mesh;
  add_positions(positions, mesh);
  add_faces(corners, mesh);
  draco::ExpertEncoder encoder(mesh);
  encoder.SetEncodingMethod(edge_breaker ? draco::MESH_EDGEBREAKER_ENCODING
                                         : draco::MESH_SEQUENTIAL_ENCODING);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeToBuffer(&buffer).ok()) throw std::runtime_error("Draco does not encode it");
  return {buffer.data(), buffer.size()};
}

}  // namespace sphparam::tests
