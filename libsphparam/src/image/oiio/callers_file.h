#pragma once

#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "image/oiio/png_texts.h"
#include "image/oiio_module.h"

namespace sphparam {

/// A file of the caller's, as OpenImageIO writes it or reads it.
class CallersFile : public OIIO::Filesystem::IOProxy {
 public:
  explicit CallersFile(const SphparamBytesAt& written) : IOProxy("", Write), written_(written) {}
  CallersFile(const SphparamBytesFrom& read, size_t size)
      : IOProxy("", Read), read_(read), size_(size) {}

  const char* proxytype() const override { return "callers_file"; }
  size_t write(const void* bytes, size_t size) override {
    if (png_texts_.empty() || m_pos + static_cast<int64_t>(size) < png_head_size)
      return advanced(pwrite(bytes, size, m_pos));
    const auto head = static_cast<size_t>(png_head_size - m_pos);
    const std::string texts = std::exchange(png_texts_, {});
    const auto* const first = static_cast<const char*>(bytes);
    const bool written =
        write(first, head) == head && write(texts.data(), texts.size()) == texts.size();
    return written ? head + write(first + head, size - head) : 0;
  }
  /// Chunks that go behind the head of a PNG, whose encoder does not know of them.
  void add_png_texts(std::string chunks) { png_texts_ = std::move(chunks); }
  size_t pwrite(const void* bytes, size_t size, int64_t offset) override {
    if (written_.write(written_.context, offset, bytes, size) != 0) return 0;
    size_ = std::max(size_, static_cast<size_t>(offset) + size);
    return size;
  }
  size_t read(void* bytes, size_t size) override { return advanced(pread(bytes, size, m_pos)); }
  size_t pread(void* bytes, size_t size, int64_t offset) override {
    return read_.read(read_.context, offset, bytes, size);
  }
  bool seek(int64_t offset) override {
    m_pos = offset;
    return true;
  }
  size_t size() const override { return size_; }

 private:
  size_t advanced(size_t count) {
    m_pos += static_cast<int64_t>(count);
    return count;
  }

  SphparamBytesAt written_ = {};
  SphparamBytesFrom read_ = {};
  size_t size_ = 0;
  std::string png_texts_;
};

}  // namespace sphparam
