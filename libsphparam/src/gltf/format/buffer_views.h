#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sphparam {

/// Numbers of glTF 2.0.
enum class ComponentType {
  Int8 = 5120,
  Int16 = 5122,
  Uint16 = 5123,
  Uint32 = 5125,
  Float32 = 5126
};

enum class ViewUse { Vertices, Indices, Other };

/// Numbers packed for one accessor with a view of its own.
struct PackedRows {
  ComponentType type = ComponentType::Float32;
  int components = 1;
  std::size_t count = 0;
  std::size_t stride = 0;  // bytes from row to row, a multiple of 4 for vertices
  bool normalised = false;
  bool octahedral = false;  // the bytes are for that filter, and only for compressed views
  std::vector<double> least, greatest;  // empty: not stored
  std::string bytes;
};

/// Where a view's bytes came to lie.
struct PlacedView {
  std::size_t offset = 0, length = 0;
  std::size_t raw_offset = 0,
              raw_length = 0;  // before compression, in the buffer that is not there
  bool compressed = false;
};

/// The one buffer of a glTF file while it grows; every view begins at a multiple of four bytes.
class BufferBytes {
 public:
  /// Compresses vertices and indices by meshoptimizer where asked to.
  explicit BufferBytes(bool compress) : compress_(compress) {}

  PlacedView place(const PackedRows& rows, ViewUse use);
  PlacedView place(const std::string& bytes);

  std::size_t raw_size() const { return raw_size_; }
  const std::string& bytes() const { return bytes_; }
  std::string take() { return std::move(bytes_); }

 private:
  void align();

  bool compress_;
  std::size_t raw_size_ = 0;
  std::string bytes_;
};

}  // namespace sphparam
