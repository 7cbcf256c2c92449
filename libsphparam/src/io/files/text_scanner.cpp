#include "io/files/text_scanner.h"

#include <algorithm>

#include "io/files/float32_digits.h"
#include "io/files/non_finite_advice.h"

namespace sphparam {

TextScanner::TextScanner(std::string_view text, std::string file, const ReadOptions& options,
                         long first_line)
    : file_(std::move(file)),
      options_(options),
      text_(without_byte_order_mark(text)),
      first_number_(first_line),
      line_number_(first_line),
      next_number_(first_line) {
  unify_line_ends();
  next_ = cursor_ = line_end_ = text_.data();
  end_ = text_.data() + text_.size();
}

void TextScanner::require_text() const {
  const std::size_t nul = text_.find('\0');
  if (nul == std::string_view::npos) return;
  const auto lines_before = std::count(text_.begin(), text_.begin() + nul, '\n');
  fail_at(first_number_ + lines_before, "NUL byte in a text file");
}

// Only files whose first line ends in a lone CR pay for a copy; the CR of CRLF counts as a blank.
void TextScanner::unify_line_ends() {
  const std::size_t first = text_.find_first_of("\r\n");
  if (first == std::string_view::npos || text_[first] == '\n') return;
  if (first + 1 < text_.size() && text_[first + 1] == '\n') return;
  converted_ = text_;
  for (std::size_t i = 0; i < converted_.size(); ++i) {
    const bool crlf = i + 1 < converted_.size() && converted_[i + 1] == '\n';
    if (converted_[i] == '\r' && !crlf) converted_[i] = '\n';
  }
  text_ = converted_;
}

void TextScanner::join_continued_lines() {
  const auto continued = [this] {
    const char* last = line_end_;
    while (last != cursor_ && is_blank(last[-1])) --last;
    return last != cursor_ && last[-1] == '\\' ? last - 1 : nullptr;
  };
  const char* backslash = continued();
  if (!backslash) return;
  const long first_number = line_number_;
  std::string joined;
  for (; backslash; backslash = continued()) {
    joined.append(cursor_, backslash).push_back(' ');
    if (static_cast<std::int64_t>(joined.size()) > options_.max_line_bytes) break;
    if (!next_line()) {
      cursor_ = line_end_;
      break;
    }
  }
  joined.append(cursor_, line_end_);
  joined_ = std::move(joined);
  cursor_ = joined_.data();
  line_end_ = cursor_ + joined_.size();
  line_number_ = first_number;
  check_line_length();
}

std::string_view TextScanner::peek_word() {
  skip_blanks();
  const char* stop = cursor_;
  while (!ends_token(stop)) ++stop;
  return {cursor_, static_cast<std::size_t>(stop - cursor_)};
}

std::string_view TextScanner::word() {
  const std::string_view found = peek_word();
  cursor_ += found.size();
  return found;
}

std::string_view TextScanner::rest() {
  skip_blanks();
  const char* stop = line_end_;
  while (stop != cursor_ && is_blank(stop[-1])) --stop;
  const std::string_view found(cursor_, static_cast<std::size_t>(stop - cursor_));
  cursor_ = line_end_;
  return found;
}

std::string_view TextScanner::comment() {
  skip('#');
  skip(' ');
  std::string_view text = peek_rest();
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

double TextScanner::coordinate32(bool& exceeds) {
  const char* const start = skip_plus();
  const double value = coordinate();
  if (std::isfinite(value) && !std::isfinite(rounded_to_float32(value))) {
    cursor_ = start;
    fail_expected("a number within range");
  }
  exceeds = exceeds || exceeds_float32({start, static_cast<std::size_t>(cursor_ - start)}, value);
  return value;
}

// std::from_chars reports numbers below the smallest double like numbers above the largest. The
// wider range of long double tells them apart.
double TextScanner::out_of_range_number(const char* start, const char* stop, std::errc error) {
  if (error != std::errc::result_out_of_range) fail_expected("a number");
  long double wide = 0;
  const auto [wide_stop, wide_error] = std::from_chars(start, stop, wide);
  if (wide_error != std::errc{} || std::fabs(wide) > 1) fail_expected("a number within range");
  return static_cast<double>(wide);
}

const char* TextScanner::after_hash_of_no_number(const char* hash) const {
  const std::string_view rest(hash + 1, static_cast<std::size_t>(line_end_ - hash) - 1);
  for (const std::string_view name : {"INF", "IND", "QNAN", "SNAN"}) {
    if (!rest.starts_with(name)) continue;
    const char* after = hash + 1 + name.size();
    while (after != line_end_ && *after >= '0' && *after <= '9') ++after;
    return after == line_end_ || is_blank(*after) ? after : nullptr;
  }
  return nullptr;
}

void TextScanner::fail_not_finite(std::string_view found, const char* what,
                                  NonFinite non_finite) const {
  fail(std::string("expected ") + what + ", found " + quoted(found) +
       (non_finite == NonFinite::RefusedWithAdvice ? non_finite_advice() : ""));
}

void TextScanner::fail_expected(const char* what) {
  const std::string_view found = peek_word();
  if (found.empty()) fail(std::string("expected ") + what + ", found the end of the line");
  const bool comma = found.find(',') != std::string_view::npos;
  fail(std::string("expected ") + what + ", found " + quoted(found) +
       (comma ? " (numbers have a decimal point and are separated by blanks)" : ""));
}

void TextScanner::fail(const std::string& message) const { fail_at(line_number_, message); }

void TextScanner::fail_at(long line, const std::string& message) const {
  throw ReadError::at_line(file_, line, message);
}

}  // namespace sphparam
