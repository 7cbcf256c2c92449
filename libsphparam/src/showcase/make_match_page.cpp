
#include "compare/pictures.h"
#include "embedded/report_page.css.h"
#include "io/uri.h"
#include "number_text.h"
#include "option_domain.h"
#include "report/plots.h"
#include "report/svg.h"
#include "showcase/heat_key.h"
#include "showcase/match_model.h"
#include "showcase/match_pictures.h"
#include "showcase/tables.h"
#include "sphparam/errors.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/paths.h"
#include "sphparam/report/match_page.h"
#include "sphparam/words.h"

// A match is a Distortion of each of its two ways, and tables of maps take it as one.

namespace sphparam {
namespace {

constexpr int picture_width = 420, panel_width = 300;  // least, on the page, in pixels

PairLook pair_look(const SurfaceMap& map, const MatchPageOptions& options) {
  const PictureOptions look = seen_upright(upright_axes(map.from().file(), options.up));
  return {.view = look.view,
          .up = look.up,
          .size = options.size / 2,
          .background = std::nullopt,
          .threads = options.threads};
}

std::vector<Vertex> firsts_of(const std::vector<LandmarkPair>& landmarks) {
  std::vector<Vertex> firsts;
  for (const LandmarkPair& pair : landmarks) firsts.push_back(pair.from);
  return firsts;
}

/// A map that tables of maps take.
PageEntry entry_of(const std::string& name, const Distortion& distortion, int threads) {
  Entry entry{.name = name, .source = {}};
  entry.figures = summarise(distortion, threads);
  return {std::move(entry), {}, std::nullopt};
}

class MatchReporter {
 public:
  MatchReporter(const Match& match, const MatchPageOptions& options)
      : match_(match),
        options_(options),
        first_(stem_of(match.map.from().name())),
        second_(stem_of(match.map.to().name())),
        numbers_of_first_(match.map.from().file()),
        numbers_of_second_(match.map.to().file()),
        pictures_(match.map, firsts_of(options.landmarks), pair_look(match.map, options)),
        back_(measure_distortion(match.map.inverse(), options.threads)),
        surfaces_png_(png(pictures_.graticules())) {}

  std::string html() {
    Page page(first_ + " → " + second_);
    page.add_style(embedded::report_page_css);
    lead(page);
    view(page);
    places(page);
    graticules(page);
    distortion(page);
    figures(page);
    page.heading("Provenance");
    page.facts(options_.facts);
    if (viewer_) page.folded_text("Licence of the 3D viewer, <model-viewer>", viewer_->licence);
    return page.html();
  }

 private:
  void step(double part) const { report(options_.progress, "page", part); }

  void lead(Page& page) {
    const DistortionSummary d = summarise(pictures_.distortion(), options_.threads);
    const bool doubtful = !match_.warnings.empty();
    page.verdict(doubtful ? "One-to-one and certified, but doubtful: see below"
                          : "One-to-one: both maps are certified",
                 !doubtful);
    std::vector<std::pair<std::string, std::string>> key = {
        {"mean |ln area|", significant(d.mean_abs_ln_area)},
        {"mean |ln angle|", significant(d.mean_abs_ln_angle) + flat_images_words(d)},
        {"areas within [½, 2]", decimal(100 * d.area_within_two, 1) + " %"}};
    if (!options_.landmarks.empty())
      key.emplace_back("landmarks, exact", std::to_string(options_.landmarks.size()));
    if (!match_.suggestions.empty())
      key.emplace_back("confidence", short_number(match_.confidence));
    page.key_figures(key);
    if (!match_.warnings.empty()) page.list(match_.warnings);
  }

  static PageFigure figure(const std::string& png, const std::string& alt,
                           const std::string& caption) {
    return {data_uri("image/png", png), alt, caption};
  }
  static PageFigure figure(const Image& image, const std::string& alt, const std::string& caption) {
    return figure(png(image), alt, caption);
  }

  // --- the model ---

  void view(Page& page) {
    step(0);
    if (options_.viewer) viewer_ = installed_viewer();
    if (!viewer_) {
      page.paragraph(words_without_viewer(options_.viewer));
      return;
    }
    ExportOptions exported{
        .up = options_.up, .threads = options_.threads, .progress = options_.progress};
    exported.look.image_width = options_.size;
    const MatchModel made = match_model(match_.map, pictures_.distortion(), exported);
    const ViewedModel model{.name = "",
                            .alt = "Model of " + first_ + " that turns into " + second_,
                            .glb = made.glb,
                            .picture = surfaces_png_};
    add_viewer(page, {model}, made.surfaces, viewer_, {.ends = {first_, second_}});
    if (!made.warnings.empty()) page.list(made.warnings);
  }

  // --- pictures ---

