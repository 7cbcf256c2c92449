#include "compare/comparison.h"

#include <algorithm>

#include "render/heat.h"
#include "report/plots.h"
#include "report/svg.h"
#include "sphparam/io/fillers.h"
#include "sphparam/words.h"

namespace sphparam {

namespace {

constexpr int chart_width = 480, picture_width = 220;  // least, on the page

std::vector<Face> folds_of(const Entry& entry) {
  std::vector<Face> faces = entry.certificate.folded;
  const std::vector<Face>& degenerate = entry.certificate.degenerate;
  faces.insert(faces.end(), degenerate.begin(), degenerate.end());
  return faces;
}

PageFigure heat_figure(FolderFiles& files, const std::string& name, const MeshFile& file,
                       const Entry& entry, const PictureOptions& look) {
  const bool has_fillers = !fillers_of(file).empty();  // they are on the sphere all the same
  const Distortion shown =
      has_fillers ? measure_distortion(file.mesh, entry.map, look.threads) : *entry.distortion;
  const Image sphere = sphere_picture(file, entry.map, heat_paint(Heat::Area, shown), look);
  files.emplace_back(name + ".png", png(with_legend(sphere, Heat::Area)));
  return {name + ".png",
          "Area distortion on the sphere of " + entry.name + ": mean |ln ratio| " +
              significant(entry.figures->mean_abs_ln_area),
          entry.name};
}

/// Lines for what the table has no room for.
std::vector<std::string> statements(const std::vector<Entry>& entries) {
  std::vector<std::string> lines;
  for (const Entry& c : entries) {
    std::string line = c.name + " (" + c.source + ")";
    if (c.iterations > 0) line += ", " + grouped(c.iterations) + " iterations";
    lines.push_back(line + (c.statement.empty() ? "" : ": " + c.statement) + ".");
  }
  return lines;
}

void add_pictures(Page& page, FolderFiles& files, const MeshFile& file,
                  const std::vector<Entry>& entries, const ComparisonOptions& options) {
  const PictureOptions& look = options.look;
  files.emplace_back("mesh.png",
                     png(mesh_picture(file, shape_paint(file, {}, options.textures), look)));
  std::vector<PageFigure> spheres = {{"mesh.png", "The mesh", "the mesh"}}, heats;
  for (const Entry& c : entries) {
    if (!c.distortion) continue;
    spheres.push_back(sphere_figure(files, "sphere-" + c.name, file, c, look, options.textures));
    heats.push_back(heat_figure(files, "area-" + c.name, file, c, look));
  }
  page.heading("Spheres side by side");
  page.paragraph(
      "Each sphere shows the side that corresponds to that of the mesh, in the mesh's colours; "
      "triangles that are folded are red.");
  page.figures(spheres, picture_width);
  page.paragraph("The same spheres coloured by area: blue has shrunk, red has grown.");
  page.figures(heats, picture_width);
}

void add_charts(Page& page, FolderFiles& files, const std::vector<Entry>& entries) {
  const Entry& ours = entries.front();
  if (entries.size() < 2 || !ours.distortion) return;
  page.heading("Polar charts");
  page.paragraph(
      "As the paper's figures 10 and 11: the radius is the distortion of a triangle or an angle, "
      "the polar angle its index, the green circle the optimum; right, a zoom on the optimal "
      "region. " +
      ours.name + " is blue.");
  for (size_t i = 1; i < entries.size(); ++i) {
    if (!entries[i].distortion) continue;
    page.subheading(ours.name + " against " + entries[i].name);
    add_polar_plots(page, files, "chart-" + entries[i].name, ours, entries[i]);
  }
}

}  // namespace

void add_polar_plots(Page& page, FolderFiles& files, const std::string& name, const Entry& ours,
                     const Entry& other) {
  const std::vector<PlotSeries> series = {{ours.name, &*ours.distortion},
                                          {other.name, &*other.distortion}};
  std::vector<PageFigure> figures;
  for (const PlotMeasure measure : {PlotMeasure::Area, PlotMeasure::Angle}) {
    const bool area = measure == PlotMeasure::Area;
    const std::string noun = area ? "area" : "angle";
    const auto mean = [&](const Entry& c) {
      const DistortionSummary& d = *c.figures;
      return area ? significant(d.mean_abs_ln_area)
                  : significant(d.mean_abs_ln_angle) + flat_images_words(d);
    };
    files.emplace_back(name + "-" + noun + ".svg", polar_plot(measure, series));
    figures.push_back({files.back().first,
                       "Polar chart of " + noun + " distortion: mean |ln ratio| of " + ours.name +
                           " is " + mean(ours) + ", of " + other.name + " " + mean(other),
                       ""});
  }
  page.figures(figures, chart_width);
}

PageFigure sphere_figure(FolderFiles& files, const std::string& name, const MeshFile& file,
                         const Entry& entry, const PictureOptions& look,
                         const MeshTextures& textures) {
  const Image image =
      sphere_picture(file, entry.map, shape_paint(file, folds_of(entry), textures), look);
  files.emplace_back(name + ".png", png(image));
  const std::string caption = entry.name + ": " + short_verdict(entry);
  return {name + ".png", "The sphere of " + caption, caption};
}

FolderFiles comparison_files(const std::string& name, const MeshFile& file,
                             const std::vector<Entry>& entries, const ComparisonOptions& options) {
  FolderFiles files;
  Page page("Spherical maps of " + name);
  page.paragraph(grouped(file.mesh.face_count()) + " triangles, " +
                 grouped(file.mesh.vertex_count()) + " vertices.");
  const FillerMarks fillers = fillers_of(file);
  const auto left_out = std::count(fillers.begin(), fillers.end(), 1);
  if (left_out > 0)
    page.paragraph("Distortion is that of the surface: " + grouped(left_out) +
                   " of the triangles close holes and are left out.");
  page.table(comparison_table(entries));
  page.list(statements(entries));
  if (options.pictures) add_pictures(page, files, file, entries, options);
  add_charts(page, files, entries);
  files.emplace_back("index.html", page.html());
  return files;
}

}  // namespace sphparam
