#include "report/viewer.h"

#include <cstdint>
#include <filesystem>

#include "embedded/viewer.css.h"
#include "embedded/viewer.js.h"
#include "io/files/file_bytes.h"
#include "io/files/program_path.h"
#include "io/uri.h"
#include "report/svg.h"
#include "sphparam/gltf/gltf_writer.h"

namespace sphparam {
namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{64} << 20;  // of a file of the viewer

/// Empty where there is no such file. Throws: ReadError.
std::string bytes_of(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return {};
  return std::string(FileBytes(path.string(), most_bytes).view());
}

/// The viewer's map back to its sources is not here; browsers would ask for it.
std::string without_source_map(std::string code) {
  const size_t at = code.rfind("//# sourceMappingURL=");
  if (at != std::string::npos) code.resize(at);
  return code;
}

std::string picture_of(const ViewedModel& model, const std::string& attributes) {
  if (model.picture.empty()) return "";
  return "<img" + attributes + " src=\"" + data_uri("image/png", model.picture) + "\" alt=\"" +
         escaped(model.alt) + "\">";
}

std::string view_markup(const ViewedModel& model, size_t index, bool moves,
                        const ViewerOptions& options) {
  const std::string id = "model" + std::to_string(index);
  std::string html = "<figure class=\"view\">";
  if (moves) {
    html += "<model-viewer data-model=\"" + id + "\" alt=\"" + escaped(model.alt) +
            "\" camera-controls touch-action=\"pan-y\" interaction-prompt=\"none\" "
            "environment-image=\"neutral\" tone-mapping=\"neutral\" shadow-intensity=\"0\" "
            "animation-crossfade-duration=\"0\"" +
            (options.turns ? " auto-rotate auto-rotate-delay=\"0\"" : "") + ">" +
            picture_of(model, " slot=\"poster\"") + "</model-viewer>";
  } else {
    html += "<div class=\"still\">" + picture_of(model, "") + "</div>";
  }
  if (!model.name.empty()) html += "<figcaption>" + escaped(model.name) + "</figcaption>";
  html += "</figure>\n";
  if (moves) {
    html += "<script type=\"text/plain\" id=\"" + id + "\">" +
            data_uri("model/gltf-binary", model.glb) + "</script>\n";
  }
  return html;
}

std::string surface_choice(const std::vector<ViewedSurface>& surfaces) {
  if (surfaces.size() < 2) return "";
  std::string html = "<fieldset class=\"surfaces\"><legend>Surface</legend>\n";
  for (size_t i = 0; i < surfaces.size(); ++i) {
    html += "<label><input type=\"radio\" name=\"surface\" value=\"" +
            escaped(surfaces[i].variant) + "\"" + (i == 0 ? " checked" : "") + "><span>" +
            escaped(surfaces[i].label) + "</span></label>\n";
  }
  return html + "</fieldset>\n";
}

constexpr char picture_choice[] =
    "<label class=\"own\">Your own image of the sphere: drop it on the model, or "
    "<input type=\"file\" id=\"own\" accept=\"image/png,image/jpeg,image/webp\"></label>\n";

/// Hidden until a model is there to be controlled.
std::string controls_markup(const std::vector<ViewedSurface>& surfaces,
                            const ViewerOptions& options) {
  const std::string from = escaped(options.ends.from), to = escaped(options.ends.to);
  return "<form class=\"controls\" hidden autocomplete=\"off\">\n"
         "<div class=\"morph\"><button type=\"button\" id=\"play\">Play</button>"
         "<label for=\"morph\">" +
         from +
         "</label>"
         "<input type=\"range\" id=\"morph\" min=\"0\" max=\"100\" step=\"any\" value=\"0\" "
         "data-rest=\"" +
         decimal(morph_rest_seconds, 3) + "\" data-change=\"" + decimal(morph_change_seconds, 3) +
         "\" data-from=\"" + from + "\" data-to=\"" + to + "\" aria-label=\"From " + from + " to " +
         to + "\" aria-valuetext=\"" + from + "\"><span aria-hidden=\"true\">" + to +
         "</span></div>\n" + surface_choice(surfaces) +
         (options.takes_pictures ? picture_choice : "") +
         "</form>\n<p class=\"hint\" id=\"viewer-message\" role=\"status\">"
         "Drag to turn, or use the arrow keys; pinch or scroll to come closer.</p>\n";
}

}  // namespace

std::string viewer_folder() {
  const std::filesystem::path program = program_path();
  if (program.empty()) return {};
  return program.parent_path().parent_path() / "share" / "sphparam" / "model-viewer";
}

std::optional<ViewerScript> installed_viewer() {
  const std::filesystem::path folder = viewer_folder();
  if (folder.empty()) return std::nullopt;
  ViewerScript script{bytes_of(folder / "model-viewer-umd.min.js"), bytes_of(folder / "LICENSE")};
  if (script.code.empty() || script.licence.empty()) return std::nullopt;
  return script;
}

std::string words_without_viewer(bool is_missing) {
  if (!is_missing) return "This page was made without the 3D viewer.";
  return std::string(
             "This page was made without the 3D viewer: the program that made it was built "
             "without it. CMake's ") +
         viewer_option + " brings it.";
}

void add_viewer(Page& page, const std::vector<ViewedModel>& models,
                const std::vector<ViewedSurface>& surfaces,
                const std::optional<ViewerScript>& script, const ViewerOptions& options) {
  const bool many = models.size() > 1;
  page.add_style(embedded::viewer_css);
  std::string html = "<div class=\"views" + std::string(many ? " many" : "") +
                     "\" style=\"grid-template-columns:repeat(auto-fit,minmax(min(100%,20rem),1fr))"
                     "\">\n";
  bool any_moves = false;
  for (size_t i = 0; i < models.size(); ++i) {
    const bool moves = script && !models[i].glb.empty();
    any_moves |= moves;
    html += view_markup(models[i], i, moves, options);
  }
  page.insert(html + "</div>\n");
  if (!any_moves) return;
  page.insert(controls_markup(surfaces, options));
  page.insert(
      "<noscript><p class=\"hint\">The 3D view needs scripts: this is a picture of it.</p>"
      "</noscript>\n");
  page.add_script(without_source_map(script->code));
  page.add_script(embedded::viewer_js);
}

}  // namespace sphparam
