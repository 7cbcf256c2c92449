#include "io/formats/gltf/gltf_container.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "sphparam/io/read_options.h"

namespace sphparam {
namespace {

constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;
constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

void append_word(std::string& bytes, std::size_t word) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(word >> shift));
}

/// The chunk at `at`: its kind, its bytes.
std::pair<std::uint32_t, std::string_view> chunk_at(std::string_view whole, std::size_t at,
                                                    const std::string& name) {
  const auto fail = [&](const std::string& what) { throw ReadError::at_byte(name, at, what); };
  if (whole.size() - at < chunk_header_bytes) fail("the file ends within the header of a chunk");
  const std::uint32_t length = word_at(whole, at), kind = word_at(whole, at + 4);
  if (length > whole.size() - at - chunk_header_bytes)
    fail("chunk of " + std::to_string(length) + " bytes runs past the end of the file");
  if (length % 4 != 0) fail("the length of a chunk is no multiple of 4");
  return {kind, whole.substr(at + chunk_header_bytes, length)};
}

/// Where the chunk after one begins whose length is no multiple of 4: right after it, or after the
/// padding that its length leaves out. 0: nowhere is one, nor the end.
std::size_t next_chunk(std::string_view whole, std::size_t end_of_chunk) {
  for (const std::size_t at : {end_of_chunk, (end_of_chunk + 3) / 4 * 4}) {
    if (at == whole.size()) return at;
    if (at > whole.size() || whole.size() - at < chunk_header_bytes) continue;
    const std::uint32_t kind = word_at(whole, at + 4);
    if (kind == json_chunk || kind == binary_chunk) return at;
  }
  return 0;
}

/// Checks the twelve bytes of the header and the headers of all chunks.
GltfContainer open_binary(std::string_view bytes, const std::string& name,
                          std::vector<std::string>& notes) {
  if (bytes.size() < header_bytes) throw ReadError(name, "is too short for a binary glTF");
  if (bytes.size() > std::numeric_limits<std::uint32_t>::max())
    throw ReadError(name, "is larger than a binary glTF can be (4 GiB)");
  const std::uint32_t version = word_at(bytes, 4), length = word_at(bytes, 8);
  if (version != 2)
    throw ReadError::at_byte(
        name, 4,
        "is binary glTF " + std::to_string(version) + ", which is not supported; version 2 is");
  if (length > bytes.size())
    throw ReadError::at_byte(name, 8,
                             "the header says " + std::to_string(length) + " bytes, the file has " +
                                 std::to_string(bytes.size()));
  if (length < bytes.size()) notes.push_back("data after the end of the GLB ignored");
  if (length < header_bytes) throw ReadError::at_byte(name, 8, "the length of the file is wrong");

  GltfContainer container{.is_binary = true, .whole = bytes.substr(0, length)};
  const auto [kind, json] = chunk_at(container.whole, header_bytes, name);
  if (kind != json_chunk)
    throw ReadError::at_byte(name, header_bytes, "the first chunk is no JSON");
  container.json = json;
  container.json_offset = header_bytes + chunk_header_bytes;
  for (std::size_t at = container.json_offset + json.size(); at < length;) {
    const auto [next_kind, chunk] = chunk_at(container.whole, at, name);
    container.has_binary_chunk |= next_kind == binary_chunk;
    at += chunk_header_bytes + chunk.size();
  }
  return container;
}

}  // namespace

std::string with_padded_chunks(std::string_view bytes, std::vector<std::string>& notes) {
  if (!bytes.starts_with("glTF") || bytes.size() < header_bytes) return {};
  if (word_at(bytes, 8) > bytes.size()) return {};
  const std::string_view whole = bytes.substr(0, word_at(bytes, 8));
  std::string padded(whole.substr(0, std::min(whole.size(), header_bytes)));
  bool lacked = false;
  for (std::size_t at = header_bytes; at < whole.size();) {
    if (whole.size() - at < chunk_header_bytes) return {};
    const std::size_t length = word_at(whole, at), start = at + chunk_header_bytes;
    if (length > whole.size() - start) return {};
    lacked |= length % 4 != 0;
    at = length % 4 == 0 ? start + length : next_chunk(whole, start + length);
    if (at == 0) return {};
    append_word(padded, (length + 3) / 4 * 4);
    padded.append(whole, start - 4, 4 + length);
    const bool is_json = word_at(whole, start - 4) == json_chunk;
    padded.append((4 - length % 4) % 4, is_json ? ' ' : '\0');
  }
  if (!lacked) return {};
  std::string size;
  append_word(size, padded.size());
  notes.emplace_back("chunks that lack their padding to multiples of 4 bytes read all the same");
  return padded.replace(8, 4, size) + std::string(bytes.substr(whole.size()));
}

GltfContainer open_gltf(std::string_view bytes, const std::string& name,
                        std::vector<std::string>& notes) {
  if (bytes.starts_with("glTF")) return open_binary(bytes, name, notes);
  if (bytes.size() > std::numeric_limits<std::int32_t>::max())
    throw ReadError(name, "is too large for a glTF");
  return {.json = bytes, .whole = bytes};
}

std::string with_json(const GltfContainer& container, std::string json) {
  if (!container.is_binary) return json;
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string_view rest =
      container.whole.substr(container.json_offset + container.json.size());
  std::string whole(container.whole.substr(0, 8));  // magic and version
  append_word(whole, header_bytes + chunk_header_bytes + json.size() + rest.size());
  append_word(whole, json.size());
  append_word(whole, json_chunk);
  return whole.append(json).append(rest);
}

}  // namespace sphparam
