#include "batch/alike_reasons.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <string_view>

#include "batch/record.h"

// In a kind a mark stands for each name of the shape and for each number.

namespace sphparam {
namespace {

constexpr char name_mark = '\1', number_mark = '\2', mark_in_word = '\3';

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Also of bytes beyond ASCII.
bool is_of_word(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c & 0x80) != 0;
}

bool is_number(const std::string& name) {
  return name.find_first_not_of("0123456789") == std::string::npos;
}

/// Control characters of strangers become spaces, so that none is taken for a mark.
std::string told_text(const std::string& reason, const BatchItem& item) {
  constexpr unsigned char first_printed = 0x20;
  std::string text = without_folders(reason, item);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < first_printed) c = ' ';
  return text;
}

/// Where a name stands by itself, its mark.
void mark_name(std::string& text, const std::string& name) {
  if (is_number(name)) return;  // or empty: numbers are marked as such
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    const bool alone =
        (at == 0 || !is_of_word(text[at - 1])) && (end == text.size() || !is_of_word(text[end]));
    if (alone) text.replace(at, name.size(), 1, name_mark);
  }
}

std::size_t end_of_digits(std::string_view text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

/// Of "12", "0.5", "1.5e-05".
std::size_t end_of_number(std::string_view text, std::size_t begin) {
  std::size_t end = end_of_digits(text, begin);
  const auto digit_at = [&](std::size_t at) { return at < text.size() && is_digit(text[at]); };
  if (end < text.size() && text[end] == '.' && digit_at(end + 1))
    end = end_of_digits(text, end + 1);
  if (end < text.size() && text[end] == 'e') {
    const bool sign = end + 1 < text.size() && (text[end + 1] == '-' || text[end + 1] == '+');
    const std::size_t exponent = end + (sign ? 2 : 1);
    if (digit_at(exponent)) end = end_of_digits(text, exponent);
  }
  return end;
}

/// Does a minus before the end of the text belong to the number after it?
bool ends_with_sign(std::string_view text) {
  return text.ends_with('-') &&
         (text.size() == 1 ||
          std::string_view(" (,[").find(text[text.size() - 2]) != std::string_view::npos);
}

double value_of(std::string_view number) {
  double value = 0;
  std::from_chars(number.data(), number.data() + number.size(), value);
  return value;
}

}  // namespace

ReasonWording wording_of(const std::string& reason, const BatchItem& item) {
  std::string text = told_text(reason, item);
  mark_name(text, std::filesystem::path(item.path).filename().string());
  mark_name(text, item.id);
  ReasonWording wording;
  std::string& kind = wording.kind;
  for (std::size_t at = 0; at < text.size();) {
    if (!is_digit(text[at])) {
      kind += text[at++];
      continue;
    }
    const std::size_t end = end_of_number(text, at);
    const bool sign = ends_with_sign(kind);
    if (sign) kind.pop_back();
    wording.numbers.push_back((sign ? "-" : "") + text.substr(at, end - at));
    const bool in_word = !kind.empty() && (is_of_word(kind.back()) || kind.back() == '_' ||
                                           kind.back() == '-' || kind.back() == name_mark);
    kind += in_word ? mark_in_word : number_mark;
    at = end;
  }
  return wording;
}

void AlikeReasons::add(const std::string& reason, const BatchItem& item,
                       const ReasonWording& wording) {
  const std::string text = told_text(reason, item);
  if (!has_first_) {
    has_first_ = true;
    first_ = text;
    kind_ = wording.kind;
    for (const std::string& number : wording.numbers) ranges_.push_back({number, number});
    return;
  }
  equal_ = equal_ && text == first_;
  for (std::size_t i = 0; i < std::min(ranges_.size(), wording.numbers.size()); ++i) {
    const std::string& number = wording.numbers[i];
    if (value_of(number) < value_of(ranges_[i].least)) ranges_[i].least = number;
    if (value_of(number) > value_of(ranges_[i].greatest)) ranges_[i].greatest = number;
  }
}

std::string AlikeReasons::text() const {
  if (equal_) return first_;
  std::string text;
  auto range = ranges_.begin();
  for (const char c : kind_) {
    if ((c != number_mark && c != mark_in_word) || range == ranges_.end()) {
      text += c == name_mark ? "NAME" : std::string(1, c);
      continue;
    }
    const bool one = range->least == range->greatest;
    const bool in_word = c == mark_in_word;
    text += one ? range->least : in_word ? "*" : range->least + " to " + range->greatest;
    ++range;
  }
  return text;
}

}  // namespace sphparam
