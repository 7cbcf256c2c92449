#pragma once

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

#include "sphparam/io/read_options.h"

namespace sphparam {

/// Text in UTF-8 without the mark that editors and spreadsheets of Windows put before it.
inline std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

/// Reads numbers and words of a text file, line after line, without a byte order mark. Lines end in
/// LF, CRLF or CR; `#` starts a comment that runs to the end of its line.
///
/// Every failure is a ReadError with the line it happened on.
class TextScanner {
 public:
  /// Requires: `text` outlives the scanner. `first_line` is the number of its first line.
  TextScanner(std::string_view text, std::string file, const ReadOptions& options,
              long first_line = 1);
  TextScanner(const TextScanner&) = delete;
  TextScanner& operator=(const TextScanner&) = delete;

  /// Throws: ReadError when the text holds a NUL.
  void require_text() const;

  /// Moves to the next line. Returns false at the end of the text.
  bool next_line();

  /// Glues the following line to this one for as long as a line ends in a backslash (OBJ).
  void join_continued_lines();

  /// Moves to the next line that holds more than blanks and comments.
  bool next_filled_line() {
    while (next_line())
      if (!at_line_end()) return true;
    return false;
  }

  /// True when only blanks or a comment are left on the line.
  bool at_line_end() {
    skip_blanks();
    return cursor_ == line_end_ || *cursor_ == '#';
  }

  bool at_comment() {
    skip_blanks();
    return cursor_ != line_end_ && *cursor_ == '#';
  }

  /// The next number, finite. Text that overflows is refused, text that underflows is zero.
  double real() { return number<double>("a number"); }
  /// The same for coordinates, which options may let be no finite numbers.
  double coordinate() { return number<double>("a number", of_coordinates()); }
  /// A coordinate that float32 has room for, with all digits of its text: `exceeds` becomes true
  /// where these are more than a float32 holds.
  double coordinate32(bool& exceeds);
  float real32() { return number<float>("a number"); }
  /// The same of values that may be no finite numbers: whoever reads them leaves them out.
  double any_real() { return number<double>("a number", NonFinite::Taken); }
  float any_real32() { return number<float>("a number", NonFinite::Taken); }

  /// The next whole number. A token such as 3.0 is refused.
  long integer() {
    const char* const start = skip_plus();
    long value = 0;
    const auto [stop, error] = std::from_chars(start, line_end_, value);
    if (error != std::errc{} || !ends_token(stop)) fail_expected("a whole number");
    cursor_ = stop;
    return value;
  }

  /// A whole number that may be followed by a slash (the corner of an OBJ face).
  long index() {
    long value = 0;
    const auto [stop, error] = std::from_chars(cursor_, line_end_, value);
    if (error != std::errc{} || (!ends_token(stop) && *stop != '/')) fail_expected("an index");
    cursor_ = stop;
    return value;
  }

  /// Steps over `c` if it is next.
  bool skip(char c) {
    if (cursor_ == line_end_ || *cursor_ != c) return false;
    ++cursor_;
    return true;
  }

  bool at_token_end() const { return ends_token(cursor_); }

  /// The next word; empty at the end of the line.
  std::string_view word();

  /// Text of the comment that `at_comment` found, without its `# `.
  std::string_view comment();

  /// What is left of the line, blanks at its ends removed, comments included.
  std::string_view rest();

  /// The token `real` or `integer` would read next, without moving.
  std::string_view peek_word();

  /// What is left of the line, without moving.
  std::string_view peek_rest() const {
    return {cursor_, static_cast<std::size_t>(line_end_ - cursor_)};
  }

  long line_number() const { return line_number_; }
  std::size_t remaining_bytes() const { return static_cast<std::size_t>(end_ - next_); }
  const std::string& file() const { return file_; }

  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void fail_at(long line, const std::string& message) const;

 private:
  static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  bool ends_token(const char* at) const { return at == line_end_ || is_blank(*at) || *at == '#'; }

  void skip_blanks() {
    while (cursor_ != line_end_ && is_blank(*cursor_)) ++cursor_;
  }

  // std::from_chars knows no plus sign; files do.
  const char* skip_plus() {
    skip_blanks();
    const bool plus = line_end_ - cursor_ > 1 && *cursor_ == '+' && cursor_[1] != '-';
    return plus ? cursor_ + 1 : cursor_;
  }

  /// What is done about NaN and infinity.
  enum class NonFinite { Refused, RefusedWithAdvice, Taken };
  NonFinite of_coordinates() const {
    return options_.non_finite ? NonFinite::Taken : NonFinite::RefusedWithAdvice;
  }

  template <class Real>
  Real number(const char* what, NonFinite non_finite = NonFinite::Refused) {
    const char* const start = skip_plus();
    Real value = 0;
    const auto [stop, error] = std::from_chars(start, line_end_, value);
    if (error != std::errc{}) [[unlikely]]
      value = static_cast<Real>(out_of_range_number(start, stop, error));
    if (stop != line_end_ && *stop == '#') [[unlikely]]
      if (const char* const after = after_hash_of_no_number(stop)) {
        if (non_finite != NonFinite::Taken)
          fail_not_finite({start, static_cast<std::size_t>(after - start)}, what, non_finite);
        cursor_ = after;
        return std::numeric_limits<Real>::quiet_NaN();
      }
    if (!ends_token(stop)) [[unlikely]]
      fail_expected(what);
    if (!std::isfinite(value) && non_finite != NonFinite::Taken) [[unlikely]]
      fail_not_finite({start, static_cast<std::size_t>(stop - start)}, what, non_finite);
    cursor_ = stop;
    return value;
  }

  /// Where "1.#INF", "-1.#IND", "1.#QNAN0" ends, as Microsoft's C library writes what is no number;
  /// null: a comment begins here.
  const char* after_hash_of_no_number(const char* hash) const;
  [[noreturn]] void fail_not_finite(std::string_view found, const char* what,
                                    NonFinite non_finite) const;
  double out_of_range_number(const char* start, const char* stop, std::errc error);
  void unify_line_ends();
  void check_line_length() const;
  [[noreturn]] void fail_expected(const char* what);

  std::string file_;
  const ReadOptions& options_;
  std::string converted_;  // the text, where its lines end in CR alone
  std::string joined_;     // the current line, where it is continued
  std::string_view text_;
  const char* next_;      // start of the following line
  const char* end_;       // of the text
  const char* cursor_;    // next character to read
  const char* line_end_;  // of the current line, without its LF
  long first_number_;     // of the text
  long line_number_;      // of the current line (the first one of a continued line)
  long next_number_;      // of the following line
};

inline bool TextScanner::next_line() {
  if (next_ == end_) return false;
  const auto* const stop =
      static_cast<const char*>(std::memchr(next_, '\n', static_cast<std::size_t>(end_ - next_)));
  cursor_ = next_;
  line_end_ = stop ? stop : end_;
  next_ = stop ? stop + 1 : end_;
  line_number_ = next_number_++;
  check_line_length();
  return true;
}

inline void TextScanner::check_line_length() const {
  if (line_end_ - cursor_ > options_.max_line_bytes) [[unlikely]]
    fail("line is longer than the limit of " + std::to_string(options_.max_line_bytes) + " bytes");
}

}  // namespace sphparam
