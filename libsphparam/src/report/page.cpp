#include "report/page.h"

#include <algorithm>

#include "report/svg.h"

namespace sphparam {
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
.verdict{display:inline-block;max-width:none;padding:.3rem .8rem;border-radius:1rem;
font-weight:600;color:#0b6b2b;background:#dafbe1}
.verdict.bad{color:#a40e26;background:#ffebe9}
dl{margin:.5rem 0}
.key{display:grid;gap:.75rem;grid-template-columns:repeat(auto-fill,minmax(9rem,1fr));margin:1rem 0}
.key div{padding:.6rem .8rem;border:1px solid #d1d9e0;border-radius:8px}
.key dt{font-size:.8rem;color:#59636e}
.key dd{margin:0;font-size:1.25rem;font-weight:600;font-variant-numeric:tabular-nums}
.facts{display:grid;grid-template-columns:minmax(5rem,max-content) 1fr;gap:.2rem 1rem;
font-size:.9rem}
.facts dt{color:#59636e}
.facts dd{margin:0;overflow-wrap:anywhere}
details{margin:.5rem 0;font-size:.85rem}
pre{white-space:pre-wrap;font-size:.8rem}
summary{cursor:pointer}
:focus-visible{outline:3px solid #1f5fd0;outline-offset:2px}
@media(prefers-color-scheme:dark){
body,tr>:first-child{color:#e6edf3;background:#0d1117}
h2,th,td,.key div{border-color:#3d444d}
figcaption,.note,.key dt,.facts dt{color:#9198a1}
.verdict{color:#7ee787;background:#12361f}
.verdict.bad{color:#ffb3ad;background:#4a1517}
:focus-visible{outline-color:#6cb0ff}
img{background:#0d1117}
}
</style>
)";

std::string element(std::string_view name, std::string_view text) {
  const std::string tag(name);
  return "<" + tag + ">" + escaped(text) + "</" + tag + ">";
}

/// What a browser may load: nothing but what is in the page, and pictures beside it.
constexpr std::string_view policy =
    "default-src 'none';img-src 'self' file: data: blob:;style-src 'unsafe-inline';"
    "connect-src data: blob:;base-uri 'none';form-action 'none'";

/// Scripts of the page itself, which may have WebAssembly in them; only where there are any.
constexpr std::string_view policy_of_scripts = ";script-src 'unsafe-inline' 'wasm-unsafe-eval'";

void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
}

std::string pairs(std::string_view css_class,
                  const std::vector<std::pair<std::string, std::string>>& texts) {
  std::string html = "<dl class=\"" + std::string(css_class) + "\">\n";
  const bool boxed = css_class == "key";
  for (const auto& [name, value] : texts) {
    const std::string pair = element("dt", name) + element("dd", value);
    html += (boxed ? "<div>" + pair + "</div>" : pair) + "\n";
  }
  return html + "</dl>\n";
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
  body_ += "<div class=\"wide\" tabindex=\"0\"><table>\n";
  body_ += "<thead>" + row("th", table.header) + "</thead>\n<tbody>\n";
  for (const std::vector<std::string>& texts : table.rows) body_ += row("td", texts);
  body_ += "</tbody></table></div>\n";
}

void Page::verdict(std::string_view text, bool good) {
  body_ += "<p class=\"verdict" + std::string(good ? "" : " bad") + "\">" + (good ? "✓ " : "✗ ") +
           escaped(text) + "</p>\n";
}

void Page::key_figures(const std::vector<std::pair<std::string, std::string>>& figures) {
  body_ += pairs("key", figures);
}

void Page::facts(const std::vector<std::pair<std::string, std::string>>& facts) {
  body_ += pairs("facts", facts);
}

void Page::folded_text(std::string_view summary, std::string_view text) {
  std::string lines;
  for (size_t from = 0; from < text.size();) {
    const size_t end = std::min(text.find('\n', from), text.size());
    lines += escaped(text.substr(from, end - from)) + "\n";
    from = end + 1;
  }
  body_ += "<details>" + element("summary", summary) + "<pre>" + lines + "</pre></details>\n";
}

void Page::insert(std::string_view markup) { body_ += markup; }

void Page::add_style(std::string_view css) { styles_ += css; }

void Page::add_script(std::string_view code) {
  // In strings and templates of JavaScript the backslash changes nothing.
  std::string script(code);
  replace_all(script, "</script", "<\\/script");
  replace_all(script, "<!--", "<\\!--");
  scripts_ += "<script>" + script + "</script>\n";
}

std::string Page::html() const {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"" +
         std::string(policy) + std::string(scripts_.empty() ? "" : policy_of_scripts) + "\">\n" +
         element("title", title_) + "\n" + std::string(style) +
         (styles_.empty() ? "" : "<style>\n" + styles_ + "</style>\n") + "</head>\n<body>\n" +
         body_ + scripts_ + "</body>\n</html>\n";
}

}  // namespace sphparam
