#include "io/formats/gltf/gltf_json.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

// The events of a streaming parser, with the path that leads to each: meshes/#/primitives/#/indices
// (every index of an array is "#"). tinygltf takes a value of the wrong type for a missing one and
// cuts 64-bit integers down to 32, so what it reads as an index must be one here.

namespace sphparam {
namespace {

using Json = nlohmann::json;

bool starts_with_any(std::string_view text, std::initializer_list<std::string_view> beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](std::string_view beginning) { return text.starts_with(beginning); });
}

/// Extensions that change the look only, or how numbers are stored that are read anyway.
bool is_supported(std::string_view extension) {
  return starts_with_any(
      extension, {"KHR_mesh_quantization", "EXT_meshopt_compression", "KHR_draco_mesh_compression",
                  "EXT_mesh_gpu_instancing", "KHR_node_visibility", "KHR_materials_",
                  "KHR_lights_punctual", "KHR_texture_", "EXT_texture_", "MSFT_texture_dds"});
}

class Checker : public nlohmann::json_sax<Json> {
 public:
  Checker(std::uint64_t json_offset, bool has_binary_chunk, const std::string& name,
          const ReadOptions& options)
      : json_offset_(json_offset),
        has_binary_chunk_(has_binary_chunk),
        name_(name),
        options_(options) {}

  GltfSummary take() {
    if (version_.empty()) fail("asset.version is missing");
    if (!version_.starts_with("2."))
      fail(std::string("is glTF ") + sphparam::quoted(version_) +
           ", which is not supported; glTF 2.0 is");
    if (buffers_without_uri_ > (has_binary_chunk_ ? 1 : 0))
      fail("a buffer has neither a URI nor a binary chunk");
    return std::move(summary_);
  }

  bool null() override { return scalar(); }
  bool boolean(bool) override { return scalar(); }
  bool number_integer(number_integer_t value) override {
    // tinygltf takes a negative offset, length or stride for one that is not there.
    const bool of_bytes = is_index() && steps_.back().starts_with("byte");
    if (of_bytes || (is_index() && value < std::numeric_limits<std::int32_t>::min()))
      fail(path() + " is out of range");
    return whole_number();
  }
  bool number_unsigned(number_unsigned_t value) override {
    const bool wide = starts_with_any(path(), {"buffers/#/byteLength", "bufferViews/#/byte",
                                               "accessors/#/byteOffset", "accessors/#/count"});
    constexpr std::uint64_t widest = std::uint64_t{1} << 53;
    if (is_index() && value > (wide ? widest : std::numeric_limits<std::int32_t>::max()))
      fail(path() + " is out of range");
    return whole_number();
  }
  bool number_float(number_float_t, const string_t&) override { return scalar(); }
  bool binary(binary_t&) override { return scalar(); }

  bool string(string_t& text) override {
    const std::string place = path();
    if (place == "asset/version") version_ = text;
    if (place == "extensionsRequired/#" && !is_supported(text))
      fail(std::string("requires the extension ") + sphparam::quoted(text) +
           ", which is not supported");
    if (place == "buffers/#/uri" && !text.empty()) add_buffer_uri(text);
    return scalar();
  }

