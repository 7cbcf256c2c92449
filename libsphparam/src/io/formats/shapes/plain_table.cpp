#include "io/formats/shapes/plain_table.h"

#include <algorithm>

#include "number_text.h"
#include "sphparam/io/losses.h"

namespace sphparam {
namespace {

constexpr std::string_view blanks = " \t\v\f", label_begins = "PDS_VERSION_ID", label_ends = "END";

std::string_view trimmed(std::string_view words) {
  const std::size_t first = std::min(words.find_first_not_of(blanks), words.size());
  words.remove_prefix(first);
  return words.substr(0, words.find_last_not_of(blanks) + 1);
}

/// Lines by what ends them: LF, CRLF or CR.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {}

  bool next() {
    if (next_ == text_.size()) return false;
    begin_ = next_;
    const std::size_t stop = std::min(text_.find_first_of("\r\n", begin_), text_.size());
    line_ = text_.substr(begin_, stop - begin_);
    next_ = std::min(stop + (text_.substr(stop).starts_with("\r\n") ? 2 : 1), text_.size());
    ++count_;
    return true;
  }

  std::string_view line() const { return line_.substr(0, line_.find('#')); }
  std::size_t begin() const { return begin_; }
  std::size_t after() const { return next_; }
  long count() const { return count_; }

 private:
  std::string_view text_, line_;
  std::size_t begin_ = 0, next_ = 0;
  long count_ = 0;
};

/// One word, or several, between any two commas: only the former separate.
bool are_separators(std::string_view line) {
  if (line.find(',') == std::string_view::npos) return false;
  for (bool last = false; !last;) {
    const std::size_t comma = line.find(',');
    last = comma == std::string_view::npos;
    const std::string_view field = trimmed(line.substr(0, comma));
    if (field.empty() ? !last : field.find_first_of(blanks) != std::string_view::npos) return false;
    if (!last) line.remove_prefix(comma + 1);
  }
  return true;
}

/// Tables of numbers begin with counts: no other text is searched for commas.
bool begins_with_counts(std::string_view text) {
  Lines lines(text);
  while (lines.next()) {
    const std::string_view line = trimmed(lines.line());
    if (!line.empty())
      return line.find_first_not_of("0123456789, \t\v\f") == std::string_view::npos;
  }
  return false;
}

}  // namespace

bool has_pds_label(std::string_view text) { return text.starts_with(label_begins); }

PlainTable::PlainTable(std::string_view text) : text_(text) {
  if (has_pds_label(text)) {
    Lines lines(text);
    while (lines.next() && trimmed(lines.line()) != label_ends) continue;
    text_.remove_prefix(lines.after());
    label_lines_ = lines.count();
  }
  if (text_.find(',') == std::string_view::npos || !begins_with_counts(text_)) return;
  without_commas_ = text_;
  Lines lines(text_);
  while (lines.next()) {
    if (!are_separators(lines.line())) continue;
    const auto first = without_commas_.begin() + static_cast<std::ptrdiff_t>(lines.begin());
    std::replace(first, first + std::ssize(lines.line()), ',', ' ');
  }
  text_ = without_commas_;
}

void PlainTable::note_label(MeshFile& file) const {
  if (label_lines_ > 0)
    add_loss(file.notes, "the PDS label before the table, " + counted(label_lines_, "line"));
}

}  // namespace sphparam
