#include "io/formats/gifti/gifti_writer.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "io/formats/float32_points.h"
#include "io/formats/freesurfer_comments.h"
#include "io/formats/gifti/gifti_image.h"
#include "io/formats/gifti/gifti_labels.h"
#include "io/formats/lossless_type.h"
#include "io/formats/volume_geometry.h"

namespace sphparam {
namespace {

template <class Table>
std::span<const typename Table::Scalar> numbers_of(const Table& table) {
  return {table.data(), static_cast<std::size_t>(table.size())};
}

void add_comments(gifti_image& image, const MeshFile& file) {
  giiMetaData& of_points = image.darray[0]->meta;
  for (const std::string& comment : file.comments) {
    const std::size_t first = comment.find(' ');
    const std::size_t second = comment.find(' ', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string key = comment.substr(first + 1, second - first - 1);
    const std::string value = comment.substr(second + 1);
    if (comment.starts_with("gifti ") && !label_in(comment))
      add_gifti_metadata(of_points, key, value);
    if (comment.starts_with("sphparam ")) add_gifti_metadata(image.meta, "sphparam " + key, value);
  }
}

std::vector<Label> labels_of(const MeshFile& file) {
  std::vector<Label> labels;
  for (const std::string& comment : file.comments)
    if (std::optional<Label> label = label_in(comment)) labels.push_back(*std::move(label));
  return labels;
}

/// That the coordinates are of this space.
void add_space(giiDataArray& points, const char* name) {
  if (gifti_add_empty_CS(&points) != 0) throw std::bad_alloc();
  giiCoordSystem& system = *points.coordsys[0];
  for (char** const space : {&system.dataspace, &system.xformspace})
    if (!(*space = ::strdup(name))) throw std::bad_alloc();
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) system.xform[i][k] = i == k ? 1 : 0;
}

/// The space of a sphere is its own: the identity, which the field's files have too. Surfaces
/// say which volume they are of, and whether they are in the space of the scanner.
void add_spaces(giiDataArray& points, const MeshFile& file, bool is_sphere) {
  if (is_sphere) return add_space(points, "NIFTI_XFORM_UNKNOWN");
  const Metadata geometry = gifti_geometry(file.comments);
  for (const auto& [key, value] : geometry) add_gifti_metadata(points.meta, key, value);
  const bool is_scanner = std::ranges::find(file.comments, std::string(freesurfer_real_ras) +
                                                               "1") != file.comments.end();
  if (is_scanner) add_space(points, "NIFTI_XFORM_SCANNER_ANAT");
}

/// Numbers that float32 holds as they are need no room for their rounding.
void require_rounded(const Points& positions) {
  const ScalarType held = lossless_type(ScalarType::Float32, positions.data(), positions.size());
  if (held != ScalarType::Float32) require_float32(positions, "GIFTI");
}

GiftiImage build_image(const MeshFile& file, const GiftiOptions& options) {
  GiftiImage image = make_gifti_image(2);
  const Points& positions = file.mesh.positions;
  giiDataArray& points = *image->darray[0];
  require_rounded(positions);
  fill_gifti<float>(points, NIFTI_INTENT_POINTSET, NIFTI_TYPE_FLOAT32, numbers_of(positions), 3);
  fill_gifti<int>(*image->darray[1], NIFTI_INTENT_TRIANGLE, NIFTI_TYPE_INT32,
                  numbers_of(file.mesh.triangles), 3);

  add_gifti_metadata(points.meta, "AnatomicalStructurePrimary", "Other");
  add_gifti_metadata(image->darray[1]->meta, "TopologicalType", "Closed");
  add_comments(*image, file);
  add_gifti_labels(*image, labels_of(file));
  add_spaces(points, file, options.geometric_type == "Spherical");
  add_gifti_metadata(points.meta, "AnatomicalStructurePrimary", options.anatomical_structure);
  add_gifti_metadata(points.meta, "AnatomicalStructureSecondary", options.secondary_structure);
  add_gifti_metadata(points.meta, "GeometricType", options.geometric_type);
  return image;
}

}  // namespace

std::string serialise_gifti(const MeshFile& file, const GiftiOptions& options) {
  const GiftiTurn turn;
  return gifti_bytes(*build_image(file, options));
}

}  // namespace sphparam
