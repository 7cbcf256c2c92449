#include "batch/tables.h"

#include <algorithm>

#include "sphparam/batch/inputs.h"

namespace sphparam {

namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Fields one after the other, also over several lines where they are in quotes.
class TableReader {
 public:
  TableReader(std::string_view text, char separator, const std::string& name)
      : text_(text), separator_(separator), name_(name) {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
  }

  bool at_end() const { return text_.empty(); }
  long line() const { return line_; }

  std::vector<std::string> row() {
    std::vector<std::string> fields;
    for (bool more = true; more;) {
      fields.push_back(field());
      more = !text_.empty() && text_.front() == separator_;
      if (more) text_.remove_prefix(1);
    }
    if (text_.starts_with('\r')) text_.remove_prefix(1);
    if (text_.starts_with('\n')) text_.remove_prefix(1);
    ++line_;
    return fields;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw BatchInputError(name_ + ":" + std::to_string(line_) + ": " + what);
  }

 private:
  std::string field() {
    if (text_.starts_with('"')) return quoted_field();
    const std::size_t end =
        std::min(text_.find_first_of(std::string(1, separator_) + "\r\n"), text_.size());
    std::string field(text_.substr(0, end));
    text_.remove_prefix(end);
    return field;
  }

  std::string quoted_field() {
    std::string field;
    text_.remove_prefix(1);
    for (;;) {
      const std::size_t quote = text_.find('"');
      if (quote == std::string_view::npos) fail("a quote that does not end");
      field += text_.substr(0, quote);
      line_ += std::count(text_.begin(), text_.begin() + static_cast<long>(quote), '\n');
      text_.remove_prefix(quote + 1);
      if (!text_.starts_with('"')) return field;
      field += '"';
      text_.remove_prefix(1);
    }
  }

  std::string_view text_;
  char separator_;
  std::string name_;
  long line_ = 1;
};

}  // namespace

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.emplace_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

TextTable read_table(std::string_view text, char separator, const std::string& name) {
  TableReader reader(text, separator, name);
  if (reader.at_end()) reader.fail("an empty table; its first line must name the columns");
  TextTable table;
  table.header = reader.row();
  for (std::string& column : table.header) column = trimmed(column);
  while (!reader.at_end()) {
    const long line = reader.line();
    std::vector<std::string> row = reader.row();
    if (row.size() == 1 && trimmed(row.front()).empty()) continue;
    if (row.size() != table.header.size())
      throw BatchInputError(name + ":" + std::to_string(line) + ": " + std::to_string(row.size()) +
                            " fields, the header has " + std::to_string(table.header.size()));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string tsv_field(const std::string& text) {
  std::string field;
  for (const char c : text) {
    switch (c) {
      case '\t':
        field += "\\t";
        break;
      case '\n':
        field += "\\n";
        break;
      case '\r':
        field += "\\r";
        break;
      case '\\':
        field += "\\\\";
        break;
      default:
        field += c;
    }
  }
  return field;
}

std::vector<std::string> tsv_fields(std::string_view line) {
  std::vector<std::string> fields(1);
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '\t') {
      fields.emplace_back();
    } else if (c == '\\' && i + 1 < line.size()) {
      const char next = line[++i];
      fields.back() += next == 't' ? '\t' : next == 'n' ? '\n' : next == 'r' ? '\r' : next;
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

}  // namespace sphparam
