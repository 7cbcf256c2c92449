#include "io/files/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <new>

#include "sphparam/io/read_options.h"

// zlib checks the length and the CRC of each member. Members follow one another, as gunzip takes
// them; what follows them and is no member is left, as gunzip leaves it.

namespace sphparam {
namespace {

/// What is about deflated data, as zlib counts it.
enum class Wrapper : int { Gzip = 15 + 16, None = -15 };

class Inflater {
 public:
  Inflater(std::string_view bytes, const std::string& name, std::uint64_t max_bytes,
           Wrapper wrapper)
      : packed_(bytes),
        name_(name),
        max_bytes_(max_bytes),
        kind_(wrapper == Wrapper::Gzip ? "gzip" : "ZIP") {
    if (inflateInit2(&stream_, static_cast<int>(wrapper)) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  std::string block() {
    unpack_member();
    bytes_.resize(filled_);
    return std::move(bytes_);
  }

  Unzipped members() {
    do {
      inflateReset(&stream_);
      unpack_member();
    } while (looks_like_gzip(packed_));
    bytes_.resize(filled_);
    const bool trailing = packed_.find_first_not_of('\0') != std::string_view::npos;
    return {std::move(bytes_), trailing};
  }

 private:
  void unpack_member() {
    for (int status = Z_OK; status != Z_STREAM_END;) {
      make_room();
      status = unpack_piece();
      require_within_limit();
      if (status == Z_MEM_ERROR) throw std::bad_alloc();
      if (status == Z_OK || status == Z_STREAM_END) continue;
      const bool cut = status == Z_BUF_ERROR && packed_.empty();
      throw ReadError(name_, "its " + kind_ + (cut ? " data is cut short" : " data is corrupt"));
    }
  }

  void require_within_limit() const {
    if (filled_ > max_bytes_)
      throw ReadError(name_, "unpacks to more than " + file_limit(max_bytes_));
  }

  // One byte more than allowed shows that there is more.
  void make_room() {
    constexpr std::uint64_t first_room = 1 << 16;
    if (filled_ < bytes_.size()) return;
    const std::uint64_t most = std::min<std::uint64_t>(max_bytes_, bytes_.max_size() - 1) + 1;
    bytes_.resize(std::min(most, std::max<std::uint64_t>(first_room, 2 * filled_)));
  }

  int unpack_piece() {
    constexpr std::size_t most_at_once = 1u << 30;  // zlib counts in 32 bits
    const auto given = static_cast<uInt>(std::min(most_at_once, packed_.size()));
    const auto room = static_cast<uInt>(std::min(most_at_once, bytes_.size() - filled_));
    // zlib does not write here, but its interface does not say so.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed_.data()));
    stream_.avail_in = given;
    stream_.next_out = reinterpret_cast<Bytef*>(bytes_.data() + filled_);
    stream_.avail_out = room;
    const int status = inflate(&stream_, Z_NO_FLUSH);
    packed_.remove_prefix(given - stream_.avail_in);
    filled_ += room - stream_.avail_out;
    return status;
  }

  std::string_view packed_;  // what is left of it
  const std::string& name_;
  std::uint64_t max_bytes_;
  std::string kind_;
  z_stream stream_{};
  std::string bytes_;
  std::size_t filled_ = 0;
};

/// Ends a compression on every way out.
struct Deflation {
  z_stream stream{};
  ~Deflation() { deflateEnd(&stream); }
};

}  // namespace

bool looks_like_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

Unzipped unzip(std::string_view bytes, const std::string& name, std::uint64_t max_bytes) {
  return Inflater(bytes, name, max_bytes, Wrapper::Gzip).members();
}

std::string inflated(std::string_view packed, const std::string& name, std::uint64_t max_bytes) {
  return Inflater(packed, name, max_bytes, Wrapper::None).block();
}

std::string beginning_of_gzip(std::string_view packed, std::size_t most) {
  std::string bytes(most, '\0');
  z_stream stream{};
  constexpr int gzip = 15 + 16;
  constexpr std::size_t most_at_once = 1u << 30;  // zlib counts in 32 bits
  if (inflateInit2(&stream, gzip) != Z_OK) throw std::bad_alloc();
  // zlib does not write to what it reads, but its interface does not say so.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(std::min(most_at_once, packed.size()));
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(most);
  inflate(&stream, Z_SYNC_FLUSH);
  bytes.resize(most - stream.avail_out);
  inflateEnd(&stream);
  return bytes;
}

std::string zip(std::string_view bytes) {
  constexpr int gzip = 15 + 16, memory_level = 8;
  constexpr std::size_t most_at_once = 1u << 30, room = 1u << 16;  // zlib counts in 32 bits
  Deflation deflation;
  z_stream& stream = deflation.stream;
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, gzip, memory_level,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::string packed;
  std::string piece(room, '\0');
  for (int status = Z_OK; status != Z_STREAM_END;) {
    const auto given = static_cast<uInt>(std::min(most_at_once, bytes.size()));
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = given;
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(room);
    status = deflate(&stream, given == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    bytes.remove_prefix(given - stream.avail_in);
    packed.append(piece, 0, room - stream.avail_out);
  }
  return packed;
}

std::string packed_block(std::string_view bytes) {
  std::string packed(compressBound(static_cast<uLong>(bytes.size())), '\0');
  auto size = static_cast<uLongf>(packed.size());
  if (compress(reinterpret_cast<Bytef*>(packed.data()), &size,
               reinterpret_cast<const Bytef*>(bytes.data()),
               static_cast<uLong>(bytes.size())) != Z_OK)
    throw std::bad_alloc();
  packed.resize(size);
  return packed;
}

bool unpack_block(std::string_view packed, std::uint64_t size, std::string& bytes) {
  // zlib judges a block that holds what was asked for and more as one without room.
  const std::size_t before = bytes.size();
  bytes.resize(before + size);
  auto unpacked = static_cast<uLongf>(size);
  const int status =
      uncompress(reinterpret_cast<Bytef*>(bytes.data() + before), &unpacked,
                 reinterpret_cast<const Bytef*>(packed.data()), static_cast<uLong>(packed.size()));
  if (status == Z_MEM_ERROR) throw std::bad_alloc();
  return status == Z_OK && unpacked == size;
}

}  // namespace sphparam
