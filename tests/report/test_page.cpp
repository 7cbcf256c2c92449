#include <catch2/catch.hpp>
#include <string>

#include "report/page.h"

using namespace sphparam;
using Catch::Matchers::Contains;

TEST_CASE("page: needs nothing but its own figures, and fits a phone") {
  Page page("Title");
  page.figures({{"a.png", "what is seen", "below it"}}, 200);
  const std::string html = page.html();
  CHECK_THAT(html, !Contains("http:") && !Contains("https:") && !Contains("<script") &&
                       !Contains("<link"));
  CHECK_THAT(html, Contains("name=\"viewport\"") && Contains("min(100%,200px)"));
  CHECK_THAT(html, Contains("src=\"a.png\" alt=\"what is seen\"") && Contains("<h1>Title</h1>"));
}

TEST_CASE("page: text of all kinds is escaped") {
  const std::string bad = "<b>&\"";
  Page page(bad);
  page.heading(bad);
  page.subheading(bad);
  page.paragraph(bad);
  page.list({bad});
  page.figures({{bad, bad, bad}}, 100);
  page.table({bad, {bad}, {{bad, bad}}});
  CHECK_THAT(page.html(), !Contains("<b>") && !Contains("&\"") && Contains("&lt;b&gt;&amp;&quot;"));
}

TEST_CASE("page: a table has its header, and its rows have names") {
  Page page("t");
  page.table({"", {"mesh", "folds"}, {{"cow", "3"}}});
  CHECK_THAT(page.html(), Contains("<th>mesh</th><th>folds</th>") &&
                              Contains("<th scope=\"row\">cow</th><td>3</td>"));
}

TEST_CASE("page: a browser is told to load nothing that is not there") {
  CHECK_THAT(Page("t").html(), Contains("default-src 'none'") && !Contains("script-src"));
}

TEST_CASE("page: verdicts, figures and facts are text too, and a script cannot end its element") {
  const std::string bad = "<b>&\"";
  Page page("t");
  page.verdict(bad, false);
  page.key_figures({{bad, bad}});
  page.facts({{bad, bad}});
  page.folded_text(bad, bad + "\n" + bad);
  page.add_script("'</script>'; '<!--'");
  const std::string html = page.html();
  CHECK_THAT(html, !Contains("<b>") && !Contains("&\"") && !Contains("<!--"));
  CHECK_THAT(html, Contains("'<\\/script>'; '<\\!--'</script>\n</body>"));
  CHECK_THAT(html, Contains("class=\"verdict bad\">✗ ") && Contains("&quot;\n&lt;b&gt;"));
}
