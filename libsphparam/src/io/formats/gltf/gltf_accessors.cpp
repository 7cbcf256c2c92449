#include "io/formats/gltf/gltf_accessors.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

// Ranges in the form that cannot overflow: offset ≤ length, then element ≤ length − offset, then
// count − 1 ≤ (length − offset − element) / stride. Accessors may overlap and share bytes, so what
// one file may make us decode is bounded by a multiple of its bytes.

namespace sphparam {
namespace {

constexpr std::uint64_t most_numbers_per_byte = 4;

/// A little-endian number at any address.
double number_at(const unsigned char* at, ScalarType type) {
  return with_scalar(type, [at](auto scalar) {
    unsigned char bytes[sizeof scalar];
    std::memcpy(bytes, at, sizeof scalar);
    if constexpr (std::endian::native != std::endian::little)
      std::reverse(bytes, bytes + sizeof scalar);
    std::memcpy(&scalar, bytes, sizeof scalar);
    return static_cast<double>(scalar);
  });
}

/// The largest number of an integer type, by which normalised ones are divided.
double largest(ScalarType type) {
  return with_scalar(type, [](auto scalar) {
    return static_cast<double>(std::numeric_limits<decltype(scalar)>::max());
  });
}

}  // namespace

std::optional<ScalarType> type_of_component(int code) {
  switch (code) {
    case 5120:
      return ScalarType::Int8;
    case 5121:
      return ScalarType::Uint8;
    case 5122:
      return ScalarType::Int16;
    case 5123:
      return ScalarType::Uint16;
    case 5125:
      return ScalarType::Uint32;
    case 5126:
      return ScalarType::Float32;
    default:
      return std::nullopt;
  }
}

GltfAccessors::GltfAccessors(const GltfDocument& document, const std::string& name)
    : document_(document), name_(name) {
  for (const auto& buffer : document.buffers) buffer_bytes_ += buffer.size();
}

void GltfAccessors::require_components(int accessor, std::initializer_list<int> allowed,
                                       const std::string& where) const {
  const int components = this->accessor(accessor).components;
  if (std::find(allowed.begin(), allowed.end(), components) == allowed.end())
    fail(accessor, where + " needs another number of components");
}

void GltfAccessors::fail(int accessor, const std::string& message) const {
  throw ReadError(name_, "accessor " + std::to_string(accessor) + ": " + message);
}

const GltfDocument::Accessor& GltfAccessors::accessor(int accessor) const {
  if (accessor < 0 || accessor >= static_cast<int>(document_.accessors.size()))
    fail(accessor, "there are " + std::to_string(document_.accessors.size()));
  return document_.accessors[static_cast<std::size_t>(accessor)];
}

ScalarType GltfAccessors::component_type(int accessor, int code) const {
  const std::optional<ScalarType> type = type_of_component(code);
  if (!type) fail(accessor, "glTF has no component type " + std::to_string(code));
  return *type;
}

ScalarType GltfAccessors::type(int id) const {
  const GltfDocument::Accessor& described = accessor(id);
  const ScalarType type = component_type(id, described.component_type);
  return described.normalised ? ScalarType::Float32 : type;
}

GltfAccessors::Range GltfAccessors::range(int accessor, int view_id, std::uint64_t offset,
                                          std::uint64_t count, std::size_t element_bytes,
                                          std::size_t component_bytes, bool may_have_stride) {
  const auto check = [&](bool good, const char* message) {
    if (!good) fail(accessor, message);
  };
  check(view_id >= 0 && view_id < static_cast<int>(document_.views.size()), "no such buffer view");
  const GltfDocument::View& view = document_.views[static_cast<std::size_t>(view_id)];
  check(view.buffer >= 0 && view.buffer < static_cast<int>(document_.buffers.size()),
        "its view names a buffer that is not there");
  const auto& buffer = document_.buffers[static_cast<std::size_t>(view.buffer)];
  check(view.offset <= buffer.size() && view.length <= buffer.size() - view.offset,
        "its view runs past the end of the buffer");
  check(view.stride == 0 || may_have_stride, "its view has a stride, which it may not have");
  const std::uint64_t stride = view.stride == 0 ? element_bytes : view.stride;
  check(stride >= element_bytes, "the stride of its view is wrong");
  const bool fits = offset <= view.length && element_bytes <= view.length - offset &&
                    count - 1 <= (view.length - offset - element_bytes) / stride;
  check(fits, "its elements do not fit into the buffer view");
  // Numbers are copied byte by byte, so nothing but the rule is broken.
  if ((view.offset + offset) % component_bytes != 0 || stride % component_bytes != 0)
    misaligned_.insert(accessor);
  return {buffer.data() + view.offset + offset, stride};
}

void GltfAccessors::spend(int accessor, std::uint64_t numbers) {
  const std::uint64_t most = most_numbers_per_byte * buffer_bytes_;
  if (numbers > most || numbers_read_ > most - numbers)
    fail(accessor, "the accessors ask for more numbers than the buffers can hold");
  numbers_read_ += numbers;
}

std::vector<double> GltfAccessors::read(int id) {
  const GltfDocument::Accessor& described = accessor(id);
  const ScalarType type = component_type(id, described.component_type);
  if (described.components == 0) fail(id, "is of matrices");
  if (described.count == 0) fail(id, "has no elements");
  if (described.count > std::numeric_limits<std::int32_t>::max()) fail(id, "has too many elements");
  const auto components = static_cast<std::uint64_t>(described.components);
  spend(id, described.count * components);

  std::vector<double> numbers(described.count * components);
  if (described.view < 0 && !described.sparse) fail(id, "has no data");
  if (described.view >= 0) {
    const std::size_t size = size_in_bytes(type);
    const Range bytes =
        range(id, described.view, described.offset, described.count, components * size, size, true);
    for (std::uint64_t i = 0; i < described.count; ++i)
      for (std::uint64_t k = 0; k < components; ++k)
        numbers[i * components + k] = number_at(bytes.data + i * bytes.stride + k * size, type);
  }
  if (described.sparse) apply_sparse(id, numbers);
  if (described.normalised) {
    if (type == ScalarType::Float32 || type == ScalarType::Uint32)
      fail(id, "may not be normalised: its components are no small integers");
    for (double& number : numbers) number = std::max(number / largest(type), -1.0);
  }
  return numbers;
}

void GltfAccessors::apply_sparse(int id, std::vector<double>& numbers) {
  const GltfDocument::Accessor& described = accessor(id);
  const GltfDocument::Sparse& sparse = *described.sparse;
  const ScalarType index_type = component_type(id, sparse.index_type);
  const bool is_unsigned = index_type == ScalarType::Uint8 || index_type == ScalarType::Uint16 ||
                           index_type == ScalarType::Uint32;
  if (!is_unsigned) fail(id, "its sparse indices are no unsigned integers");
  if (sparse.count < 1 || static_cast<std::uint64_t>(sparse.count) > described.count)
    fail(id, "the number of its sparse elements is wrong");
  if (sparse.index_offset < 0 || sparse.value_offset < 0) fail(id, "a sparse offset is negative");

  const auto count = static_cast<std::uint64_t>(sparse.count);
  const auto components = static_cast<std::uint64_t>(described.components);
  const ScalarType type = component_type(id, described.component_type);
  const std::size_t index_size = size_in_bytes(index_type), size = size_in_bytes(type);
  const Range indices =
      range(id, sparse.index_view, static_cast<std::uint64_t>(sparse.index_offset), count,
            index_size, index_size, false);
  const Range values = range(id, sparse.value_view, static_cast<std::uint64_t>(sparse.value_offset),
                             count, components * size, size, false);
  double previous = -1;
  for (std::uint64_t i = 0; i < count; ++i) {
    const double index = number_at(indices.data + i * indices.stride, index_type);
    if (!(index > previous)) fail(id, "its sparse indices do not increase");
    if (index >= static_cast<double>(described.count)) fail(id, "a sparse index is out of range");
    previous = index;
    for (std::uint64_t k = 0; k < components; ++k)
      numbers[static_cast<std::uint64_t>(index) * components + k] =
          number_at(values.data + i * values.stride + k * size, type);
  }
}

const std::vector<double>& GltfAccessors::numbers(int id) {
  const std::vector<double>& all = any_numbers(id);
  const auto components = static_cast<std::size_t>(accessor(id).components);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!std::isfinite(all[i]))
      fail(id, "element " + std::to_string(i / components) + " is no finite number");
  return all;
}

const std::vector<double>& GltfAccessors::any_numbers(int accessor) {
  const auto found = kept_.find(accessor);
  if (found != kept_.end()) return found->second;
  return kept_.emplace(accessor, read(accessor)).first->second;
}

std::vector<std::uint32_t> GltfAccessors::indices(int id, std::uint64_t vertex_count) {
  const GltfDocument::Accessor& described = accessor(id);
  const ScalarType type = component_type(id, described.component_type);
  const bool is_unsigned =
      type == ScalarType::Uint8 || type == ScalarType::Uint16 || type == ScalarType::Uint32;
  if (described.components != 1 || !is_unsigned || described.normalised)
    fail(id, "holds indices but no single unsigned integers");
  const std::vector<double>& written = numbers(id);
  std::vector<std::uint32_t> indices;
  indices.reserve(written.size());
  for (const double index : written) {
    if (index >= static_cast<double>(vertex_count))
      fail(id, "index " + std::to_string(indices.size()) + " names vertex " +
                   std::to_string(static_cast<std::uint64_t>(index)) + " of " +
                   std::to_string(vertex_count));
    indices.push_back(static_cast<std::uint32_t>(index));
  }
  return indices;
}

}  // namespace sphparam