  bool start_object(std::size_t) override {
    count_value();
    if (++objects_ > options_.max_json_objects)
      fail("has more JSON objects than the limit of " + std::to_string(options_.max_json_objects));
    const std::string place = path();
    if (steps_.size() == 1 && (place == "buffers" || place == "accessors" || place == "meshes"))
      fail(place + " have names, as in glTF 1.0, which is not supported; glTF 2.0 is");
    if (place == "buffers/#") uri_seen_ = false;
    // A buffer that only decoded views are in has no bytes of its own, and so no URI.
    if (place == "buffers/#/extensions/EXT_meshopt_compression") uri_seen_ = true;
    if (place == "meshes/#/primitives/#") ++summary_.primitives;
    return enter();
  }
  bool end_object() override {
    steps_.pop_back();
    if (path() == "buffers/#") buffers_without_uri_ += !uri_seen_;
    return true;
  }
  bool start_array(std::size_t) override {
    count_value();
    enter();
    steps_.back().push_back('#');
    return true;
  }
  bool end_array() override {
    steps_.pop_back();
    return true;
  }
  // A name that looks like a path must not be taken for one.
  bool key(string_t& text) override {
    summary_.compressed |=
        text == "EXT_meshopt_compression" || text == "KHR_draco_mesh_compression";
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '/' || c == '#'; }, '?');
    steps_.back() = text;
    return true;
  }

  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception&) override {
    throw ReadError::at_byte(name_, json_offset_ + position, "the JSON is malformed here");
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw ReadError(name_, message); }

  bool enter() {
    if (static_cast<std::int64_t>(steps_.size()) >= options_.max_json_depth)
      fail("the JSON is nested deeper than the limit of " +
           std::to_string(options_.max_json_depth));
    steps_.emplace_back();
    return true;
  }

  void count_value() {
    if (++values_ > options_.max_json_values)
      fail("has more JSON values than the limit of " + std::to_string(options_.max_json_values));
  }

  bool scalar() {
    count_value();
    if (is_index()) fail(path() + " is no whole number");
    return true;
  }
  bool whole_number() {
    count_value();
    return true;
  }

  /// Where we are. Names of members are cut: no path that matters is longer.
  std::string path() const {
    constexpr std::size_t deepest = 6, longest_allowed = 24;
    std::string text;
    for (std::size_t i = 0; i < std::min(steps_.size(), deepest); ++i) {
      if (i > 0) text.push_back('/');
      text.append(steps_[i], 0, longest_allowed);
    }
    return text;
  }

  /// True where tinygltf reads an integer that says what is read.
  bool is_index() const {
    if (steps_.empty()) return false;
    static constexpr std::string_view rooms[] = {"buffers", "bufferViews", "accessors",
                                                 "meshes",  "nodes",       "scenes"};
    static constexpr std::string_view keys[] = {
        "buffer",        "bufferView", "byteOffset", "byteLength", "byteStride",
        "componentType", "count",      "indices",    "mesh",       "mode"};
    const std::string& last = steps_.back();
    if (steps_.size() == 1) return last == "scene";
    if (std::find(std::begin(rooms), std::end(rooms), steps_[0]) == std::end(rooms)) return false;
    for (const std::string& step : steps_)
      if (step == "extras" || step == "extensions") return false;
    const std::string& parent = steps_[steps_.size() - 2];
    return std::find(std::begin(keys), std::end(keys), last) != std::end(keys) ||
           parent == "attributes" ||
           (last == "#" && (parent == "children" || parent == "nodes") && steps_.size() > 2);
  }

  void add_buffer_uri(const std::string& uri) {
    uri_seen_ = true;
    // Other data URIs tinygltf would take for names of files.
    if (starts_with_any(
            uri, {"data:application/octet-stream;base64,", "data:application/gltf-buffer;base64,"}))
      return;
    if (uri.starts_with("data:")) fail("buffer has a data URI of an unknown type");
    summary_.external_buffers.push_back(uri);
  }

  std::uint64_t json_offset_;
  bool has_binary_chunk_;
  const std::string& name_;
  const ReadOptions& options_;
  std::vector<std::string> steps_;  // a member's name, or "#" in an array
  std::int64_t values_ = 0, objects_ = 0;
  std::string version_;
  bool uri_seen_ = false;
  long buffers_without_uri_ = 0;
  GltfSummary summary_;
};

}  // namespace

GltfSummary check_gltf_json(std::string_view json, std::uint64_t json_offset, bool has_binary_chunk,
                            const std::string& name, const ReadOptions& options) {
  if (static_cast<std::int64_t>(json.size()) > options.max_json_bytes)
    throw ReadError(name, "has more JSON than the limit of " +
                              std::to_string(options.max_json_bytes) + " bytes");
  Checker checker(json_offset, has_binary_chunk, name, options);
  Json::sax_parse(json.begin(), json.end(), &checker);
  return checker.take();
}

}  // namespace sphparam
