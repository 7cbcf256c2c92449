#include "gltf/usd/usd_check.h"

#include <charconv>
#include <limits>
#include <stdexcept>

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

bool holds_points(std::string_view layer, const FloatRows& points) {
  ArrayNumbers<float> read(layer, "point3f[] points");
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    for (int k = 0; k < 3; ++k)
      if (!read.is(points(i, k))) return false;
  return read.at_end();
}

bool holds_triangles(std::string_view layer, const std::vector<std::uint32_t>& indices) {
  ArrayNumbers<std::uint32_t> read(layer, "int[] faceVertexIndices");
  ArrayNumbers<int> counts(layer, "int[] faceVertexCounts");
  for (std::size_t i = 0; i < indices.size(); ++i)
    if (!read.is(indices[i]) || (i % 3 == 0 && !counts.is(3))) return false;
  return read.at_end() && counts.at_end();
}

bool holds_uv(std::string_view layer, const FloatRows& uv) {
  ArrayNumbers<float> read(layer, "texCoord2f[] primvars:st");
  for (Eigen::Index i = 0; i < uv.rows(); ++i)
    if (!read.is(uv(i, 0)) || !read.is(1 - uv(i, 1))) return false;
  return read.at_end();
}

void check_layer(std::string_view layer, const std::string& name, const Surface& mesh) {
  const char* differs = nullptr;
  if (!holds_points(layer, mesh.positions)) differs = "positions";
  if (!holds_triangles(layer, mesh.indices)) differs = "triangles";
  if (!mesh.texcoords.empty() && !holds_uv(layer, mesh.texcoords.front()))
    differs = "texture coordinates";
  if (differs) throw std::runtime_error(name + ", read back: " + differs + " differ");
}

}  // namespace

void check_written_usd(std::string_view bytes, const std::string& name, const Asset& asset) {
  const Surface& mesh = asset.levels.front();
  if (!looks_like_zip(bytes)) return check_layer(bytes, name, mesh);
  const std::string layer =
      ZipArchive(bytes, name).unpacked(usdz_layer, std::numeric_limits<std::uint32_t>::max());
  check_layer(layer, name, mesh);
}

}  // namespace sphparam
