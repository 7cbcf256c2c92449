#include <catch2/catch.hpp>
#include <string>

#include "report/viewer.h"

using namespace sphparam;
using Catch::Matchers::Contains;

namespace {

const ViewerScript script{"viewer();\n//# sourceMappingURL=viewer.js.map", "licence"};
const ViewedModel model{"its name", "what it is", "glTF", "PNG"};

std::string page_of(const std::vector<ViewedModel>& models,
                    const std::vector<ViewedSurface>& surfaces,
                    const std::optional<ViewerScript>& viewer) {
  Page page("t");
  add_viewer(page, models, surfaces, viewer);
  return page.html();
}

}  // namespace

TEST_CASE("viewer: models and the script are in the page, and no way to the script's sources") {
  const std::string html = page_of({model}, {{"a", "A"}, {"b", "B"}}, script);
  CHECK_THAT(html, Contains("data:model/gltf-binary;base64,Z2xURg==") && Contains("viewer();") &&
                       Contains("data:image/png;base64,UE5H") && !Contains("sourceMappingURL"));
  CHECK_THAT(html, Contains("value=\"a\" checked") && Contains("<span>B</span>"));
}

TEST_CASE("viewer: one surface needs no choice, a model alone no name") {
  const std::string html = page_of({{"", "what it is", "glTF", ""}}, {{"a", "A"}}, script);
  CHECK_THAT(html, !Contains("<fieldset") && !Contains("<figcaption") && !Contains("<img"));
}

TEST_CASE("viewer: without the script, or without models, there are pictures and no controls") {
  for (const std::string& html :
       {page_of({model}, {}, std::nullopt), page_of({{"n", "alt", "", "PNG"}}, {}, script)}) {
    CHECK_THAT(html,
               Contains("<img src=\"data:image/png") && !Contains("<script") && !Contains("<form"));
  }
}

TEST_CASE("viewer: several models stand side by side, each with its own bytes") {
  const std::string html = page_of({model, model}, {}, script);
  CHECK_THAT(html, Contains("class=\"views many\"") && Contains("data-model=\"model1\"") &&
                       Contains("id=\"model1\""));
}
