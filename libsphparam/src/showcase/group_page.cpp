// The mean and its deviations, the modes from end to end, all shapes in the colours of the
// correspondence, tables.

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "io/uri.h"
#include "number_text.h"
#include "report/page.h"
#include "sphparam/io/paths.h"
#include "sphparam/records/group_files.h"
#include "sphparam/render/coloured_values.h"
#include "sphparam/render/picture.h"

namespace sphparam {
namespace {

constexpr int panel_width = 220;             // least, on the page, in pixels
constexpr size_t most_pictures = 100;        // of shapes
constexpr Eigen::Index most_distances = 24;  // columns of a table that is read
constexpr double shown_deviations = 2;
constexpr char one_scale[] = "to one scale: the largest fills its picture";

constexpr char style[] =
    "h1,h3,p,li{overflow-wrap:anywhere}"
    "tbody tr>:first-child{white-space:normal;overflow-wrap:anywhere;min-width:7rem}";

/// x, y and z on the mean, from end to end, as red, green and blue.
void colour_by_place(const Points& mean, MeshFile& file) {
  constexpr double darkest = 40, brightest = 250;
  int axis = 0;
  remove_properties(file.vertex_properties, {"alpha"});  // of other colours
  for (const char* name : {"red", "green", "blue"}) {
    const double least = mean.col(axis).minCoeff(), length = mean.col(axis).maxCoeff() - least;
    Property colour{name, ScalarType::Uint8, {}};
    for (const double x : mean.col(axis))
      colour.values.push_back(
          std::round(darkest + (brightest - darkest) * (length > 0 ? (x - least) / length : 0.5)));
    file.set_vertex_property(std::move(colour));
    ++axis;
  }
}

class GroupPage {
 public:
  GroupPage(const GroupRecord& record, const GroupFileOptions& options)
      : record_(record),
        group_(record.group),
        options_(options),
        page_("A group of " + counted(static_cast<long>(record.names.size()), "shape")) {
    page_.add_style(style);
  }

  std::string html() {
    add_summary();
    if (options_.size > 0) add_mean();
    add_modes();
    if (options_.size > 0) add_shapes();
    add_tables();
    add_facts();
    return page_.html();
  }

 private:
  PageFigure picture(const MappedMesh& mesh, DrawingOptions drawing, const std::string& caption) {
    drawing.view = View::Mesh;
    drawing.up = options_.up;
    drawing.size = options_.size;
    drawing.threads = options_.threads;
    report(options_.progress, "pictures", 0);
    return {data_uri("image/png", draw_png(mesh.file(), mesh.map(), drawing)), caption, caption};
  }

  /// The same place has the same colour on all shapes: that of where it is on the mean.
  /// `height`: see `DrawingOptions`.
  PageFigure in_correspondence(const MappedMesh& mesh, const std::string& caption,
                               double height = 0) {
    MeshFile file = mesh.file();
    colour_by_place(group_.mean.mesh().positions, file);
    return picture(with_file(std::move(file)), {.graticule = true, .height = height}, caption);
  }

  /// Shapes that are to be held against each other, sizes among what differs: the largest fills its
  /// picture. Each is made twice, as there is no room for all of many.
  std::vector<PageFigure> to_one_scale(const std::vector<std::string>& captions,
                                       const std::function<MappedMesh(size_t)>& shape) {
    double height = 0;
    for (size_t i = 0; i < captions.size(); ++i)
      height = std::max(height, height_to_see(shape(i).file(), {.up = options_.up}));
    std::vector<PageFigure> figures;
    for (size_t i = 0; i < captions.size(); ++i)
      figures.push_back(in_correspondence(shape(i), captions[i], height));
    return figures;
  }

  void add_summary() {
    const std::vector<std::string> warnings = group_warnings(record_);
    page_.verdict(to_text(record_), true);
    const double size = size_of_mean(group_);
    page_.key_figures(
        {{"shapes", std::to_string(record_.names.size())},
         {"vertices in correspondence", std::to_string(group_.mean.mesh().vertex_count())},
         {"of the mean's size, RMS distance from it",
          percent(size > 0 ? rms_distance_from_mean(group_) / size : 0)}});
    if (!warnings.empty()) {
      page_.paragraph("To be looked at:");
      page_.list(warnings);
    }
    if (const std::vector<std::string> mended = mended_lines(record_); !mended.empty()) {
      page_.paragraph("Mended before they were mapped:");
      page_.list(mended);
    }
  }

