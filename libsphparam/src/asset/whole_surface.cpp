#include "sphparam/asset/whole_surface.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "asset/asset_words.h"
#include "asset/soup.h"
#include "io/attributes/authorship.h"
#include "io/attributes/remarks.h"
#include "io/inspected_source.h"
#include "mesh/box.h"
#include "mesh/triangle_geometry.h"
#include "number_text.h"
#include "option_domain.h"
#include "sphparam/chart/spherical_chart.h"
#include "sphparam/errors.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/repair_advice.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/io/upright_frame.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/records/wrap_record.h"
#include "sphparam/sphere/sphere_share.h"
#include "sphparam/words.h"

namespace sphparam {
namespace {

constexpr char wrap_comment[] = "wrapped about ";
constexpr double gap_share = 0.1;  // of the distance of a wrap, that is left of it

/// Whether a closed surface encloses hardly anything: its two sides would lie in one another.
bool is_flat(const TriangleMesh& mesh) {
  constexpr double hardly = 1e-4;
  const Vector3 centre = mesh.positions.colwise().mean();
  double volume = 0, area = 0;
  for (const auto& f : mesh.triangles.rowwise()) {
    const Vector3 a = mesh.position(f[0]) - centre, b = mesh.position(f[1]) - centre,
                  c = mesh.position(f[2]) - centre;
    volume += a.dot(b.cross(c)) / 6;
    area += triangle_area(a, b, c);
  }
  return std::abs(volume) <= hardly * area * std::sqrt(area);
}

/// The faces of a wrap that are farther from what it is about than its distance explains.
FillerMarks far_faces(const Wrap& wrap) {
  const double far = wrap.distance + 1.5 * wrap.voxel;
  FillerMarks marks;
  for (const auto& f : wrap.mesh.triangles.rowwise())
    marks.push_back(wrap.apart.forth.at_vertices(f.transpose(), Eigen::all).minCoeff() > far);
  return marks;
}

double area_share(const TriangleMesh& mesh, const FillerMarks& marked) {
  double all = 0, theirs = 0;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const double area = face_area(mesh, f);
    all += area;
    if (marked[static_cast<size_t>(f)]) theirs += area;
  }
  return theirs / all;
}

/// Maps closed surfaces, each way with what it tells.
class Chooser {
 public:
  Chooser(const MeshSource& asset, const WholeOptions& options)
      : asset_(asset), options_(options) {}

  WholeSurface choose() {
    if (is_mappable(asset_)) {
      if (auto mapped = mapped_with_chart(asset_))
        return whole(*std::move(mapped), WholeBy::Itself);
    } else {
      tell_defects();
      if (auto mended = mended_whole()) return *std::move(mended);
    }
    return wrapped();
  }

 private:
  WholeSurface whole(MappedMesh mapped, WholeBy by, double area_kept = 1) {
    return {std::move(mapped),  by, area_kept, std::move(found_), std::move(done_),
            std::move(details_)};
  }

  void tell_defects() {
    for (const MeshDefect& defect : asset_.inspection.defects) {
      if (!defect.fatal) continue;
      found_.push_back(plain_words(defect, asset_.inspection));
      details_.push_back(defect.message);
    }
  }

  /// Nothing where a texture could not lie on it, however it stands.
  std::optional<MappedMesh> mapped_with_chart(MeshSource source) {
    LoadOptions load;
    load.map.threads = options_.threads;
    load.map.progress = options_.progress;
    if (options_.upright && source.topology && !read_sphere(source.file)) {
      LoadOptions upright = load;
      upright.map = with_upright_frame(load.map, source.file.mesh, *source.topology,
                                       upright_axes(source.file));
      if (auto mapped = with_chart(told_upright(mapped_mesh(source, upright)))) return mapped;
      details_.emplace_back("top and bottom are not at the poles: the map would be too thin there");
    }
    MappedMesh mapped = mapped_mesh(std::move(source), load);
    if (options_.upright) mapped = told_upright(mapped);
    if (auto charted = with_chart(mapped)) return charted;
    found_.emplace_back("its map is thinner in (u, v) than doubles can tell");
    return std::nullopt;
  }

  /// All stages that follow want the chart, which may take longer than the map.
  std::optional<MappedMesh> with_chart(const MappedMesh& mapped) const {
    MappedMesh charted = mapped.with_chart(options_.threads, options_.progress);
    if (charted.chart()->certificate.one_to_one()) return charted;
    return std::nullopt;
  }

  /// Says among the lines on the map that it stands as the mesh does, where it does.
  static MappedMesh told_upright(const MappedMesh& mapped) {
    const std::string words =
        upright_words(mapped.map(), mapped.mesh(), mapped.topology(), upright_axes(mapped.file()));
    Provenance lines = mapped.provenance();
    if (words.empty() || map_is_upright(lines, upright_axes(mapped.file()))) return mapped;
    lines.insert(lines.empty() ? lines.end() : lines.end() - 1, {"upright", words});
    return mapped.with_map(mapped.map(), std::move(lines));
  }

  bool keeps_enough(const RepairTrial& trial) const {
    return trial.parts.area_share >= options_.least_kept;
  }

