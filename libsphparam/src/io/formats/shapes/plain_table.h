#pragma once

#include <string>
#include <string_view>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// Whether a text begins with a label of PDS3.
bool has_pds_label(std::string_view text);

/// The table of a text as its reader takes it: what comes after the label that is attached to it,
/// and blanks for the commas of rows that have a comma between all their numbers. Commas that stand
/// for decimal points are left, and refused.
class PlainTable {
 public:
  /// Requires: `text` outlives this. Cost: none where there is no comma.
  explicit PlainTable(std::string_view text);
  PlainTable(const PlainTable&) = delete;
  PlainTable& operator=(const PlainTable&) = delete;

  std::string_view text() const { return text_; }
  long first_line() const { return label_lines_ + 1; }
  /// Tells the label, of which nothing is kept.
  void note_label(MeshFile& file) const;

 private:
  std::string_view text_;
  std::string without_commas_;
  long label_lines_ = 0;
};

}  // namespace sphparam
