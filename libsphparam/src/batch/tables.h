#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "csv_field.h"

namespace sphparam {

/// Without their ends, "\n" or "\r\n".
std::vector<std::string> lines_of(std::string_view text);

struct TextTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  // as many fields as the header
};

/// CSV (RFC 4180: quotes about a field, doubled within) or, with tabs, TSV; blank lines are left
/// out, blanks about the names of columns too. `name`: of the file, for messages.
/// Throws: BatchInputError with the line, for rows of other length and quotes that do not end.
TextTable read_table(std::string_view text, char separator, const std::string& name);

/// A field of a manifest: tab, line feed, carriage return and backslash as \t, \n, \r, \\.
std::string tsv_field(const std::string& text);
/// The fields of such a line.
std::vector<std::string> tsv_fields(std::string_view line);

}  // namespace sphparam
