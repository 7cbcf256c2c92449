#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/text_scanner.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

// What the tables that shape models of bodies come in share: counts, then lines of numbers, and no
// magic word.

enum class ShapeTable { None, Plates, Icq };

/// Which table a text is, by its first lines and the line where the plates of a plate table begin:
/// counts and vectors first, as both have, and there whole numbers, or one more vector.
ShapeTable shape_table(std::string_view text);

/// Whether the next word is a whole number, at least 0.
bool begins_with_index(const TextScanner& scanner);

/// Whether the last word that is left on the line is no whole number.
bool ends_with_real(const TextScanner& scanner);

/// How many words are left on the line.
int words_left(const TextScanner& scanner);

/// Whether three numbers are next on the line, as in tables of longitudes, latitudes and radii.
bool three_numbers_left(const TextScanner& scanner);

/// Whether a line has a number with an exponent of Fortran's.
bool has_fortran_exponent(std::string_view line);

/// The next number, also with an exponent of Fortran's: 1.5D+01. Throws: ReadError, also for what
/// is not finite.
double table_number(TextScanner& scanner);
/// Three coordinates, which may be no finite numbers where `non_finite` is what the options of the
/// scanner say.
Vector3 table_vector(TextScanner& scanner, bool non_finite);

/// A number of things, each of `row_bytes` at least. Throws: ReadError for what is negative, over
/// the limit or what ids can count, or cannot fit the bytes that follow.
std::int64_t table_count(TextScanner& scanner, const char* things, std::int64_t limit,
                         std::uint64_t row_bytes);

/// Throws: ReadError unless the line ends here.
void expect_table_line_end(TextScanner& scanner);

/// Moves to the first line that holds something; comments before it are added to `comments`.
/// Returns false where there is none.
bool next_table_header(TextScanner& scanner, std::vector<std::string>& comments);

/// Moves to the next line that holds something. Throws: ReadError where there is none, which says
/// that `thing` number i + 1 of `count` is missing.
void next_table_row(TextScanner& scanner, const char* thing, std::int64_t i, std::int64_t count);

}  // namespace sphparam
