#include "io/formats/three_mf/three_mf_model.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include "io/files/double_from_text.h"
#include "io/files/non_finite_advice.h"
#include "io/formats/xml_events.h"
#include "sphparam/io/mesh_file.h"

// Elements are told apart by their names without a prefix: which prefix an extension has is up to
// the file, and those that are read have names of their own.

namespace sphparam {
namespace {

std::string_view without_prefix(std::string_view name) {
  return name.substr(name.find(':') + 1);  // npos + 1 is 0
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

/// The next number of a text, which loses it; null where none is next.
template <class Number>
std::optional<Number> take_number(std::string_view& text) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  Number value{};
  const char* const last = text.data() + text.size();
  std::from_chars_result result;
  if constexpr (std::is_same_v<Number, double>)
    result = double_from_text(text.data(), last, value);
  else
    result = std::from_chars(text.data(), last, value);
  if (result.ec != std::errc{}) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(result.ptr - text.data()));
  return value;
}

class ModelReader final : public XmlEvents {
 public:
  ModelReader(const std::string& name, const ReadOptions& options)
      : name_(name), options_(options) {}

  ThreeMfModel take() { return std::move(model_); }

  bool start(std::string_view full_name, const XmlAttributes& attributes, long line) override {
    line_ = line;
    if (skipped_ > 0 || !take(without_prefix(full_name), attributes)) ++skipped_;
    return false;
  }

  void text(std::string_view text) override {
    if (in_metadata_) model_.metadata.back().second += text;
  }

  void end(std::string_view full_name) override {
    if (skipped_ > 0) {
      --skipped_;
      return;
    }
    const std::string_view element = without_prefix(full_name);
    if (element == "object") object_ = nullptr;
    if (element == "metadata") in_metadata_ = false;
    if (element == "basematerials" || element == "colorgroup") group_ = nullptr;
  }

 private:
  /// False: of an extension that is not read, with all that is in it.
  bool take(std::string_view element, const XmlAttributes& attributes) {
    constexpr std::array plain = {"resources",   "mesh",  "vertices",      "triangles",
                                  "components",  "build", "metadatagroup", "trianglesets",
                                  "triangleset", "ref",   "refrange"};
    if (element == "vertex")
      add_vertex(attributes);
    else if (element == "triangle")
      add_triangle(attributes);
    else if (element == "object")
      start_object(attributes);
    else if (element == "component")
      components().push_back(part(attributes));
    else if (element == "item")
      model_.build.push_back(part(attributes));
    else if (element == "model")
      start_model(attributes);
    else if (element == "metadata")
      start_metadata(attributes);
    else if (element == "basematerials" || element == "colorgroup")
      start_group(element, attributes);
    else if (element == "base")
      add_colour(attributes, "displaycolor");
    else if (element == "color")
      add_colour(attributes, "color");
    else if (std::ranges::find(plain, element) == plain.end())
      return is_lost(element);
    return true;
  }

  bool is_lost(std::string_view element) {
    ++model_.other_elements[one_line(element)];
    return false;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw ReadError::at_line(name_, line_, message);
  }

  template <class Number>
  Number number(const XmlAttributes& attributes, const char* key) const {
    std::string_view text = attributes.value(key);
    const std::string shown = quoted(text);
    const auto value = take_number<Number>(text);
    if (!value || !trimmed(text).empty())
      fail(std::string("expected a number for ") + key + ", found " + shown);
    return *value;
  }

  std::int64_t number_or(const XmlAttributes& attributes, const char* key,
                         std::int64_t other) const {
    return attributes.has(key) ? number<std::int64_t>(attributes, key) : other;
  }

  void start_model(const XmlAttributes& attributes) {
    if (attributes.has("unit")) model_.unit = attributes.value("unit");
  }

  void start_metadata(const XmlAttributes& attributes) {
    in_metadata_ = object_ == nullptr;
    if (in_metadata_) model_.metadata.emplace_back(one_line(attributes.value("name")), "");
  }

  // --- Objects ---

  void start_object(const XmlAttributes& attributes) {
    const auto id = number<std::int64_t>(attributes, "id");
    const auto [at, is_new] = model_.objects.try_emplace(id);
    if (!is_new) fail("there are two objects " + std::to_string(id));
    object_ = &at->second;
    object_->name = one_line(attributes.value("name"));
    if (attributes.has("type")) object_->type = attributes.value("type");
    paint_of_object_.group = number_or(attributes, "pid", ThreeMfPaint::none);
    paint_of_object_.index.fill(number_or(attributes, "pindex", 0));
  }

  ThreeMfObject& object() {
    if (!object_) fail("a mesh or component stands outside of objects");
    return *object_;
  }
  std::vector<ThreeMfPart>& components() { return object().components; }

  void add_vertex(const XmlAttributes& attributes) {
    std::vector<double>& positions = object().positions;
    constexpr std::int64_t hard_limit = std::numeric_limits<int>::max() / 3;  // ids are ints
    if (++vertices_ > std::min(options_.max_vertices, hard_limit))
      fail("more vertices than the limit of " +
           std::to_string(std::min(options_.max_vertices, hard_limit)));
    for (const char* const key : {"x", "y", "z"}) {
      positions.push_back(number<double>(attributes, key));
      if (std::isfinite(positions.back())) continue;
      if (!options_.non_finite) fail("a coordinate is not a finite number" + non_finite_advice());
      positions.back() = std::numeric_limits<double>::quiet_NaN();
    }
  }

