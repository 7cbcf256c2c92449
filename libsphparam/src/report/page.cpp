#include "report/page.h"

#include <algorithm>

#include "embedded/page.css.h"
#include "report/svg.h"

namespace sphparam {
namespace {

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

std::string linked(std::string_view text, const std::string& id) {
  return id.empty() ? escaped(text) : "<a href=\"#" + escaped(id) + "\">" + escaped(text) + "</a>";
}

std::string row(std::string_view cell, const std::vector<std::string>& texts,
                const std::string& link = "") {
  std::string html = "<tr>";
  for (size_t k = 0; k < texts.size(); ++k) {
    const bool names_row = k == 0 && cell == "td";
    html += names_row ? "<th scope=\"row\">" + linked(texts[k], link) + "</th>"
                      : element(cell, texts[k]);
  }
  return html + "</tr>\n";
}

}  // namespace

Page::Page(std::string_view title) : title_(title) { body_ = element("h1", title) + "\n"; }

void Page::heading(std::string_view text) { body_ += element("h2", text) + "\n"; }

void Page::subheading(std::string_view text, std::string_view id) {
  body_ += (id.empty() ? element("h3", text)
                       : "<h3 id=\"" + escaped(id) + "\">" + escaped(text) + "</h3>") +
           "\n";
}

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
  for (size_t k = 0; k < table.rows.size(); ++k)
    body_ += row("td", table.rows[k], k < table.links.size() ? table.links[k] : "");
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
         element("title", title_) + "\n" + "<style>\n" + std::string(embedded::page_css) +
         "</style>\n" + (styles_.empty() ? "" : "<style>\n" + styles_ + "</style>\n") +
         "</head>\n<body>\n" + body_ + scripts_ + "</body>\n</html>\n";
}

}  // namespace sphparam
