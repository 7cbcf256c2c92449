#include "io/formats/gifti/gifti_image.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "io/files/file_bytes.h"
#include "sphparam/io/safe_file.h"

// libgiftiio writes files by name, so it gets the name of one in memory.

namespace sphparam {
namespace {

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

/// How many bytes the character at the start takes, in UTF-8 and as XML 1.0 allows; 0: it is none.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return first >= ' ' || first == '\n' || first == '\t' ? 1 : 0;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  unsigned code = first & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3fU);
  }
  constexpr unsigned least[] = {0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
  const bool is_one = code >= least[length - 2] && code <= 0x10ffff && !is_surrogate;
  return is_one && code != 0xfffe && code != 0xffff ? length : 0;
}

/// Text that XML can hold: other bytes become question marks, and CDATA does not end early.
std::string in_cdata(std::string text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = character_length(std::string_view(text).substr(at));
    if (length == 0) text[at] = '?';
    at += std::max<std::size_t>(length, 1);
  }
  for (std::size_t at = 0; (at = text.find("]]>", at)) != std::string::npos;) text[at + 2] = '?';
  return text;
}

std::mutex& one_at_a_time() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

GiftiTurn::GiftiTurn() : lock_(one_at_a_time()) {
  gifti_set_verb(0);
  gifti_set_update_ok(0);  // leave our metadata alone
}

GiftiImage make_gifti_image(int count) {
  GiftiImage image(gifti_create_image(count, NIFTI_INTENT_NONE, NIFTI_TYPE_INT32, 0, nullptr, 0));
  if (!image) throw std::bad_alloc();
  return image;
}

void add_gifti_metadata(giiMetaData& metadata, const std::string& key, const std::string& value) {
  if (value.empty()) return;
  if (gifti_add_to_meta(&metadata, in_cdata(key).c_str(), in_cdata(value).c_str(), 1) != 0)
    throw std::bad_alloc();
}

void add_gifti_labels(gifti_image& image, std::span<const Label> labels) {
  if (labels.empty()) return;
  giiLabelTable& table = image.labeltable;
  table.key = gifti_zeros<int>(labels.size());
  table.label = gifti_zeros<char*>(labels.size());
  const bool coloured =
      std::ranges::any_of(labels, [](const Label& label) { return label.colour.has_value(); });
  if (coloured) table.rgba = gifti_zeros<float>(4 * labels.size());
  table.length = static_cast<int>(labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    table.key[i] = labels[i].key;
    table.label[i] = ::strdup(in_cdata(labels[i].name).c_str());
    if (!table.label[i]) throw std::bad_alloc();
    if (labels[i].colour) std::copy_n(labels[i].colour->begin(), 4, table.rgba + 4 * i);
  }
}

std::string gifti_bytes(const gifti_image& image) {
  const ScratchFile scratch;
  // The library takes it as one that it may change, and does not.
  if (!scratch.is_there() ||
      gifti_write_image(const_cast<gifti_image*>(&image), scratch.path().c_str(), 1) != 0)
    throw WriteError("a GIFTI file", "libgiftiio could not make it in memory");
  return std::string(FileBytes(scratch.path(), ~std::uint64_t{0}).view());
}

}  // namespace sphparam
