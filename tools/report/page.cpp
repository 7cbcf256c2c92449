#include "report/page.h"

#include "report/svg.h"

namespace sphparam::tools {
namespace {

constexpr std::string_view style = R"(<style>
:root{color-scheme:light dark}
body{font:16px/1.5 system-ui,"DejaVu Sans",Helvetica,Arial,sans-serif;margin:0 auto;padding:1rem;
max-width:75rem;color:#1f2328;background:#fff}
h1{font-size:1.6rem;line-height:1.2}
h2{font-size:1.3rem;margin-top:2.5rem;border-bottom:1px solid #d1d9e0}
h3{font-size:1.05rem;margin-top:1.5rem}
p,li{max-width:45rem}
.row{display:grid;gap:1rem;align-items:start}
figure{margin:0}
img{display:block;width:100%;height:auto;background:#fff;border-radius:4px}
figcaption,.note{font-size:.85rem;color:#59636e}
.note{margin:1.5rem 0 0}
.wide{overflow-x:auto;margin:.5rem 0 1rem}
table{border-collapse:collapse;font-size:.85rem;font-variant-numeric:tabular-nums}
th,td{padding:.25rem .6rem;border-bottom:1px solid #d1d9e0;text-align:right;white-space:nowrap}
thead th{vertical-align:bottom;white-space:normal;min-width:3.5rem}
tr>:first-child{text-align:left;position:sticky;left:0;background:#fff}
@media(prefers-color-scheme:dark){
body,tr>:first-child{color:#e6edf3;background:#0d1117}
h2,th,td{border-color:#3d444d}
figcaption,.note{color:#9198a1}
}
</style>
)";

std::string element(std::string_view name, std::string_view text) {
  const std::string tag(name);
  return "<" + tag + ">" + escaped(text) + "</" + tag + ">";
}

std::string row(std::string_view cell, const std::vector<std::string>& texts) {
  std::string html = "<tr>";
  for (size_t k = 0; k < texts.size(); ++k) {
    const bool names_row = k == 0 && cell == "td";
    html +=
        names_row ? "<th scope=\"row\">" + escaped(texts[k]) + "</th>" : element(cell, texts[k]);
  }
  return html + "</tr>\n";
}

}  // namespace

Page::Page(std::string_view title) : title_(title) { body_ = element("h1", title) + "\n"; }

void Page::heading(std::string_view text) { body_ += element("h2", text) + "\n"; }

void Page::subheading(std::string_view text) { body_ += element("h3", text) + "\n"; }

void Page::paragraph(std::string_view text) { body_ += element("p", text) + "\n"; }

void Page::list(const std::vector<std::string>& items) {
  body_ += "<ul>\n";
  for (const std::string& item : items) body_ += element("li", item) + "\n";
  body_ += "</ul>\n";
}

void Page::figures(const std::vector<PageFigure>& figures, int least_width) {
  body_ += "<div class=\"row\" style=\"grid-template-columns:repeat(auto-fill,minmax(min(100%," +
           std::to_string(least_width) + "px),1fr))\">\n";
  for (const PageFigure& figure : figures) {
    body_ += "<figure><img loading=\"lazy\" src=\"" + escaped(figure.source) + "\" alt=\"" +
             escaped(figure.alt) + "\">";
    if (!figure.caption.empty()) body_ += element("figcaption", figure.caption);
    body_ += "</figure>\n";
  }
  body_ += "</div>\n";
}

void Page::table(const PageTable& table) {
  if (!table.caption.empty()) {
    body_ += "<p class=\"note\">" + escaped(table.caption) + "</p>\n";
  }
  body_ += "<div class=\"wide\"><table>\n";
  body_ += "<thead>" + row("th", table.header) + "</thead>\n<tbody>\n";
  for (const std::vector<std::string>& texts : table.rows) body_ += row("td", texts);
  body_ += "</tbody></table></div>\n";
}

std::string Page::html() const {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n" +
         element("title", title_) + "\n" + std::string(style) + "</head>\n<body>\n" + body_ +
         "</body>\n</html>\n";
}

}  // namespace sphparam::tools
