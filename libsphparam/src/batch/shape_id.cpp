#include "batch/shape_id.h"

#include <cstdint>

#include "batch/content_hash.h"

namespace sphparam {

namespace {

constexpr std::size_t longest = 100, hash_digits = 8;

/// A character of UTF-8, or a byte that belongs to none.
struct Character {
  std::size_t bytes = 1;
  std::uint32_t code = 0;
  bool valid = false;
};

Character character_at(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(at);
  if (lead < 0x80) return {1, lead, true};
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (at + bytes > text.size()) return {};
  std::uint32_t code = lead & (0x7Fu >> bytes);
  for (std::size_t i = at + 1; i < at + bytes; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  constexpr std::uint32_t least[] = {0x80, 0x800, 0x10000}, greatest = 0x10FFFF;
  if (lead < 0xC0 || lead > 0xF4 || code < least[bytes - 2] || code > greatest) return {};
  return {bytes, code, true};
}

/// Beyond ASCII all but blanks, marks of direction and what stands between words.
bool is_letter(std::uint32_t code) {
  if (code < 0x80)
    return (code >= '0' && code <= '9') || (code >= 'a' && code <= 'z') ||
           (code >= 'A' && code <= 'Z') || code == '-' || code == '_' || code == '.';
  const auto within = [&](std::uint32_t first, std::uint32_t last) {
    return code >= first && code <= last;
  };
  return !within(0x80, 0xBF) && !within(0x2000, 0x206F) && !within(0x3000, 0x3003) &&
         !within(0xD800, 0xF8FF) && !within(0xFE00, 0xFE0F) && !within(0xFEFF, 0xFEFF) &&
         !within(0xFFF0, 0xFFFF);
}

/// Each character that may not stand there as '_', up to so many bytes.
std::string with_letters_only(std::string_view text, std::size_t most) {
  std::string id;
  if (text.empty() || text.front() == '.' || text.front() == '-') id = "_";
  for (std::size_t at = 0; at < text.size();) {
    const Character character = character_at(text, at);
    const bool stays = character.valid && is_letter(character.code);
    if (most - id.size() < (stays ? character.bytes : 1)) break;
    id += stays ? text.substr(at, character.bytes) : "_";
    at += character.bytes;
  }
  return id;
}

}  // namespace

bool is_shape_id(std::string_view text) { return !text.empty() && shape_id_of(text) == text; }

std::string shape_id_of(std::string_view text) {
  std::string id = with_letters_only(text, std::string::npos);
  return id.size() > longest ? shape_id_with_hash(text) : id;
}

std::string shape_id_with_hash(std::string_view text) {
  return with_letters_only(text, longest - 1 - hash_digits) + "_" +
         content_hash(text).substr(0, hash_digits);
}

}  // namespace sphparam