  void add_mean() {
    page_.heading("Mean");
    std::vector<PageFigure> figures{in_correspondence(
        group_.mean, "The mean; colours are places on it, lines those of the sphere")};
    if (record_.names.size() > 1) {
      const auto deviation = [&](const VectorX& values, const char* name, const char* caption) {
        MeshFile file = with_coloured_values(group_.mean.file(), name, values);
        figures.push_back(picture(with_file(std::move(file)), {.scalar = name}, caption));
      };
      deviation(group_.deviation, "deviation", "Standard deviation of the shapes");
      deviation(group_.normal_deviation, "normal deviation", "Along the normal");
    }
    page_.figures(figures, panel_width);
  }

  MappedMesh with_file(MeshFile file) const {
    return MappedMesh(
        {.file = std::move(file), .map = group_.mean.map(), .topology = group_.mean.topology()}, 1);
  }

  void add_modes() {
    const std::vector<std::string> lines = mode_lines(record_);
    if (lines.empty()) return;
    page_.heading("Modes");
    if (options_.size > 0)
      page_.paragraph(std::string("The pictures of a mode are ") + one_scale + ".");
    const std::string ends = short_number(shown_deviations) + " deviations";
    for (size_t k = 0; k < lines.size(); ++k) {
      page_.subheading(lines[k]);
      if (options_.size == 0) continue;
      page_.figures(to_one_scale({"− " + ends, "mean", "+ " + ends},
                                 [&](size_t i) {
                                   const double steps = static_cast<double>(i) - 1;
                                   return group_shape(group_, static_cast<int>(k),
                                                      steps * shown_deviations);
                                 }),
                    panel_width);
    }
  }

  void add_shapes() {
    page_.heading("Shapes");
    page_.paragraph(std::string("Each as it lies on the mean, ") +
                    (record_.options.scale ? "brought to one size, " : "") + one_scale +
                    ". The same colour, and the same line, is the same place on all.");
    std::vector<std::string> captions = record_.names;
    captions.resize(std::min(captions.size(), most_pictures));
    page_.figures(to_one_scale(captions, [&](size_t i) { return aligned_shape(group_, i); }),
                  panel_width);
    if (record_.names.size() > most_pictures)
      page_.paragraph("The first " + std::to_string(most_pictures) + " of " +
                      std::to_string(record_.names.size()) + "; the others are in the table.");
  }

  void add_tables() {
    page_.heading("Figures");
    PageTable shapes{"Shapes",
                     {"shape", "begun with", "confidence", "energy", "size", "from the mean",
                      "off by resampling, RMS", "most"},
                     {},
                     {}};
    const Eigen::Index modes = group_.modes.scores.cols();
    for (Eigen::Index k = 0; k < modes; ++k)
      shapes.header.push_back("mode " + std::to_string(k + 1));
    for (size_t i = 0; i < record_.names.size(); ++i) {
      const GroupMember& member = group_.members[i];
      const std::string begun_with = member.start + (member.mirrored ? ", mirrored" : "");
      shapes.rows.push_back({record_.names[i], begun_with, short_number(member.confidence),
                             member.energy > 0 ? short_number(member.energy, 4) : "–",
                             short_number(member.size), short_number(distance_from_mean(group_, i)),
                             short_number(member.resampling_rms),
                             short_number(member.resampling_max)});
      for (Eigen::Index k = 0; k < modes; ++k)
        shapes.rows.back().push_back(
            short_number(group_.modes.scores(static_cast<Eigen::Index>(i), k)));
    }
    page_.table(shapes);
    if (group_.distances.cols() <= most_distances)
      page_.table(distances());
    else
      page_.paragraph("Distances of each two are in distances.tsv.");
  }

  PageTable distances() const {
    PageTable table{std::string("Distances of each two, RMS, ") +
                        (record_.options.scale ? "brought to one size, " : "") +
                        "moved and turned onto each other",
                    {"shape"},
                    {},
                    {}};
    for (const std::string& name : record_.names) table.header.push_back(name);
    for (Eigen::Index i = 0; i < group_.distances.rows(); ++i) {
      table.rows.push_back({record_.names[static_cast<size_t>(i)]});
      for (Eigen::Index j = 0; j < group_.distances.cols(); ++j)
        table.rows.back().push_back(i == j ? "–" : short_number(group_.distances(i, j)));
    }
    return table;
  }

  void add_facts() {
    page_.facts(
        {{"template", display_name(record_.reference)},
         {"brought to their mean",
          record_.options.hold ? "not: maps were held" : counted(record_.options.rounds, "time")},
         {"grid", grid_name(record_.options)},
         {"brought to one size", record_.options.scale ? "yes" : "no"},
         {"maps", "of all shapes certified one-to-one, as they are written"}});
  }

  const GroupRecord& record_;
  const Group& group_;
  const GroupFileOptions& options_;
  Page page_;
};

}  // namespace

std::string group_page(const GroupRecord& record, const GroupFileOptions& options) {
  return GroupPage(record, options).html();
}

}  // namespace sphparam