  void places(Page& page) {
    step(0.3);
    page.heading("What corresponds");
    page.paragraph("Left " + first_ + ", right " + second_ +
                   ", turned, moved and scaled to the same area. What belongs together has the "
                   "same colour, which says where it lies on " +
                   second_ + "; lines link " + std::to_string(pictures_.link_count()) +
                   " points, as far as they face the eye on both.");
    page.figures({figure(pictures_.places(false), "Corresponding points", "From in front"),
                  figure(pictures_.places(true), "Corresponding points", "From behind")},
                 picture_width);
  }

  void graticules(Page& page) {
    step(0.5);
    page.heading("One sphere for both");
    page.paragraph(
        "Lines of longitude and latitude every 15°, the date line red: they are the same on both. "
        "Below, the spheres that both were mapped to, in the colours of above.");
    page.figures({figure(surfaces_png_, "Both with the same graticule", "The surfaces"),
                  figure(pictures_.spheres(), "Both spheres", "Their spheres")},
                 picture_width);
  }

  void distortion(Page& page) {
    step(0.7);
    page.heading("Distortion");
    page.paragraph("Of each triangle of " + first_ + " as it lies on " + second_ +
                   ". Areas: blue has shrunk there, red has grown. Angles: the factor by which "
                   "they are off, from dark to yellow.");
    page.insert("<div class=\"heat-keys\">\n" + heat_key(Heat::Area) + heat_key(Heat::Angle) +
                "</div>\n");
    std::vector<PageFigure> heats;
    for (const Heat heat : {Heat::Area, Heat::Angle}) {
      const std::string noun = heat == Heat::Area ? "Areas" : "Angles";
      heats.push_back(figure(pictures_.heat(heat, false), noun, noun + ", from in front"));
      heats.push_back(figure(pictures_.heat(heat, true), noun, noun + ", from behind"));
    }
    page.figures(heats, picture_width);
    const PlotSeries series{"", &pictures_.distortion()};
    std::vector<PageFigure> panels;
    for (const PlotMeasure measure : {PlotMeasure::Area, PlotMeasure::Angle}) {
      const PlotPanel panel = histogram_panel(measure, series);
      panels.push_back({data_uri("image/svg+xml", panel.svg), panel.title, panel.note});
    }
    page.figures(panels, panel_width);
  }

  // --- tables ---

  void figures(Page& page) {
    step(0.9);
    page.heading("Figures");
    page.table(distortion_table(
        {entry_of(first_ + " → " + second_, pictures_.distortion(), options_.threads),
         entry_of(second_ + " → " + first_, back_, options_.threads)}));
    if (!options_.landmarks.empty()) page.table(landmark_table());
    if (!match_.suggestions.empty()) page.table(suggestion_table());
  }

  std::pair<std::string, std::string> numbers(const LandmarkPair& pair) const {
    return {std::to_string(numbers_of_first_.number(pair.from)),
            std::to_string(numbers_of_second_.number(pair.to))};
  }

  PageTable landmark_table() const {
    PageTable table{
        "Landmarks, by the numbers of vertices in the files, from 0.", {first_, second_}, {}};
    for (const LandmarkPair& pair : options_.landmarks) {
      const auto [from, to] = numbers(pair);
      table.rows.push_back({from, to});
    }
    return table;
  }

  PageTable suggestion_table() const {
    PageTable table{
        "Ends that were paired, the likeliest first, with which it began: the vertex of " + first_ +
            " and that of " + second_ +
            ", the energy of a coarse map, the correlation of curvatures, that of places in space "
            "where these count, and the score of all: the less, the better.",
        {"pairs", "energy", "curvatures", "places", "score"},
        {}};
    for (const SuggestedLandmarks& suggestion : match_.suggestions) {
      std::vector<std::string> pairs;
      for (const LandmarkPair& pair : suggestion.landmarks) {
        const auto [from, to] = numbers(pair);
        pairs.push_back(from + " – " + to);
      }
      table.rows.push_back(
          {joined(pairs), significant(suggestion.energy), significant(suggestion.agreement),
           significant(suggestion.place_agreement), significant(suggestion.score)});
    }
    return table;
  }

  const Match& match_;
  const MatchPageOptions& options_;
  std::string first_, second_;
  FileNumbers numbers_of_first_, numbers_of_second_;
  MatchPictures pictures_;
  Distortion back_;
  std::string surfaces_png_;  // both with the graticule
  std::optional<ViewerScript> viewer_;
};

}  // namespace

std::string make_match_page(const Match& match, const MatchPageOptions& options) {
  require_between("size", options.size, 64, 8192);
  if (options.size % 4 != 0) refuse_option("size", options.size, "a multiple of 4");
  return MatchReporter(match, options).html();
}

}  // namespace sphparam
