#include "io/formats/gltf/gltf_authorship.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "number_text.h"
#include "sphparam/io/losses.h"

namespace sphparam {
namespace {

using Json = nlohmann::ordered_json;

/// As deep as `check_gltf_json` lets a file be.
Json json_of(const tinygltf::Value& value) {
  if (value.IsBool()) return value.Get<bool>();
  if (value.IsInt()) return value.Get<int>();
  if (value.IsNumber()) return value.Get<double>();
  if (value.IsString()) return value.Get<std::string>();
  if (value.IsArray()) {
    Json all = Json::array();
    for (int i = 0; i < static_cast<int>(value.ArrayLen()); ++i)
      all.push_back(json_of(value.Get(i)));
    return all;
  }
  if (!value.IsObject()) return {};
  Json all = Json::object();
  for (const std::string& key : value.Keys()) all[key] = json_of(value.Get(key));
  return all;
}

bool says_something(const tinygltf::Value& extras) {
  if (!extras.IsObject()) return extras.Type() != tinygltf::NULL_TYPE;
  return std::ranges::any_of(extras.Keys(), [](const std::string& key) {
    return key != "targetNames" && key != "MSFT_screencoverage";
  });
}

/// Those of `asset` but for ours.
Json others_extras(const tinygltf::Model& model) {
  Json extras = json_of(model.asset.extras);
  if (extras.is_object()) extras.erase("sphparam");
  return extras;
}

template <class Things>
long with_extras(const Things& things) {
  return std::ranges::count_if(things, [](const auto& one) { return says_something(one.extras); });
}

}  // namespace

Authorship authorship_of(const tinygltf::Model& model) {
  const Json extras = others_extras(model);
  return {one_line(model.asset.copyright),
          extras.is_object()
              ? plain_extras(extras.dump(-1, ' ', false, Json::error_handler_t::replace))
              : ""};
}

std::string other_metadata(const tinygltf::Model& model) {
  std::vector<std::string> owners, words;
  if (!others_extras(model).empty() && authorship_of(model).extras.empty())
    words.emplace_back("extras of the asset: only an object of at most 64 KiB is carried");
  if (says_something(model.extras)) owners.emplace_back("the file");
  const auto add = [&](long count, const char* one, const char* many) {
    if (count > 0) owners.push_back(counted(count, one, many));
  };
  add(with_extras(model.scenes), "scene", "scenes");
  add(with_extras(model.nodes), "node", "nodes");
  add(with_extras(model.meshes), "mesh", "meshes");
  add(with_extras(model.materials), "material", "materials");
  if (model.extensions.contains("KHR_xmp_json_ld")) words.emplace_back("XMP metadata");
  if (!owners.empty()) words.push_back("extras of " + enumerated(owners));
  return joined(words, "; ");
}

}  // namespace sphparam
