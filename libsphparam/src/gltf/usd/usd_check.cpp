#include "gltf/usd/usd_check.h"

#include <charconv>
#include <limits>
#include <stdexcept>

#include "gltf/usd/usd_head.h"
#include "io/files/zip_archive.h"

// By its own way of reading: numbers one after the other, whatever stands between them.

namespace sphparam {

namespace {

/// The numbers of an array.
template <class Number>
class ArrayNumbers {
 public:
  ArrayNumbers(std::string_view layer, const std::string& declaration) {
    const std::size_t at = layer.find("\n        " + declaration + " = [");
    if (at == std::string_view::npos) return;
    left_ = layer.substr(at + declaration.size() + 13);
    left_ = left_.substr(0, left_.find(']'));
  }

  /// False where there is no other.
  bool next(Number& number) {
    left_.remove_prefix(std::min(left_.find_first_not_of(" ,()"), left_.size()));
    const char* end = left_.data() + left_.size();
    const auto [stop, error] = std::from_chars(left_.data(), end, number);
    if (error != std::errc()) return false;
    left_.remove_prefix(static_cast<std::size_t>(stop - left_.data()));
    return true;
  }
  bool is(Number wanted) {
    Number number{};
    return next(number) && number == wanted;
  }
  bool at_end() {
    Number number{};
    return !next(number);
  }

 private:
  std::string_view left_;
};

bool holds_rows(std::string_view layer, const char* declaration, const FloatRows& rows) {
  ArrayNumbers<float> read(layer, declaration);
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    for (Eigen::Index k = 0; k < rows.cols(); ++k)
      if (!read.is(rows(i, k))) return false;
  return read.at_end();
}

bool holds_numbers(std::string_view layer, const char* declaration,
                   const std::vector<std::uint32_t>& numbers) {
  ArrayNumbers<std::uint32_t> read(layer, declaration);
  for (const std::uint32_t number : numbers)
    if (!read.is(number)) return false;
  return read.at_end();
}

void check_layer(std::string_view layer, const std::string& name, const UsdArrays& arrays) {
  const char* differs = nullptr;
  if (!holds_rows(layer, "point3f[] points", arrays.points)) differs = "positions";
  if (!holds_numbers(layer, "int[] faceVertexIndices", arrays.indices) ||
      !holds_numbers(layer, "int[] faceVertexCounts", arrays.counts))
    differs = "faces";
  if (!holds_rows(layer, "texCoord2f[] primvars:st", arrays.st)) differs = "texture coordinates";
  if (differs) throw std::runtime_error(name + ", read back: " + differs + " differ");
}

}  // namespace

void check_written_usd(std::string_view bytes, const std::string& name, const UsdArrays& arrays) {
  if (!looks_like_zip(bytes)) return check_layer(bytes, name, arrays);
  const std::string layer =
      ZipArchive(bytes, name).unpacked(usdz_layer, std::numeric_limits<std::uint32_t>::max());
  check_layer(layer, name, arrays);
}

void check_written_usd(std::string_view bytes, const std::string& name, const Asset& asset) {
  const Surface& mesh = asset.levels.front();
  UsdArrays arrays{
      mesh.positions, std::vector<std::uint32_t>(mesh.indices.size() / 3, 3), mesh.indices, {}};
  if (!mesh.texcoords.empty()) arrays.st = upward(mesh.texcoords.front());
  check_written_usd(bytes, name, arrays);
}

}  // namespace sphparam
