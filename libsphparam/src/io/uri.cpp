#include "io/uri.h"

#include <cctype>
#include <cstdint>

namespace sphparam {
namespace {

constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr char hexadecimal[] = "0123456789ABCDEF";

bool is_unreserved(unsigned char c) {
  return (c < 0x80 && std::isalnum(c)) || c == '-' || c == '.' || c == '_' || c == '~';
}

}  // namespace

std::string data_uri(std::string_view mime, std::string_view bytes) {
  std::string uri = "data:";
  uri.reserve(uri.size() + mime.size() + 8 + bytes.size() / 3 * 4 + 4);
  uri.append(mime).append(";base64,");
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      uri += k <= count ? alphabet[group >> (18 - 6 * k) & 63] : '=';
  }
  return uri;
}

std::string uri_of_file(std::string_view name) {
  std::string uri;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (is_unreserved(byte)) {
      uri += c;
    } else {
      uri += '%';
      uri += hexadecimal[byte >> 4];
      uri += hexadecimal[byte & 15];
    }
  }
  return uri;
}

}  // namespace sphparam