  void add_triangle(const XmlAttributes& attributes) {
    ThreeMfObject& to = object();
    if (++triangles_ > options_.max_faces)
      fail("more triangles than the limit of " + std::to_string(options_.max_faces));
    const auto vertices = static_cast<std::int64_t>(to.positions.size() / 3);
    for (const char* const key : {"v1", "v2", "v3"}) {
      const auto v = number<std::int64_t>(attributes, key);
      if (v < 0 || v >= vertices)
        fail("triangle names vertex " + std::to_string(v) + " of " + std::to_string(vertices) +
             " (counted from 0)");
      to.triangles.push_back(static_cast<int>(v));
    }
    const int *const end = to.triangles.data() + to.triangles.size(), a = end[-3], b = end[-2],
                     c = end[-1];
    if ((a == b || b == c || c == a) && !options_.repeated_corners)
      fail("triangle names a vertex twice" + repeated_corners_advice());
    to.paint.push_back(paint(attributes));
    count_paint_of_slicers(attributes);
  }

  ThreeMfPaint paint(const XmlAttributes& attributes) const {
    ThreeMfPaint paint = paint_of_object_;
    paint.group = number_or(attributes, "pid", paint.group);
    if (!attributes.has("p1")) return paint;
    paint.index.fill(number<std::int64_t>(attributes, "p1"));
    paint.index[1] = number_or(attributes, "p2", paint.index[0]);
    paint.index[2] = number_or(attributes, "p3", paint.index[0]);
    return paint;
  }

  /// Which are encoded within a triangle, each program for itself.
  void count_paint_of_slicers(const XmlAttributes& attributes) {
    constexpr std::array keys = {"slic3rpe:mmu_segmentation",
                                 "slic3rpe:custom_supports",
                                 "slic3rpe:custom_seam",
                                 "slic3rpe:fuzzy_skin",
                                 "paint_color",
                                 "paint_supports",
                                 "paint_seam",
                                 "paint_fuzzy_skin"};
    if (std::ranges::any_of(keys, [&](const char* key) { return attributes.has(key); }))
      ++model_.painted_in_slicer;
  }

  // --- Where objects are put ---

  ThreeMfPart part(const XmlAttributes& attributes) const {
    std::string path(attributes.value_in_any_space("path"));
    return {std::move(path), number<std::int64_t>(attributes, "objectid"), place(attributes)};
  }

  ThreeMfPlace place(const XmlAttributes& attributes) const {
    ThreeMfPlace place = ThreeMfPlace::Identity();
    std::string_view text = attributes.value("transform");
    if (text.empty()) return place;
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 3; ++column) {
        const auto value = take_number<double>(text);
        if (!value || !std::isfinite(*value)) fail("a transform is twelve finite numbers");
        place(row, column) = *value;
      }
    }
    if (!trimmed(text).empty()) fail("a transform is twelve finite numbers");
    return place;
  }

  // --- Materials and colours ---

  void start_group(std::string_view element, const XmlAttributes& attributes) {
    const auto id = number<std::int64_t>(attributes, "id");
    const auto [at, is_new] = model_.groups.try_emplace(id);
    if (!is_new) fail("there are two groups " + std::to_string(id));
    group_ = &at->second;
    group_->is_material = element == "basematerials";
  }

  void add_colour(const XmlAttributes& attributes, const char* key) {
    if (!group_) fail("a colour stands outside of groups of them");
    const std::string_view text = trimmed(attributes.value(key));
    std::array<std::uint8_t, 4> colour = {255, 255, 255, 255};
    const bool is_colour = text.starts_with('#') && (text.size() == 7 || text.size() == 9);
    for (std::size_t i = 0; is_colour && 2 * i + 2 < text.size(); ++i) {
      const char* const digits = text.data() + 1 + 2 * i;
      const auto [end, error] = std::from_chars(digits, digits + 2, colour[i], 16);
      if (error != std::errc{} || end != digits + 2)
        fail("expected a colour as #RRGGBB, found " + quoted(text));
    }
    if (!is_colour) fail("expected a colour as #RRGGBB, found " + quoted(text));
    group_->colours.push_back(colour);
    group_->names.push_back(one_line(attributes.value("name")));
  }

  const std::string& name_;
  const ReadOptions& options_;
  ThreeMfModel model_;
  ThreeMfObject* object_ = nullptr;  // that is being read
  ThreeMfGroup* group_ = nullptr;    // likewise
  ThreeMfPaint paint_of_object_;     // of triangles that say nothing
  bool in_metadata_ = false;
  std::int64_t skipped_ = 0;  // elements that are open
  std::int64_t vertices_ = 0, triangles_ = 0;
  long line_ = 0;
};

}  // namespace

ThreeMfModel parse_three_mf_model(std::string_view xml, const std::string& name,
                                  const ReadOptions& options) {
  ModelReader reader(name, options);
  read_xml(xml, name, reader);
  return reader.take();
}

}  // namespace sphparam
