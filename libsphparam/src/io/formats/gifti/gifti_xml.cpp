#include "io/formats/gifti/gifti_xml.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/formats/xml_events.h"
#include "parsed_number.h"

// A stack of element names says where we are. libgiftiio is not used for reading: it prints and
// goes on where data is corrupt or cut short, and trusts sizes.

namespace sphparam {
namespace {

constexpr std::size_t deepest = 8;  // GIFTI has five levels

class Parser : public XmlEvents {
 public:
  explicit Parser(const std::string& name) : name_(name) {}

  GiftiDocument document() && {
    const auto found = static_cast<std::int64_t>(document_.arrays.size());
    if (found != announced_)
      throw ReadError(name_, "announces " + std::to_string(announced_) + " arrays and has " +
                                 std::to_string(found));
    return std::move(document_);
  }

  bool start(std::string_view element, const XmlAttributes& attributes, long line) override {
    line_ = line;
    if (path_.size() >= deepest) fail("elements are nested deeper than GIFTI has them");
    if (path_.empty() && element != "GIFTI") fail("expected <GIFTI>, found " + quoted(element));
    if (element == "GIFTI") start_gifti(attributes);
    if (element == "DataArray") start_array(attributes);
    if (element == "Data") start_data();
    if (element == "Label" && inside("LabelTable")) start_label(attributes);
    if (element == "MD" && inside("MetaData")) metadata().emplace_back();
    if (element == "CoordinateSystemTransformMatrix" && inside("DataArray"))
      array().coordinate_systems.emplace_back();
    static constexpr std::string_view texts[] = {
        "Data", "Name", "Value", "Label", "DataSpace", "MatrixData", "TransformedSpace"};
    collecting_ = std::find(std::begin(texts), std::end(texts), element) != std::end(texts);
    text_.clear();
    path_.emplace_back(element);
    return false;
  }

  void text(std::string_view text) override {
    if (collecting_) text_ += text;
  }

  void end(std::string_view) override {
    const std::string element = std::move(path_.back());
    path_.pop_back();
    if (collecting_) keep_text(element);
    collecting_ = false;
    if (element == "DataArray" && array().data_line == 0)
      fail_in_array(name_, array(), "has no <Data>");
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw ReadError::at_line(name_, line_, message);
  }

  bool inside(std::string_view parent) const { return !path_.empty() && path_.back() == parent; }
  bool in_array() const { return path_.size() > 1 && path_[1] == "DataArray"; }
  GiftiArray& array() { return document_.arrays.back(); }
  Metadata& metadata() { return in_array() ? array().metadata : document_.metadata; }

  void start_gifti(const XmlAttributes& attributes) {
    if (!path_.empty()) fail("<GIFTI> within <GIFTI>");
    const std::string_view version = attributes.value("Version");
    if (!version.starts_with("1"))
      fail("is GIFTI version " + quoted(version) + ", which is not supported; 1 is");
    if (!attributes.has("NumberOfDataArrays")) fail("NumberOfDataArrays is missing");
    announced_ = whole_number(attributes.value("NumberOfDataArrays"));
  }

  void start_array(const XmlAttributes& attributes) {
    if (!inside("GIFTI")) fail("<DataArray> is not directly within <GIFTI>");
    document_.arrays.emplace_back();
    array().line = line_;
    array().intent = attributes.value("Intent");
    array().data_type = attributes.value("DataType");
    array().encoding = attributes.value("Encoding");
    array().endian = attributes.value("Endian");
    array().order = attributes.value("ArrayIndexingOrder");
    array().external_file = attributes.value("ExternalFileName");
    const std::int64_t dimensionality =
        attributes.has("Dimensionality") ? whole_number(attributes.value("Dimensionality")) : -1;
    if (dimensionality < 1 || dimensionality > 6) fail("Dimensionality is not from 1 to 6");
    for (int i = 0; i < 6; ++i) {
      const std::string name = "Dim" + std::to_string(i);
      if (attributes.has(name) != (i < dimensionality))
        fail("the attributes Dim… do not fit Dimensionality");
      if (i < dimensionality) array().dimensions.push_back(whole_number(attributes.value(name)));
    }
  }

  void start_data() {
    if (!inside("DataArray")) fail("<Data> is not directly within <DataArray>");
    if (array().data_line > 0) fail("second <Data> of one array");
    array().data_line = line_;
  }

  void start_label(const XmlAttributes& attributes) {
    static constexpr const char* channels[] = {"Red", "Green", "Blue", "Alpha"};
    Label label;
    const char* const key = attributes.has("Key") ? "Key" : "Index";  // as it was called at first
    if (!attributes.has(key)) fail("label without a key");
    label.key = number<int>(attributes.value(key), "a whole number");
    std::array<float, 4> colour = {0, 0, 0, 1};
    for (std::size_t k = 0; k < colour.size(); ++k) {
      if (!attributes.has(channels[k])) continue;
      colour[k] = number<float>(attributes.value(channels[k]), "a number");
      label.colour = colour;
    }
    document_.labels.push_back(std::move(label));
  }

  template <class Number>
  Number number(std::string_view text, const char* what) const {
    const std::optional<Number> value = parsed<Number>(text);
    if (!value || !std::isfinite(static_cast<double>(*value)))
      fail(std::string("expected ") + what + ", found " + quoted(text));
    return *value;
  }

  /// At most 2³¹ − 1, so that products of two cannot overflow.
  std::int64_t whole_number(std::string_view text) const {
    const int value = number<int>(text, "a whole number");
    if (value < 0) fail("expected a whole number, found " + quoted(text));
    return value;
  }

  void keep_text(const std::string& element) {
    if (element == "Data") {
      array().data = std::move(text_);
    } else if (element == "Label" && inside("LabelTable") && !document_.labels.empty()) {
      document_.labels.back().name = std::move(text_);
    } else if (inside("MD") && !metadata().empty()) {
      (element == "Name" ? metadata().back().first : metadata().back().second) = std::move(text_);
    } else if (inside("CoordinateSystemTransformMatrix") && in_array() &&
               !array().coordinate_systems.empty()) {
      GiftiArray::CoordinateSystem& system = array().coordinate_systems.back();
      if (element == "DataSpace") system.data_space = std::move(text_);
      if (element == "TransformedSpace") system.transformed_space = std::move(text_);
      if (element == "MatrixData") system.matrix = std::move(text_);
    }
  }

  const std::string& name_;
  long line_ = 0;  // of the start tag that is read

  std::vector<std::string> path_;  // names of the open elements
  bool collecting_ = false;        // text of the innermost one
  std::string text_;
  std::int64_t announced_ = -1;
  GiftiDocument document_;
};

}  // namespace

GiftiDocument parse_gifti_xml(std::string_view bytes, const std::string& name) {
  Parser parser(name);
  read_xml(bytes, name, parser);
  return std::move(parser).document();
}

void fail_in_array(const std::string& name, const GiftiArray& array, const std::string& message) {
  throw ReadError::at_line(name, array.line, "array of " + quoted(array.intent) + " " + message);
}

}  // namespace sphparam
