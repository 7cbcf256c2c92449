#include "io/formats/gifti/gifti_xml.h"

#include <expat.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <exception>
#include <memory>

// expat tells of elements and text; a stack of element names says where we are. Its callbacks are
// C, so what they throw is carried past it. libgiftiio, which is built on expat too, is not used
// for reading: it prints and goes on where data is corrupt or cut short, and trusts sizes.

namespace sphparam {
namespace {

constexpr std::size_t deepest = 8;  // GIFTI has five levels

class Parser {
 public:
  Parser(std::string_view bytes, const std::string& name)
      : bytes_(bytes), name_(name), expat_(XML_ParserCreate(nullptr)) {
    if (!expat_) throw std::bad_alloc();
    XML_SetUserData(expat_.get(), this);
    XML_SetElementHandler(expat_.get(), on_start, on_end);
    XML_SetCharacterDataHandler(expat_.get(), on_text);
    XML_SetEntityDeclHandler(expat_.get(), on_entity);
  }

  GiftiDocument parse() {
    constexpr std::size_t piece_size = 1 << 20;
    for (std::size_t at = 0; at < bytes_.size(); at += piece_size) {
      const std::string_view piece = bytes_.substr(at, piece_size);
      const bool last = at + piece.size() == bytes_.size();
      const XML_Status status =
          XML_Parse(expat_.get(), piece.data(), static_cast<int>(piece.size()), last);
      if (thrown_) std::rethrow_exception(thrown_);
      if (status != XML_STATUS_OK)
        fail(std::string("malformed XML: ") + XML_ErrorString(XML_GetErrorCode(expat_.get())));
    }
    const auto found = static_cast<std::int64_t>(document_.arrays.size());
    if (found != announced_)
      throw ReadError(name_, "announces " + std::to_string(announced_) + " arrays and has " +
                                 std::to_string(found));
    return std::move(document_);
  }

 private:
  struct FreeExpat {
    void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
  };

  static void XMLCALL on_start(void* self, const XML_Char* element, const XML_Char** attributes) {
    static_cast<Parser*>(self)->guarded([&](Parser& p) { p.start(element, attributes); });
  }
  static void XMLCALL on_end(void* self, const XML_Char*) {
    static_cast<Parser*>(self)->guarded([](Parser& p) { p.end(); });
  }
  static void XMLCALL on_text(void* self, const XML_Char* text, int length) {
    static_cast<Parser*>(self)->guarded([&](Parser& p) {
      if (p.collecting_) p.text_.append(text, static_cast<std::size_t>(length));
    });
  }
  static void XMLCALL on_entity(void* self, const XML_Char*, int, const XML_Char*, int,
                                const XML_Char*, const XML_Char*, const XML_Char*,
                                const XML_Char*) {
    static_cast<Parser*>(self)->guarded(
        [](Parser& p) { p.fail("declares an entity, which is not supported"); });
  }

  template <class Action>
  void guarded(Action&& action) {
    if (thrown_) return;
    try {
      action(*this);
    } catch (...) {
      thrown_ = std::current_exception();
      XML_StopParser(expat_.get(), XML_FALSE);
    }
  }

  long line() const { return static_cast<long>(XML_GetCurrentLineNumber(expat_.get())); }

  [[noreturn]] void fail(const std::string& message) const {
    throw ReadError::at_line(name_, line(), message);
  }

  bool inside(std::string_view parent) const { return !path_.empty() && path_.back() == parent; }
  bool in_array() const { return path_.size() > 1 && path_[1] == "DataArray"; }
  GiftiArray& array() { return document_.arrays.back(); }
  GiftiMetadata& metadata() { return in_array() ? array().metadata : document_.metadata; }

  void start(const std::string& element, const XML_Char** attributes) {
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
    path_.push_back(element);
  }

  void start_gifti(const XML_Char** attributes) {
    if (!path_.empty()) fail("<GIFTI> within <GIFTI>");
    std::string version;
    for (; *attributes; attributes += 2) {
      const std::string_view key = attributes[0], value = attributes[1];
      if (key == "Version") version = value;
      if (key == "NumberOfDataArrays") announced_ = whole_number(value);
    }
    if (!version.starts_with("1"))
      fail("is GIFTI version " + quoted(version) + ", which is not supported; 1 is");
    if (announced_ < 0) fail("NumberOfDataArrays is missing");
  }

