#include "io/formats/three_mf/slicer_volumes.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <utility>
#include <vector>

#include "io/formats/xml_events.h"

// <object id="1"> <volume firstid="0" lastid="11"> <metadata type="volume" key="volume_type"
// value="ParameterModifier"/> … Earlier versions have key="modifier" value="1".

namespace sphparam {
namespace {

/// Triangles of an object, from the first to the last.
struct Range {
  std::int64_t first, last;
};

std::int64_t number(std::string_view text) {
  std::int64_t value = -1;  // of no triangle
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

class VolumeReader final : public XmlEvents {
 public:
  bool start(std::string_view element, const XmlAttributes& attributes, long) override {
    if (element == "object") object_ = number(attributes.value("id"));
    if (element == "volume")
      range_ = {number(attributes.value("firstid")), number(attributes.value("lastid"))};
    is_no_part_ |=
        element == "metadata" && says_no_part(attributes.value("key"), attributes.value("value"));
    return false;
  }
  void text(std::string_view) override {}
  void end(std::string_view element) override {
    if (element == "volume" && std::exchange(is_no_part_, false)) found[object_].push_back(range_);
  }

  std::map<std::int64_t, std::vector<Range>> found;  // by objects

 private:
  static bool says_no_part(std::string_view key, std::string_view value) {
    return (key == "volume_type" && value != "ModelPart") || (key == "modifier" && value == "1");
  }

  std::int64_t object_ = -1;
  Range range_ = {-1, -1};
  bool is_no_part_ = false;
};

/// Its vertices go as well, unless others use them.
void take_out(ThreeMfObject& object, const std::vector<char>& is_out) {
  const auto vertices = object.positions.size() / 3;
  std::vector<char> stays(vertices, 1);
  for (const char is_wanted : {0, 1})  // who is named by both stays
    for (std::size_t i = 0; i < object.triangles.size(); ++i)
      if (is_out[i / 3] != is_wanted)
        stays[static_cast<std::size_t>(object.triangles[i])] = is_wanted;
  std::vector<int> now(vertices);
  std::vector<double> positions;
  for (std::size_t v = 0; v < vertices; ++v) {
    now[v] = static_cast<int>(positions.size() / 3);
    if (stays[v])
      positions.insert(positions.end(), &object.positions[3 * v], &object.positions[3 * v] + 3);
  }
  ThreeMfObject rest{.name = object.name,
                     .type = object.type,
                     .positions = std::move(positions),
                     .components = object.components};
  for (std::size_t f = 0; f < object.paint.size(); ++f) {
    if (is_out[f]) continue;
    for (std::size_t k = 0; k < 3; ++k)
      rest.triangles.push_back(now[static_cast<std::size_t>(object.triangles[3 * f + k])]);
    rest.paint.push_back(object.paint[f]);
  }
  object = std::move(rest);
}

}  // namespace

std::int64_t take_out_volumes_of_slicer(ThreeMfModel& model, std::string_view xml,
                                        const std::string& name) {
  VolumeReader reader;
  read_xml(xml, name, reader);
  std::int64_t volumes = 0;
  for (const auto& [id, ranges] : reader.found) {
    const auto at = model.objects.find(id);
    if (at == model.objects.end()) continue;
    const auto triangles = std::ssize(at->second.paint);
    std::vector<char> is_out(static_cast<std::size_t>(triangles), 0);
    for (const Range& range : ranges) {
      if (range.first < 0 || range.last >= triangles || range.first > range.last) continue;
      std::fill(is_out.begin() + range.first, is_out.begin() + range.last + 1, char{1});
      ++volumes;
    }
    take_out(at->second, is_out);
  }
  return volumes;
}

}  // namespace sphparam
