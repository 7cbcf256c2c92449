#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sphparam {

struct PageFigure {
  std::string source;   // a file beside the page, or its bytes: see `data_uri`
  std::string alt;      // for those who do not see it
  std::string caption;  // may be empty
};

struct PageTable {
  std::string caption;
  std::vector<std::string> header;             // one a column
  std::vector<std::vector<std::string>> rows;  // texts; the first column names the row
  /// Where the name of each row leads on this page: an id, or empty; none at all: no row's does.
  std::vector<std::string> links = {};
};

/// A page of HTML that needs nothing but its own figures: no network; readable on a phone, on
/// paper, light and dark. All text is escaped. A browser is told to load nothing from anywhere.
class Page {
 public:
  explicit Page(std::string_view title);

  void heading(std::string_view text);  // of a section
  /// Of a part of it; with an id, links lead there.
  void subheading(std::string_view text, std::string_view id = "");
  void paragraph(std::string_view text);
  void list(const std::vector<std::string>& items);
  /// Side by side where there is room; `least_width` is that of one, in pixels.
  void figures(const std::vector<PageFigure>& figures, int least_width);
  /// Scrolls sideways where it is too wide.
  void table(const PageTable& table);

  /// A sentence that is seen first, marked as good news or bad.
  void verdict(std::string_view text, bool good);
  /// Figures in large print, each with what it is.
  void key_figures(const std::vector<std::pair<std::string, std::string>>& figures);
  /// Names and values, one a line.
  void facts(const std::vector<std::pair<std::string, std::string>>& facts);
  /// Text as it is, folded away until somebody opens it.
  void folded_text(std::string_view summary, std::string_view text);

  /// Markup made elsewhere. Requires: text in it is escaped, and it loads nothing.
  void insert(std::string_view markup);
  void add_style(std::string_view css);
  /// A script at the end of the page, after those added before. Nothing in it ends it early.
  void add_script(std::string_view code);

  std::string html() const;  // UTF-8

 private:
  std::string body_, styles_, scripts_;
  std::string title_;
};

}  // namespace sphparam