  void start_array(const XML_Char** attributes) {
    if (!inside("GIFTI")) fail("<DataArray> is not directly within <GIFTI>");
    document_.arrays.emplace_back();
    array().line = line();
    std::int64_t dimensionality = -1;
    std::vector<std::int64_t> dimensions(6, -1);
    for (; *attributes; attributes += 2) {
      const std::string_view key = attributes[0], value = attributes[1];
      if (key == "Intent") array().intent = value;
      if (key == "DataType") array().data_type = value;
      if (key == "Encoding") array().encoding = value;
      if (key == "Endian") array().endian = value;
      if (key == "ArrayIndexingOrder") array().order = value;
      if (key == "ExternalFileName") array().external_file = value;
      if (key == "Dimensionality") dimensionality = whole_number(value);
      if (key.size() == 4 && key.starts_with("Dim") && key[3] >= '0' && key[3] <= '5')
        dimensions[static_cast<std::size_t>(key[3] - '0')] = whole_number(value);
    }
    if (dimensionality < 1 || dimensionality > 6) fail("Dimensionality is not from 1 to 6");
    for (std::size_t i = 0; i < dimensions.size(); ++i)
      if ((dimensions[i] >= 0) != (static_cast<std::int64_t>(i) < dimensionality))
        fail("the attributes Dim… do not fit Dimensionality");
    dimensions.resize(static_cast<std::size_t>(dimensionality));
    array().dimensions = std::move(dimensions);
  }

  void start_data() {
    if (!inside("DataArray")) fail("<Data> is not directly within <DataArray>");
    if (array().data_line > 0) fail("second <Data> of one array");
    array().data_line = line();
  }

  void start_label(const XML_Char** attributes) {
    static constexpr std::string_view channels[] = {"Red", "Green", "Blue", "Alpha"};
    GiftiLabel label;
    std::array<float, 4> colour = {0, 0, 0, 1};
    bool has_key = false;
    for (; *attributes; attributes += 2) {
      const std::string_view name = attributes[0], value = attributes[1];
      if (name == "Key" || name == "Index") {  // the first versions of GIFTI said Index
        label.key = number<int>(value, "a whole number");
        has_key = true;
      }
      const auto channel = std::find(std::begin(channels), std::end(channels), name);
      if (channel == std::end(channels)) continue;
      colour[static_cast<std::size_t>(channel - std::begin(channels))] =
          number<float>(value, "a number");
      label.colour = colour;
    }
    if (!has_key) fail("label without a key");
    document_.labels.push_back(std::move(label));
  }

  template <class Number>
  Number number(std::string_view text, const char* what) const {
    Number value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end || !std::isfinite(static_cast<double>(value)))
      fail(std::string("expected ") + what + ", found " + quoted(text));
    return value;
  }

  /// At most 2³¹ − 1, so that products of two cannot overflow.
  std::int64_t whole_number(std::string_view text) const {
    const int value = number<int>(text, "a whole number");
    if (value < 0) fail("expected a whole number, found " + quoted(text));
    return value;
  }

  void end() {
    const std::string element = std::move(path_.back());
    path_.pop_back();
    if (collecting_) keep_text(element);
    collecting_ = false;
    if (element == "DataArray" && array().data_line == 0)
      fail_in_array(name_, array(), "has no <Data>");
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

  std::string_view bytes_;
  const std::string& name_;
  std::unique_ptr<std::remove_pointer_t<XML_Parser>, FreeExpat> expat_;
  std::exception_ptr thrown_;

  std::vector<std::string> path_;  // names of the open elements
  bool collecting_ = false;        // text of the innermost one
  std::string text_;
  std::int64_t announced_ = -1;
  GiftiDocument document_;
};

}  // namespace

GiftiDocument parse_gifti_xml(std::string_view bytes, const std::string& name) {
  return Parser(bytes, name).parse();
}

void fail_in_array(const std::string& name, const GiftiArray& array, const std::string& message) {
  throw ReadError::at_line(name, array.line, "array of " + quoted(array.intent) + " " + message);
}

}  // namespace sphparam
