#include "io/formats/xml_events.h"

#include <expat.h>

#include <exception>
#include <memory>
#include <new>

#include "sphparam/io/read_options.h"

// expat's callbacks are C, so what they throw is carried past it.

namespace sphparam {
namespace {

struct FreeExpat {
  void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
};

class Parser {
 public:
  Parser(std::string_view bytes, const std::string& name, XmlEvents& events)
      : bytes_(bytes), name_(name), events_(events), expat_(XML_ParserCreate(nullptr)) {
    if (!expat_) throw std::bad_alloc();
    XML_SetUserData(expat_.get(), this);
    XML_SetElementHandler(expat_.get(), on_start, on_end);
    XML_SetCharacterDataHandler(expat_.get(), on_text);
    XML_SetEntityDeclHandler(expat_.get(), on_entity);
  }

  std::size_t parse() {
    constexpr std::size_t piece_size = 1 << 20;
    for (std::size_t at = 0; at < bytes_.size(); at += piece_size) {
      const std::string_view piece = bytes_.substr(at, piece_size);
      const bool last = at + piece.size() == bytes_.size();
      const XML_Status status =
          XML_Parse(expat_.get(), piece.data(), static_cast<int>(piece.size()), last);
      if (thrown_) std::rethrow_exception(thrown_);
      if (enough_) return enough_at_;
      if (status == XML_STATUS_OK) continue;
      if (XML_GetErrorCode(expat_.get()) == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
      fail(std::string("malformed XML: ") + XML_ErrorString(XML_GetErrorCode(expat_.get())));
    }
    return bytes_.size();
  }

 private:
  static void XMLCALL on_start(void* self, const XML_Char* element, const XML_Char** attributes) {
    guarded(self, [&](Parser& p) {
      if (p.events_.start(element, XmlAttributes(attributes), p.line())) p.stop();
    });
  }
  static void XMLCALL on_end(void* self, const XML_Char* element) {
    guarded(self, [&](Parser& p) { p.events_.end(element); });
  }
  static void XMLCALL on_text(void* self, const XML_Char* text, int length) {
    guarded(self, [&](Parser& p) { p.events_.text({text, static_cast<std::size_t>(length)}); });
  }
  static void XMLCALL on_entity(void* self, const XML_Char*, int, const XML_Char*, int,
                                const XML_Char*, const XML_Char*, const XML_Char*,
                                const XML_Char*) {
    guarded(self, [](Parser& p) { p.fail("declares an entity, which is not supported"); });
  }

  template <class Action>
  static void guarded(void* self, const Action& action) {
    Parser& parser = *static_cast<Parser*>(self);
    if (parser.thrown_ || parser.enough_) return;
    try {
      action(parser);
    } catch (...) {
      parser.thrown_ = std::current_exception();
      XML_StopParser(parser.expat_.get(), XML_FALSE);
    }
  }

  void stop() {
    enough_ = true;
    enough_at_ = static_cast<std::size_t>(XML_GetCurrentByteIndex(expat_.get())) +
                 static_cast<std::size_t>(XML_GetCurrentByteCount(expat_.get()));
    XML_StopParser(expat_.get(), XML_FALSE);
  }

  long line() const { return static_cast<long>(XML_GetCurrentLineNumber(expat_.get())); }

  [[noreturn]] void fail(const std::string& message) const {
    throw ReadError::at_line(name_, line(), message);
  }

  std::string_view bytes_;
  const std::string& name_;
  XmlEvents& events_;
  std::unique_ptr<std::remove_pointer_t<XML_Parser>, FreeExpat> expat_;
  std::exception_ptr thrown_;
  bool enough_ = false;
  std::size_t enough_at_ = 0;
};

}  // namespace

bool XmlAttributes::has(std::string_view name) const {
  for (const char** at = attributes_; *at; at += 2)
    if (name == at[0]) return true;
  return false;
}

std::string_view XmlAttributes::value(std::string_view name) const {
  for (const char** at = attributes_; *at; at += 2)
    if (name == at[0]) return at[1];
  return {};
}

std::string_view XmlAttributes::value_in_any_space(std::string_view name) const {
  for (const char** at = attributes_; *at; at += 2) {
    const std::string_view full = at[0];
    if (full.substr(full.find(':') + 1) == name) return at[1];  // npos + 1 is 0
  }
  return {};
}

std::size_t read_xml(std::string_view bytes, const std::string& name, XmlEvents& events) {
  return Parser(bytes, name, events).parse();
}

}  // namespace sphparam
