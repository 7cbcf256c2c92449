#include "showcase/report_page.h"

#include <algorithm>

#include "bake/bake_scene.h"
#include "embedded/report_page.css.h"
#include "gltf/painted_surfaces.h"
#include "io/attributes/shading_normals.h"
#include "io/uri.h"
#include "render/added_outline.h"
#include "render/heat.h"
#include "report/plots.h"
#include "report/svg.h"
#include "showcase/heat_key.h"
#include "showcase/model.h"
#include "showcase/tables.h"
#include "sphparam/errors.h"
#include "sphparam/io/fillers.h"
#include "sphparam/render/picture.h"
#include "sphparam/words.h"

// What is largest comes first on the page and last to be thought of: models and images are made map
// by map, each from one baked scene; then the page is written from top to bottom.

namespace sphparam {
namespace {

constexpr int panel_width = 300, heat_width = 420;  // least, on the page, in pixels

/// What is made of one map.
struct Shown {
  ViewedModel model;
  std::vector<ViewedSurface> surfaces;
  std::vector<PageFigure> heat_maps;
};

class Reporter {
 public:
  Reporter(const std::string& name, const MeshFile& file, const std::vector<PageEntry>& entries,
           const ReportOptions& options)
      : name_(name), file_(file), entries_(entries), options_(options) {}

  std::string html() {
    Page page("Spherical map" + std::string(many() ? "s" : "") + " of " + name_);
    page.add_style(embedded::report_page_css);
    lead(page);
    views(page);
    repairs(page);
    charts(page);
    tables(page);
    provenance(page);
    return page.html();
  }

 private:
  bool many() const { return entries_.size() > 1; }

  // --- the top of the page ---

  void lead(Page& page) {
    const Entry& first = entries_.front().entry;
    const std::string size = grouped(file_.mesh.face_count()) + " triangles, " +
                             grouped(file_.mesh.vertex_count()) + " vertices";
    if (many()) {
      page.paragraph(std::to_string(entries_.size()) + " maps of one mesh of " + size +
                     ", side by side. All charts have the same scale.");
      return;
    }
    const bool good = first.certificate.bijective();
    page.verdict(good ? "Certified one-to-one" : "Not one-to-one: " + short_verdict(first), good);
    if (!first.figures) return page.paragraph(size + ".");
    const DistortionSummary& d = *first.figures;
    page.key_figures({{"triangles", grouped(file_.mesh.face_count())},
                      {"vertices", grouped(file_.mesh.vertex_count())},
                      {"mean |ln area|", significant(d.mean_abs_ln_area)},
                      {"mean |ln angle|", significant(d.mean_abs_ln_angle) + flat_images_words(d)},
                      {"areas within [½, 2]", decimal(100 * d.area_within_two, 1) + " %"}});
  }

  // --- models and images ---

  std::string about(const PageEntry& page_entry) const {
    const Entry& c = page_entry.entry;
    std::string text = c.name + ": " + short_verdict(c);
    if (c.figures) {
      text += ", mean |ln area| " + significant(c.figures->mean_abs_ln_area) + ", |ln angle| " +
              significant(c.figures->mean_abs_ln_angle) + flat_images_words(*c.figures);
    }
    return text;
  }

  PictureOptions look() const {
    PictureOptions look = options_.look;
    look.threads = options_.threads;
    look.transparent = true;  // the page is light or dark
    return look;
  }

  BakeScene scene_of(const PageEntry& page_entry) const {
    const MappedMesh mapped({.file = file_, .map = page_entry.entry.map}, options_.threads);
    return {.source = {mapped, shading_normals(file_), options_.textures.of_materials,
                       options_.textures.one_for_all},
            .target = *page_entry.target,
            .options = {.heat = true},
            .threads = options_.threads};
  }

  PageFigure heat_figure(const PageEntry& page_entry, Heat heat, const Image& image) const {
    const bool is_area = heat == Heat::Area;
    const Entry& c = page_entry.entry;
    const std::string noun = is_area ? "Area" : "Angle";
    const double mean = is_area ? c.figures->mean_abs_ln_area : c.figures->mean_abs_ln_angle;
    return {data_uri("image/png", png(image)),
            noun + " distortion of " + c.name + " over the whole sphere: mean |ln ratio| " +
                significant(mean) + (is_area ? "" : flat_images_words(*c.figures)),
            (many() ? c.name + ": " : "") + noun + " distortion"};
  }

  /// Where repair has closed the surface, if it has.
  void repairs(Page& page) {
    const MeshFile surface = without_fillers(file_);
    if (!added_outline(surface)) return;
    page.heading("What repair has closed");
    page.paragraph(
        "Loops along which handles were cut, and rims of holes that were filled, in red.");
    const std::string picture = draw_png(surface, std::nullopt,
                                         {.view = View::Mesh,
                                          .colouring = Colouring::Plain,
                                          .from = options_.look.view,
                                          .up = {options_.up.up, options_.up.front},
                                          .repairs = true,
                                          .size = options_.look.size,
                                          .threads = options_.threads});
    page.figures({{data_uri("image/png", picture), "The mesh with what repair has closed outlined",
                   "The mesh"}},
                 panel_width);
  }

  std::string mesh_png() const {
    return png(mesh_picture(file_, shape_paint(file_, {}, options_.textures), look()));
  }

  ViewedModel sphere_view(const PageEntry& page_entry) const {
    std::vector<Face> folds = page_entry.entry.certificate.folded;
    const std::vector<Face>& flat = page_entry.entry.certificate.degenerate;
    folds.insert(folds.end(), flat.begin(), flat.end());
    ViewedModel view{.name = many() || !page_entry.entry.certificate.bijective() ? about(page_entry)
                                                                                 : "Its sphere",
                     .alt = "The sphere of " + about(page_entry),
                     .glb = "",
                     .picture = ""};
    if (page_entry.entry.distortion) {
      const Paint paint = shape_paint(file_, folds, options_.textures);
      view.picture = png(sphere_picture(file_, page_entry.entry.map, paint, look()));
    }
    return view;
  }

