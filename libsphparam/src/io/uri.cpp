#include "io/uri.h"

#include <cctype>

#include "io/files/base64.h"

namespace sphparam {
namespace {

constexpr char hexadecimal[] = "0123456789ABCDEF";

bool is_unreserved(unsigned char c) {
  return (c < 0x80 && std::isalnum(c)) || c == '-' || c == '.' || c == '_' || c == '~';
}

}  // namespace

std::string data_uri(std::string_view mime, std::string_view bytes) {
  return "data:" + std::string(mime) + ";base64," + to_base64(bytes);
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
