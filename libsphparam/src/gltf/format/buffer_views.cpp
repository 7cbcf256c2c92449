#include "gltf/format/buffer_views.h"

#include "gltf/meshopt_encoding.h"

namespace sphparam {
namespace {

constexpr std::size_t alignment = 4;

std::size_t aligned(std::size_t size) { return (size + alignment - 1) / alignment * alignment; }

}  // namespace

void BufferBytes::align() { bytes_.resize(aligned(bytes_.size()), '\0'); }

PlacedView BufferBytes::place(const std::string& bytes) {
  align();
  const PlacedView view{bytes_.size(), bytes.size()};
  bytes_ += bytes;
  return view;
}

PlacedView BufferBytes::place(const PackedRows& rows, ViewUse use) {
  if (!compress_ || use == ViewUse::Other) return place(rows.bytes);
  PlacedView view =
      place(use == ViewUse::Vertices ? encode_vertices(rows.bytes, rows.count, rows.stride)
                                     : encode_triangles(rows.bytes, rows.count, rows.stride));
  view.compressed = true;
  view.raw_offset = aligned(raw_size_);
  view.raw_length = rows.bytes.size();
  raw_size_ = view.raw_offset + view.raw_length;
  return view;
}

}  // namespace sphparam
