#include "paper_figures.h"

#include <algorithm>
#include <string>

#include "report/svg.h"

namespace sphparam::samples {

namespace {

constexpr int least_width = 240;  // of a picture on the page
const Rgb patch_colour(0.95F, 0.62F, 0.15F), plain_colour(0.80F, 0.80F, 0.82F),
    fold_colour(0.85F, 0.05F, 0.08F);

struct Album {
  Page& page;
  FolderFiles& files;
  int size;  // pixels, of each side of a picture

  PageFigure add(const std::string& name, const Image& image, const std::string& alt,
                 const std::string& caption) {
    files.emplace_back(name + ".png", png(image));
    return {name + ".png", alt, caption};
  }
};

/// The models come from files with y up, the sample meshes have z up.
PictureOptions look_at(const Trial& trial, const Album& album) {
  const bool model = std::any_of(paper_models().begin(), paper_models().end(),
                                 [&](const PaperModel& m) { return m.name == trial.name; });
  const Up up = {.direction = model ? Vector3::UnitY() : Vector3::UnitZ()};
  PictureOptions look = seen_upright(upright_axes({}, up));
  look.size = album.size;
  return look;
}

const Trial& model_or_other(const std::vector<Trial>& trials, const std::string& name) {
  const auto found = std::find_if(trials.begin(), trials.end(),
                                  [&](const Trial& trial) { return trial.name == name; });
  return found == trials.end() ? trials.front() : *found;
}

std::string of_model(const Trial& trial, const std::string& wanted) {
  return trial.name == wanted ? trial.name
                              : trial.name + " (the paper shows " + wanted + ", which is not here)";
}

std::vector<Face> folds_of(const TriangleMesh& mesh, const SphereMap& map) {
  const Certificate certificate = certify(Topology(mesh), map);
  std::vector<Face> faces = certificate.folded;
  faces.insert(faces.end(), certificate.degenerate.begin(), certificate.degenerate.end());
  return faces;
}

PageFigure mesh_figure(Album album, const std::string& name, const Trial& trial,
                       const PictureOptions& look) {
  return album.add(name, mesh_picture(trial.file, shape_paint(trial.file, {}), look),
                   "The mesh " + trial.name, trial.name);
}

// --- the stages of the paper's method -----------------------------------------------------------

PageFigure step_figure(Album album, const std::string& name, const Trial& trial,
                       const PaperStep& step, const PictureOptions& look) {
  const std::vector<Face> folds = folds_of(trial.file.mesh, step.map);
  const std::string caption = step.name + ": " + grouped(step.folds) + " folds, angle " +
                              significant(step.figures.mean_abs_ln_angle) + ", area " +
                              significant(step.figures.mean_abs_ln_area);
  return album.add(name, sphere_picture(trial.file, step.map, shape_paint(trial.file, folds), look),
                   "Sphere of " + trial.name + " after " + caption, caption);
}

void add_figure_2(Album album, const std::vector<Trial>& trials) {
  const Trial& trial = model_or_other(trials, "homer");
  if (!trial.steps) return;
  const std::vector<PaperStep>& steps = trial.steps->printed;
  const PictureOptions look = look_at(trial, album);
  album.page.heading("Figure 2: the initial map and the secondary one");
  album.page.paragraph(
      of_model(trial, "homer") +
      ". The paper shows that limbs, which the initial map shrinks to points, develop in the "
      "secondary one. The figures below the spheres say by how much; folds are red.");
  std::vector<PageFigure> figures = {mesh_figure(album, "figure2-mesh", trial, look)};
  for (const size_t k : {size_t{0}, size_t{1}, size_t{3}}) {
    figures.push_back(
        step_figure(album, "figure2-step" + std::to_string(k), trial, steps[k], look));
  }
  album.page.figures(figures, least_width);
}

/// The patch in a colour, the folds in red, all else plain.
FacePaint patch_paint(const Trial& trial, const std::vector<Face>& folds) {
  FacePaint paint;
  paint.colours.assign(static_cast<size_t>(trial.file.mesh.face_count()), plain_colour);
  for (const Face f : trial.steps->patch) paint.colours[static_cast<size_t>(f)] = patch_colour;
  for (const Face f : folds) paint.colours[static_cast<size_t>(f)] = fold_colour;
  return paint;
}

void add_figure_5(Album album, const std::vector<Trial>& trials) {
  const Trial& trial = model_or_other(trials, "mannequin");
  if (!trial.steps) return;
  const std::vector<PaperStep>& steps = trial.steps->printed;
  PictureOptions look = look_at(trial, album);
  look.wireframe = true;
  look.size = std::min(album.size, 480);
  const Vector3 centre = trial.file.mesh.positions.colwise().mean();
  const Vector3 view = trial.steps->date_line_middle - centre;
  if (view.cross(look.up).norm() > 0) look.view = view;
  album.page.heading("Figure 5: before and after the local improvement");
  album.page.paragraph(trial.name +
                       ", seen from its date line. Orange: the five rings around it, which are "
                       "smoothed. The paper does not name its model.");
  std::vector<PageFigure> figures = {
      album.add("figure5-mesh", mesh_picture(trial.file, patch_paint(trial, {}), look),
                "The mesh with the patch around the date line in orange", trial.name)};
  for (const size_t k : {steps.size() - 2, steps.size() - 1}) {
    const PaperStep& step = steps[k];
    const FacePaint paint = patch_paint(trial, folds_of(trial.file.mesh, step.map));
    const std::string caption = std::string(k + 1 == steps.size() ? "after" : "before") +
                                ": in the patch angle " + significant(step.patch_angle) +
                                ", area " + significant(step.patch_area) + "; " +
                                grouped(step.folds) + " folds on the whole sphere";
    figures.push_back(album.add("figure5-step" + std::to_string(k),
                                sphere_picture(trial.file, step.map, paint, look),
                                "The patch on the sphere, " + caption, caption));
  }
  album.page.figures(figures, 320);
}

// --- against others -----------------------------------------------------------------------------

struct Opponent {
  const char* spheres;  // the number of the paper's figure
  const char* charts;
  const char* model;
  const char* method;
  const char* claim;
};

void add_opponent(Album album, const std::vector<Trial>& trials, const Opponent& opponent) {
  const Trial& trial = model_or_other(trials, opponent.model);
  const std::string tag = "figure" + std::string(opponent.spheres);
  const Entry& theirs = trial.by(opponent.method);
  album.page.heading("Figures " + std::string(opponent.spheres) + " and " + opponent.charts +
                     ": against " + opponent.method);
  album.page.paragraph(of_model(trial, opponent.model) + ". " + opponent.claim);
  PageTable table = comparison_table({theirs, trial.by("paper"), trial.by("progressive")});
  table.caption.clear();
  album.page.table(table);
  album.page.paragraph(theirs.name + " (" + theirs.source + "): " + theirs.statement + ".");
  const PictureOptions look = look_at(trial, album);
  std::vector<PageFigure> figures = {mesh_figure(album, tag + "-mesh", trial, look)};
  for (const char* name : {opponent.method, "paper", "progressive"}) {
    const Entry& entry = trial.by(name);
    if (!entry.distortion) continue;
    figures.push_back(sphere_figure(album.files, tag + "-" + name, trial.file, entry, look));
  }
  album.page.figures(figures, least_width);
  for (const char* ours : {"paper", "progressive"}) {
    if (!theirs.distortion || !trial.by(ours).distortion) continue;
    album.page.subheading(std::string("Blue: ") + ours + "; red: " + opponent.method);
    add_polar_plots(album.page, album.files, "figure" + std::string(opponent.charts) + "-" + ours,
                    trial.by(ours), theirs);
  }
}

// --- maps ----------------------------------------------------------------------------------------

void add_three_sides(Album album, const std::vector<Trial>& trials) {
  const Trial& trial = model_or_other(trials, "turtle");
  album.page.heading("Figure 8: from the front, the side and the back");
  album.page.paragraph(of_model(trial, "turtle") + ", mapped by the default method.");
  PictureOptions look = look_at(trial, album);
  const Vector3 front = Vector3(look.view - look.view.dot(look.up) * look.up).normalized();
  const std::pair<const char*, Vector3> sides[] = {
      {"front", front}, {"side", look.up.cross(front)}, {"back", -front}};
  std::vector<PageFigure> figures;
  const Paint paint = shape_paint(trial.file, {});
  for (const auto& [side, direction] : sides) {
    look.view = direction + 0.3 * look.up;
    const std::string name = "figure8-" + std::string(side), alt = trial.name + ", " + side;
    figures.push_back(
        album.add(name + "-mesh", mesh_picture(trial.file, paint, look), "The mesh " + alt, alt));
    figures.push_back(
        album.add(name, sphere_picture(trial.file, trial.by("progressive").map, paint, look),
                  "The sphere of " + alt, alt));
  }
  album.page.figures(figures, least_width);
}

void add_gallery(Album album, const std::vector<Trial>& trials) {
  album.page.heading("Figures 1, 3 and 9: models and their spheres");
  album.page.paragraph("By the paper's method as printed (folds in red), and by the default one.");
  std::vector<PageFigure> figures;
  for (const Trial& trial : trials) {
    const PictureOptions look = look_at(trial, album);
    figures.push_back(mesh_figure(album, "model-" + trial.name, trial, look));
    for (const char* name : {"paper", "progressive"}) {
      const Entry& entry = trial.by(name);
      if (!entry.distortion) continue;
      figures.push_back(
          sphere_figure(album.files, "model-" + trial.name + "-" + name, trial.file, entry, look));
    }
  }
  album.page.figures(figures, least_width);
}

}  // namespace

void add_figures(Page& page, FolderFiles& files, const std::vector<Trial>& trials,
                 int picture_size) {
  const Album album = {page, files, picture_size};
  add_figure_2(album, trials);
  add_figure_5(album, trials);
  add_opponent(album, trials,
               {"6", "10", "skull", "hemispheres",
                "The paper finds its own distortion closer to the optimum, and its map made in 5 "
                "seconds instead of 132."});
  add_opponent(album, trials,
               {"7", "11", "gargoyle", "tangential",
                "The paper finds its own distortion closer to the optimum than that of tangential "
                "smoothing with mean value weights."});
  add_three_sides(album, trials);
  add_gallery(album, trials);
}

}  // namespace sphparam::samples
