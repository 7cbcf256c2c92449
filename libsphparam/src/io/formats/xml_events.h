#pragma once

#include <string>
#include <string_view>

namespace sphparam {

/// The start of an element, as expat tells it: names and values by turns, then null.
class XmlAttributes {
 public:
  explicit XmlAttributes(const char** attributes) : attributes_(attributes) {}
  /// Empty where there is none of this name.
  std::string_view value(std::string_view name) const;
  bool has(std::string_view name) const;
  /// Of a name behind any prefix, as p:path is of path.
  std::string_view value_in_any_space(std::string_view name) const;

 private:
  const char** attributes_;
};

/// Is told what XML holds, in order. What these throw comes out of `read_xml`.
class XmlEvents {
 public:
  virtual ~XmlEvents() = default;
  /// True: nothing after this start tag is wanted, and it need not be XML.
  virtual bool start(std::string_view element, const XmlAttributes& attributes, long line) = 0;
  virtual void text(std::string_view text) = 0;
  virtual void end(std::string_view element) = 0;
};

/// Reads XML to its end, or until `start` says that this is enough; returns the place after that
/// start tag, else the size of the text. Entity declarations are refused.
/// Throws: ReadError with the line.
std::size_t read_xml(std::string_view bytes, const std::string& name, XmlEvents& events);

}  // namespace sphparam
