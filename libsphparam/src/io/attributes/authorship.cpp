#include "io/attributes/authorship.h"

#include <nlohmann/json.hpp>
#include <string_view>

namespace sphparam {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view copyright_words = "copyright ", extras_words = "asset extras ";
constexpr std::size_t most_bytes = 1 << 16;
constexpr int deepest = 32;

/// The rest of the first comment that begins so; empty where there is none.
std::string said(const MeshFile& file, std::string_view words) {
  for (const std::string& comment : file.comments)
    if (comment.starts_with(words)) return comment.substr(words.size());
  return "";
}

}  // namespace

std::string plain_extras(const std::string& json) {
  if (json.size() > most_bytes) return "";
  bool too_deep = false;
  const auto watch = [&](int depth, Json::parse_event_t, Json&) {
    too_deep = too_deep || depth > deepest;
    return !too_deep;
  };
  Json extras = Json::parse(json, watch, false);
  if (too_deep || !extras.is_object()) return "";
  extras.erase("sphparam");
  return extras.empty() ? "" : extras.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void note_authorship(MeshFile& file, const Authorship& author) {
  std::erase_if(file.comments, [](const std::string& comment) {
    return comment.starts_with(copyright_words) || comment.starts_with(extras_words);
  });
  if (!author.copyright.empty())
    file.comments.push_back(std::string(copyright_words) + one_line(author.copyright));
  if (!author.extras.empty()) file.comments.push_back(std::string(extras_words) + author.extras);
}

Authorship noted_authorship(const MeshFile& file) {
  return {said(file, copyright_words), plain_extras(said(file, extras_words))};
}

void take_authorship(MeshFile& file, const MeshFile& other) {
  note_authorship(file, noted_authorship(other));
}

}  // namespace sphparam