  Shown show(const PageEntry& page_entry) const {
    const bool certified = page_entry.chart() && page_entry.chart()->certificate.one_to_one();
    Shown shown;
    if (!certified || !options_.viewer) shown.model = sphere_view(page_entry);
    if (!certified) return shown;
    const BakeScene scene = scene_of(page_entry);
    const std::vector<PaintedSurface> surfaces =
        painted_surfaces(scene, options_.image_width, options_.progress);
    for (const PaintedSurface& surface : surfaces) {
      shown.surfaces.push_back({surface.name, surface.label});
      for (const Heat heat : {Heat::Area, Heat::Angle}) {
        if (surface.name != (heat == Heat::Area ? "area" : "angle")) continue;
        shown.heat_maps.push_back(heat_figure(page_entry, heat, surface.image));
      }
    }
    if (options_.viewer) {
      shown.model = {.name = many() ? about(page_entry) : "",
                     .alt = "Model of " + name_ + " that changes from the mesh to its sphere",
                     .glb = showcase_model(name_, file_, *page_entry.chart(), scene.source.normals,
                                           surfaces, options_.up, options_.threads),
                     .picture = mesh_png()};
    }
    return shown;
  }

  void views(Page& page) {
    std::vector<ViewedModel> models;
    std::vector<ViewedSurface> surfaces;
    std::vector<PageFigure> heat_maps;
    double done = 0;
    for (const PageEntry& page_entry : entries_) {
      if (options_.progress &&
          !options_.progress("page", done++ / static_cast<double>(entries_.size()))) {
        throw Cancelled();
      }
      Shown shown = show(page_entry);
      models.push_back(std::move(shown.model));
      if (surfaces.empty()) surfaces = std::move(shown.surfaces);
      std::move(shown.heat_maps.begin(), shown.heat_maps.end(), std::back_inserter(heat_maps));
    }
    if (std::ranges::all_of(models, [](const ViewedModel& model) { return model.glb.empty(); })) {
      models.insert(
          models.begin(),
          {.name = "The mesh", .alt = "The mesh " + name_, .glb = "", .picture = mesh_png()});
    }
    add_viewer(page, models, surfaces, options_.viewer);
    if (!options_.viewer)
      page.insert("<p class=\"hint\">" + escaped(words_without_viewer(options_.viewer_is_missing)) +
                  "</p>\n");
    if (heat_maps.empty()) return;
    page.heading("Distortion over the sphere");
    page.paragraph(
        "Longitude runs from left to right and the poles are above and below. Areas: blue has "
        "shrunk, red has grown on the sphere. Angles: the factor by which they are off, from dark "
        "to yellow.");
    page.insert("<div class=\"heat-keys\">\n" + heat_key(Heat::Area) + heat_key(Heat::Angle) +
                "</div>\n");
    page.figures(heat_maps, heat_width);
  }

  // --- charts ---

  void charts(Page& page) {
    std::vector<PlotSeries> all;
    for (const PageEntry& page_entry : entries_) {
      const Entry& c = page_entry.entry;
      if (c.distortion) all.push_back({many() ? c.name : "", &*c.distortion});
    }
    if (all.empty()) return;
    page.heading("Polar charts and histograms");
    page.paragraph(
        "As the paper's figures 10 and 11: the radius is the ratio of a triangle or an angle, the "
        "polar angle its index, and the green circle is the optimum. Beside each a zoom on the "
        "optimal region, and how the ratios are spread.");
    for (const PlotSeries& series : all) {
      if (many()) page.subheading(series.label);
      for (const PlotMeasure measure : {PlotMeasure::Area, PlotMeasure::Angle}) {
        std::vector<PlotPanel> panels = polar_panels(measure, series, all);
        panels.push_back(histogram_panel(measure, series, all));
        std::vector<PageFigure> figures;
        for (const PlotPanel& panel : panels) {
          figures.push_back({data_uri("image/svg+xml", panel.svg),
                             (many() ? series.label + ": " : "") + panel.title, panel.note});
        }
        page.figures(figures, panel_width);
      }
    }
  }

  // --- the rest ---

  void tables(Page& page) {
    page.heading("Figures");
    const std::vector<PageTable> tables = {distortion_table(entries_), certificate_table(entries_),
                                           chart_table(entries_)};
    const std::string least = std::to_string(15 + 6 * entries_.size()) + "rem";
    page.insert(
        "<div class=\"tables\" style=\"grid-template-columns:repeat(auto-fit,minmax(min(100%," +
        least + "),1fr))\">\n");
    for (const PageTable& table : tables) {
      if (table.rows.empty()) continue;
      page.insert("<div>\n");
      page.table(table);
      page.insert("</div>\n");
    }
    page.insert("</div>\n");
  }

  void provenance(Page& page) {
    page.heading("Provenance");
    page.facts(options_.facts);
    const PageTable table = provenance_table(entries_);
    if (!table.rows.empty()) page.table(table);
    if (!options_.viewer) return;
    page.folded_text("Licence of the 3D viewer, <model-viewer>", options_.viewer->licence);
  }

  const std::string& name_;
  const MeshFile& file_;
  const std::vector<PageEntry>& entries_;
  const ReportOptions& options_;
};

}  // namespace

std::string report_page(const std::string& name, const MeshFile& file,
                        const std::vector<PageEntry>& entries, const ReportOptions& options) {
  return Reporter(name, file, entries, options).html();
}

}  // namespace sphparam
