#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sphparam::tools {

struct PageFigure {
  std::string source;   // a file beside the page
  std::string alt;      // for those who do not see it
  std::string caption;  // may be empty
};

struct PageTable {
  std::string caption;
  std::vector<std::string> header;             // one a column
  std::vector<std::vector<std::string>> rows;  // texts; the first column names the row
};

/// A page of HTML that needs nothing but its own figures: no network, no script; readable on a
/// phone, on paper, light and dark. All text is escaped.
class Page {
 public:
  explicit Page(std::string_view title);

  void heading(std::string_view text);     // of a section
  void subheading(std::string_view text);  // of a part of it
  void paragraph(std::string_view text);
  void list(const std::vector<std::string>& items);
  /// Side by side where there is room; `least_width` is that of one, in pixels.
  void figures(const std::vector<PageFigure>& figures, int least_width);
  /// Scrolls sideways where it is too wide.
  void table(const PageTable& table);

  std::string html() const;  // UTF-8

 private:
  std::string body_;
  std::string title_;
};

}  // namespace sphparam::tools