  /// A weld is tried where pieces would be lost, as programs that round each material's vertices
  /// apart from the others' leave them.
  UnaskedRepair unasked_or_welded() const {
    UnaskedRepair unasked = try_repair_unasked(asset_);
    if (unasked.mended && keeps_enough(unasked.trial)) return unasked;
    UnaskedRepair welded = try_weld(asset_);
    return welded.mended && keeps_enough(welded.trial) ? welded : unasked;
  }

  std::optional<WholeSurface> mended_whole() {
    auto [trial, repaired] = unasked_or_welded();
    if (!repaired) return std::nullopt;
    if (!keeps_enough(trial)) {
      found_.push_back("repair would keep " + percent(trial.parts.area_share, 5) +
                       " of the area and " + percent(trial.parts.face_share, 5) + " of the faces");
      return std::nullopt;
    }
    MeshSource& mended = *repaired;
    if (is_flat(mended.file.mesh)) {
      found_.emplace_back("mended, it would enclose nothing");
      return std::nullopt;
    }
    std::vector<std::string> losses;
    mended.file = written_as_mended(mended, losses);
    std::optional<MappedMesh> mapped = mapped_with_chart(std::move(mended));
    if (!mapped) return std::nullopt;
    for (const RepairAction& action : trial.actions) {
      done_.push_back(plain_words(action));
      details_.push_back(action.message);
    }
    WholeSurface made = whole(*std::move(mapped), WholeBy::Repair, trial.parts.area_share);
    made.repairs = trial.actions;
    return made;
  }

  WholeSurface wrapped() {
    const MeshFile file = with_places(asset_);
    if (file.mesh.face_count() == 0) throw MeshError(inspect_mesh(file.mesh).defects);
    const Wrap wrap = wrap_soup(file.mesh, wrap_options(file.mesh));
    MeshFile bare;  // all that it carries is baked
    bare.mesh = file.mesh;
    done_ = plain_words(wrap, longest_side(file.mesh));
    std::ranges::copy(to_lines(WrapRecord{asset_.path, bare, wrap}), std::back_inserter(details_));
    if (const auto crossings = crossings_of(wrap, options_.threads); crossings)
      details_.push_back(counted(crossings->faces, "triangle crosses", "triangles cross") +
                         " others of the wrap");
    MeshSource source;
    source.path = asset_.path;
    source.file.mesh = wrap.mesh;
    source.file.comments = {wrap_comment + display_name(asset_.path)};
    std::ranges::copy(remarks_of(file), std::back_inserter(source.file.comments));
    take_up(source.file, file);
    take_authorship(source.file, file);
    source.inspection = inspect_mesh(wrap.mesh);
    source.topology.emplace(wrap.mesh);
    std::optional<MappedMesh> mapped = mapped_with_chart(std::move(source));
    if (!mapped)
      throw NotCertifiedError(
          asset_.path + ": the chart of its wrap is not one-to-one: another --resolution may do");
    tell_walls(wrap, *mapped);
    return whole(*std::move(mapped), WholeBy::Wrap);
  }

  /// Thin bridges have as much of the map as their length wants: what that takes from the parts.
  void tell_walls(const Wrap& wrap, const MappedMesh& mapped) {
    constexpr double much = 0.05;
    const FillerMarks walls = far_faces(wrap);
    const double of_map = sphere_share(wrap.mesh.triangles, mapped.map(), walls);
    if (of_map < much) return;
    done_.push_back(
        "what joins and closes it so is " + percent(area_share(wrap.mesh, walls)) +
        " of its area, and takes " + percent(of_map) + " of the map and " +
        percent(static_cast<double>(std::ranges::count(walls, 1)) /
                static_cast<double>(walls.size())) +
        " of the triangles" +
        (wrap.parts > 1 ? ": `map --all-components` gives each part a map of its own" : ""));
  }

  WrapOptions wrap_options(const TriangleMesh& mesh) const {
    WrapOptions wrap{.resolution = options_.resolution,
                     .faces = options_.faces,
                     .threads = options_.threads,
                     .progress = options_.progress};
    // Beyond it the mesh is too large, which `wrap_soup` says of it rather than of a voxel.
    constexpr double largest = 1e70;
    wrap.voxel = wrap.distance = std::min(longest_side(mesh) / options_.resolution, largest);
    wrap.gap = gap_share * wrap.distance;
    return wrap;
  }

  const MeshSource& asset_;
  const WholeOptions& options_;
  std::vector<std::string> found_, done_, details_;
};

}  // namespace

const char* word_of(WholeBy by) {
  switch (by) {
    case WholeBy::Itself:
      return "itself";
    case WholeBy::Repair:
      return "repair";
    default:
      return "wrap";
  }
}

WholeSurface whole_surface(const MeshSource& asset, const WholeOptions& options) {
  require_at_least("resolution", options.resolution, 8);
  require_at_least("faces", static_cast<double>(options.faces), 0);
  require_between("least_kept", options.least_kept, 0, 1);
  if (!is_inspected(asset)) return Chooser(inspected(asset), options).choose();
  return Chooser(asset, options).choose();
}

}  // namespace sphparam
