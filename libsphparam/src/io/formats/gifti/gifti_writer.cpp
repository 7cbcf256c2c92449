#include "io/formats/gifti/gifti_writer.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "io/files/file_bytes.h"
#include "io/formats/gifti/gifti_labels.h"
#include "io/formats/lossless_type.h"
#include "sphparam/io/safe_file.h"

extern "C" {  // which the header forgets
#include <gifti/gifti_io.h>
}

// libgiftiio writes files by name, so it gets the name of one in memory. Its state is global:
// one caller at a time. It owns what is hung into its image, so all of it comes from malloc.

namespace sphparam {
namespace {

struct FreeImage {
  void operator()(gifti_image* image) const { gifti_free_image(image); }
};
using Image = std::unique_ptr<gifti_image, FreeImage>;

/// A file that has a name in /proc only; where nobody mounted that, a temporary one.
class ScratchFile {
 public:
  ScratchFile() : descriptor_(::memfd_create("gifti", MFD_CLOEXEC)) {
    path_ = "/proc/self/fd/" + std::to_string(descriptor_);
    if (descriptor_ < 0 || ::access(path_.c_str(), W_OK) == 0) return;
    ::close(descriptor_);
    path_ = std::filesystem::temp_directory_path() / "sphparam-gifti-XXXXXX";
    descriptor_ = ::mkostemp(path_.data(), O_CLOEXEC);
    temporary_ = descriptor_ >= 0;
  }
  ~ScratchFile() {
    if (temporary_) ::unlink(path_.c_str());
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  bool is_there() const { return descriptor_ >= 0; }
  const std::string& path() const { return path_; }

 private:
  int descriptor_;
  std::string path_;
  bool temporary_ = false;
};

/// Text that XML can hold: other bytes become question marks, and CDATA does not end early.
std::string in_cdata(std::string text) {
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  for (std::size_t at = 0; (at = text.find("]]>", at)) != std::string::npos;) text[at + 2] = '?';
  return text;
}

void add_metadata(giiMetaData& metadata, const std::string& key, const std::string& value) {
  if (value.empty()) return;
  if (gifti_add_to_meta(&metadata, in_cdata(key).c_str(), in_cdata(value).c_str(), 1) != 0)
    throw std::bad_alloc();
}

/// Memory that libgiftiio will free.
template <class Number>
Number* zeros(std::size_t count) {
  auto* const numbers =
      static_cast<Number*>(std::calloc(std::max<std::size_t>(count, 1), sizeof(Number)));
  if (!numbers) throw std::bad_alloc();
  return numbers;
}

/// Fills one array of rows of three.
template <class Number, class Table>
void fill(giiDataArray& array, int intent, int type, const Table& table) {
  array.intent = intent;
  array.datatype = type;
  array.ind_ord = GIFTI_IND_ORD_ROW_MAJOR;
  array.num_dim = 2;
  array.dims[0] = static_cast<int>(table.rows());
  array.dims[1] = 3;
  array.encoding = GIFTI_ENCODING_B64GZ;
  array.endian = gifti_get_this_endian();
  array.nvals = table.size();
  array.nbyper = sizeof(Number);
  auto* const numbers = zeros<Number>(static_cast<std::size_t>(table.size()));
  array.data = numbers;
  std::transform(table.data(), table.data() + table.size(), numbers,
                 [](auto number) { return static_cast<Number>(number); });
}

void add_comments(gifti_image& image, const MeshFile& file) {
  giiMetaData& of_points = image.darray[0]->meta;
  for (const std::string& comment : file.comments) {
    const std::size_t first = comment.find(' ');
    const std::size_t second = comment.find(' ', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string key = comment.substr(first + 1, second - first - 1);
    const std::string value = comment.substr(second + 1);
    if (comment.starts_with("gifti ") && !label_in(comment)) add_metadata(of_points, key, value);
    if (comment.starts_with("sphparam ")) add_metadata(image.meta, "sphparam " + key, value);
  }
}

void add_labels(gifti_image& image, const MeshFile& file) {
  std::vector<GiftiLabel> labels;
  for (const std::string& comment : file.comments)
    if (std::optional<GiftiLabel> label = label_in(comment)) labels.push_back(*std::move(label));
  if (labels.empty()) return;
  giiLabelTable& table = image.labeltable;
  table.key = zeros<int>(labels.size());
  table.label = zeros<char*>(labels.size());
  const bool coloured = std::any_of(labels.begin(), labels.end(), [](const GiftiLabel& label) {
    return label.colour.has_value();
  });
  if (coloured) table.rgba = zeros<float>(4 * labels.size());
  table.length = static_cast<int>(labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    table.key[i] = labels[i].key;
    table.label[i] = ::strdup(in_cdata(labels[i].name).c_str());
    if (!table.label[i]) throw std::bad_alloc();
    if (labels[i].colour) std::copy_n(labels[i].colour->begin(), 4, table.rgba + 4 * i);
  }
}

/// The space of a sphere is its own: the identity, which the field's files have too.
void add_identity(giiDataArray& points) {
  if (gifti_add_empty_CS(&points) != 0) throw std::bad_alloc();
  giiCoordSystem& system = *points.coordsys[0];
  for (char** const space : {&system.dataspace, &system.xformspace})
    if (!(*space = ::strdup("NIFTI_XFORM_UNKNOWN"))) throw std::bad_alloc();
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) system.xform[i][k] = i == k ? 1 : 0;
}

Image build_image(const MeshFile& file, const GiftiOptions& options) {
  Image image(gifti_create_image(2, NIFTI_INTENT_NONE, NIFTI_TYPE_INT32, 0, nullptr, 0));
  if (!image) throw std::bad_alloc();
  const Points& positions = file.mesh.positions;
  giiDataArray& points = *image->darray[0];
  if (options.float32 ||
      lossless_type(ScalarType::Float32, positions.data(), positions.size()) == ScalarType::Float32)
    fill<float>(points, NIFTI_INTENT_POINTSET, NIFTI_TYPE_FLOAT32, positions);
  else
    fill<double>(points, NIFTI_INTENT_POINTSET, NIFTI_TYPE_FLOAT64, positions);
  fill<int>(*image->darray[1], NIFTI_INTENT_TRIANGLE, NIFTI_TYPE_INT32, file.mesh.triangles);

  add_metadata(points.meta, "AnatomicalStructurePrimary", "Other");
  add_metadata(image->darray[1]->meta, "TopologicalType", "Closed");
  add_comments(*image, file);
  add_labels(*image, file);
  if (options.geometric_type == "Spherical") add_identity(points);
  add_metadata(points.meta, "AnatomicalStructurePrimary", options.anatomical_structure);
  add_metadata(points.meta, "GeometricType", options.geometric_type);
  return image;
}

}  // namespace

std::string serialise_gifti(const MeshFile& file, const GiftiOptions& options) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  gifti_set_verb(0);
  gifti_set_update_ok(0);  // leave our metadata alone
  const Image image = build_image(file, options);
  const ScratchFile scratch;
  if (!scratch.is_there() || gifti_write_image(image.get(), scratch.path().c_str(), 1) != 0)
    throw WriteError("a GIFTI file", "libgiftiio could not make it in memory");
  return std::string(FileBytes(scratch.path(), ~std::uint64_t{0}).view());
}

}  // namespace sphparam
