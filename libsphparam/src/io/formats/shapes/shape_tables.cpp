#include "io/formats/shapes/shape_tables.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "io/files/double_from_text.h"
#include "parsed_number.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam {
namespace {

constexpr std::string_view blanks = " \t\v\f";

/// A line is cut into at most this many words: more are none of ours.
constexpr std::size_t most_words = 5;

struct Words {
  std::array<std::string_view, most_words> words{};
  std::size_t count = 0;

  template <class Predicate>
  bool all(Predicate is_so) const {
    return std::all_of(words.begin(), words.begin() + count, is_so);
  }
};

Words split(std::string_view line) {
  Words found;
  line = line.substr(0, line.find('#'));
  while (found.count < most_words) {
    const std::size_t start = line.find_first_not_of(blanks);
    if (start == std::string_view::npos) break;
    line.remove_prefix(start);
    const std::size_t stop = std::min(line.find_first_of(blanks), line.size());
    found.words[found.count++] = line.substr(0, stop);
    line.remove_prefix(stop);
  }
  return found;
}

/// The lines of a text that hold words, whatever ends them.
class FilledLines {
 public:
  explicit FilledLines(std::string_view text) : text_(text) {}

  /// No words at the end of the text.
  Words next() {
    while (!text_.empty()) {
      const std::size_t stop = std::min(text_.find_first_of("\r\n"), text_.size());
      const Words words = split(text_.substr(0, stop));
      text_.remove_prefix(std::min(stop + 1, text_.size()));
      if (words.count > 0) return words;
    }
    return {};
  }

  /// The line after `lines` others.
  Words after(std::int64_t lines) {
    Words words = next();
    for (std::int64_t i = 0; i < lines && words.count > 0; ++i) words = next();
    return words;
  }

 private:
  std::string_view text_;
};

/// With an E where Fortran writes a D.
std::string with_e(std::string_view word) {
  std::string text(word);
  for (char& c : text)
    if (c == 'D' || c == 'd') c = 'e';
  return text;
}

std::optional<double> real(std::string_view word) {
  return parsed_double(with_e(word.starts_with('+') ? word.substr(1) : word));
}

bool is_count(std::string_view word) { return parsed<std::int64_t>(word).value_or(0) > 0; }
bool is_index(std::string_view word) { return parsed<std::int64_t>(word).value_or(-1) >= 0; }

bool are_counts(const Words& line, std::size_t count) {
  return line.count == count && line.all(is_count);
}

bool is_row(const Words& line) { return line.count == 3 || line.count == 4; }

bool is_vector(const Words& line) {
  return is_row(line) && line.all([](std::string_view word) { return real(word).has_value(); });
}

/// After three corners of a plate, or their numbers, its number of another kind may follow.
bool is_plate(const Words& line) {
  return is_row(line) && std::all_of(line.words.begin(), line.words.begin() + 3, is_index) &&
         (line.count == 3 || real(line.words[3]));
}

Words words_of(const TextScanner& scanner) {
  std::string_view line = scanner.peek_rest();
  if (line.ends_with('\r')) line.remove_suffix(1);
  return split(line);
}

/// Of a word with the exponent of Fortran; nothing, and nothing read, where it is none.
std::optional<double> fortran_number(TextScanner& scanner, bool non_finite) {
  const std::string_view word = scanner.peek_word();
  if (word.find_first_of("Dd") == std::string_view::npos) return std::nullopt;
  const std::optional<double> value = real(word);
  if (!value || !(std::isfinite(*value) || non_finite)) return std::nullopt;
  scanner.word();
  return value;
}

}  // namespace

ShapeTable shape_table(std::string_view text) {
  FilledLines lines(text);
  const Words first = lines.next();
  if (!are_counts(first, 1) && !are_counts(first, 2)) return ShapeTable::None;
  const std::int64_t count = *parsed<std::int64_t>(first.words[0]);
  const Words second = lines.next();
  const bool two_lines = first.count == 1 && are_counts(second, 1);
  if (!is_vector(two_lines ? lines.next() : second)) return ShapeTable::None;
  const Words after_vertices = lines.after(count - 1);
  // A number alone is that of the plates, or, where this is known, that of the first one's corners.
  if (are_counts(after_vertices, 1))
    return is_plate(lines.next()) ? ShapeTable::Plates : ShapeTable::None;
  if (first.count == 2 || two_lines)
    return is_plate(after_vertices) ? ShapeTable::Plates : ShapeTable::None;
  return is_vector(after_vertices) ? ShapeTable::Icq : ShapeTable::None;
}

int words_left(const TextScanner& scanner) { return static_cast<int>(words_of(scanner).count); }

bool begins_with_index(const TextScanner& scanner) {
  const Words words = words_of(scanner);
  return words.count > 0 && is_index(words.words[0]);
}

bool ends_with_real(const TextScanner& scanner) {
  const Words words = words_of(scanner);
  return words.count > 0 && real(words.words[words.count - 1]) &&
         !parsed<std::int64_t>(words.words[words.count - 1]);
}

bool three_numbers_left(const TextScanner& scanner) {
  const Words words = words_of(scanner);
  return words.count >= 3 &&
         std::all_of(words.words.begin(), words.words.begin() + 3,
                     [](std::string_view word) { return real(word).has_value(); });
}

bool has_fortran_exponent(std::string_view line) {
  const Words words = split(line);
  return std::any_of(words.words.begin(), words.words.begin() + words.count,
                     [](std::string_view word) {
                       return word.find_first_of("Dd") != std::string_view::npos && real(word);
                     });
}

double table_number(TextScanner& scanner) {
  if (const std::optional<double> value = fortran_number(scanner, false)) return *value;
  return scanner.real();
}

Vector3 table_vector(TextScanner& scanner, bool non_finite) {
  Vector3 result;
  for (double& coordinate : result) {
    const std::optional<double> value = fortran_number(scanner, non_finite);
    coordinate = value ? *value : scanner.coordinate();
  }
  return result;
}

std::int64_t table_count(TextScanner& scanner, const char* things, std::int64_t limit,
                         std::uint64_t row_bytes) {
  constexpr std::int64_t hard_limit = std::numeric_limits<int>::max() / 3;  // ids are ints
  const long count = scanner.integer();
  if (count < 0) scanner.fail(std::string("negative number of ") + things);
  if (count > std::min(limit, hard_limit))
    scanner.fail(std::to_string(count) + " " + things + " are over the limit of " +
                 std::to_string(std::min(limit, hard_limit)));
  if (row_bytes * static_cast<std::uint64_t>(count) > scanner.remaining_bytes() + 1)
    scanner.fail(std::to_string(count) + " " + things + " do not fit the " +
                 std::to_string(scanner.remaining_bytes()) + " bytes that follow");
  return count;
}

void expect_table_line_end(TextScanner& scanner) {
  if (!scanner.at_line_end())
    scanner.fail("unexpected " + quoted(scanner.peek_word()) + " at the end of the line");
}

bool next_table_header(TextScanner& scanner, std::vector<std::string>& comments) {
  while (scanner.next_line()) {
    if (!scanner.at_line_end()) return true;
    if (scanner.at_comment()) comments.push_back(one_line(scanner.comment()));
  }
  return false;
}

void next_table_row(TextScanner& scanner, const char* thing, std::int64_t i, std::int64_t count) {
  if (scanner.next_filled_line()) return;
  scanner.fail("the file ends before " + std::string(thing) + " " + std::to_string(i + 1) + " of " +
               std::to_string(count));
}

}  // namespace sphparam
