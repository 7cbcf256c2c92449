#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "io/formats/gltf/gltf_document.h"
#include "sphparam/io/scalar_type.h"

namespace sphparam {

/// The type behind glTF's code of a component; nothing for codes that it does not have.
std::optional<ScalarType> type_of_component(int code);

/// The numbers behind the accessors of a glTF file. Everything is checked before it is read:
/// component types, strides, byte ranges, sparse indices (strictly increasing).
/// Every failure is a ReadError that names the accessor. Numbers that are not aligned as glTF wants
/// them are read all the same, and counted.
class GltfAccessors {
 public:
  /// Requires: both arguments outlive it.
  GltfAccessors(const GltfDocument& document, const std::string& name);

  /// count × components numbers, row by row; normalised integers are divided. Read once, then kept.
  /// All of them finite, or a ReadError.
  const std::vector<double>& numbers(int accessor);
  /// The same as they are, not finite ones among them.
  const std::vector<double>& any_numbers(int accessor);

  /// Indices of vertices, each < `vertex_count`.
  std::vector<std::uint32_t> indices(int accessor, std::uint64_t vertex_count);

  /// Throws: ReadError when there is no such accessor.
  const GltfDocument::Accessor& accessor(int accessor) const;

  /// The type of its components; Float32 when normalised. Throws: ReadError for types that glTF
  /// does not have.
  ScalarType type(int accessor) const;

  /// Accessors read so far whose numbers are not aligned.
  long misaligned() const { return static_cast<long>(misaligned_.size()); }

  /// Throws: ReadError unless each element has one of these numbers of components; `where`: what
  /// uses the accessor.
  void require_components(int accessor, std::initializer_list<int> allowed,
                          const std::string& where) const;

  [[noreturn]] void fail(int accessor, const std::string& message) const;

  /// Bytes of all buffers: what a file may ask for is measured by them.
  std::uint64_t buffer_bytes() const { return buffer_bytes_; }

 private:
  struct Range {
    const unsigned char* data;
    std::uint64_t stride;
  };
  Range range(int accessor, int view, std::uint64_t offset, std::uint64_t count,
              std::size_t element_bytes, std::size_t component_bytes, bool may_have_stride);
  ScalarType component_type(int accessor, int code) const;
  std::vector<double> read(int accessor);
  void apply_sparse(int accessor, std::vector<double>& numbers);
  void spend(int accessor, std::uint64_t numbers);

  const GltfDocument& document_;
  const std::string& name_;
  std::map<int, std::vector<double>> kept_;
  std::uint64_t buffer_bytes_ = 0;
  std::uint64_t numbers_read_ = 0;
  std::set<int> misaligned_;
};

}  // namespace sphparam
