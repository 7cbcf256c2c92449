// What OpenSubdiv is told of the faces, and what it is asked for; patches are in limit_patch.cpp.

#include "sphparam/remesh/limit_surface.h"

#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <optional>
#include <stdexcept>
#include <string>

#include "remesh/subdivision/limit_runs.h"
#include "remesh/subdivision/limit_tables.h"
#include "sphparam/parallel.h"

namespace sphparam {

namespace {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

constexpr std::int64_t grain = 2048;
constexpr int isolation_levels = 6;  // about vertices of unusual valence, before Gregory patches

std::unique_ptr<Far::TopologyRefiner> make_refiner(const Polygons& faces, int vertex_count,
                                                   Scheme scheme) {
  std::vector<int> degrees(static_cast<size_t>(faces.count()));
  for (size_t f = 0; f < degrees.size(); ++f)
    degrees[f] = faces.degree(static_cast<std::int64_t>(f));
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = vertex_count;
  descriptor.numFaces = static_cast<int>(degrees.size());
  descriptor.numVertsPerFace = degrees.data();
  descriptor.vertIndicesPerFace = faces.corners.data();
  using RefinerFactory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  const auto type = scheme == Scheme::Loop ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK;
  std::unique_ptr<Far::TopologyRefiner> refiner(
      RefinerFactory::Create(descriptor, RefinerFactory::Options(type, Sdc::Options())));
  if (!refiner) throw std::invalid_argument("OpenSubdiv refuses these faces");
  return refiner;
}

Bfr::SurfaceFactory::Options factory_options() {
  Bfr::SurfaceFactory::Options options;
  options.SetApproxLevelSmooth(isolation_levels);
  return options;
}

void check(const Polygons& faces, int vertex_count, Scheme scheme) {
  std::vector<int> about(static_cast<size_t>(vertex_count), 0);
  for (const int v : faces.corners) {
    if (v < 0 || v >= vertex_count) {
      throw std::invalid_argument("a face has vertex " + std::to_string(v) + " of " +
                                  std::to_string(vertex_count));
    }
    if (++about[static_cast<size_t>(v)] > LimitTopology::most_faces_about_a_vertex) {
      throw std::invalid_argument(
          "more than " + std::to_string(LimitTopology::most_faces_about_a_vertex) +
          " faces about vertex " + std::to_string(v) + ", which no limit surface is made for");
    }
  }
  const int most = scheme == Scheme::Loop ? 3 : 4;
  for (std::int64_t f = 0; f < faces.count(); ++f) {
    const int degree = faces.degree(f);
    if (degree >= 3 && degree <= most) continue;
    throw std::invalid_argument("face " + std::to_string(f) + " has " + std::to_string(degree) +
                                " corners, and " +
                                (scheme == Scheme::Loop ? "Loop's scheme is for triangles"
                                                        : "triangles and quads are expected"));
  }
}

/// The patch of the last place that was asked for, made once for those in a row on it.
class LastPatch {
 public:
  explicit LastPatch(const LimitSurface& surface) : surface_(surface) {}
  const LimitPatch& at(int index) {
    if (!patch_ || patch_->index() != index) patch_ = surface_.patch(index);
    return *patch_;
  }

 private:
  const LimitSurface& surface_;
  std::optional<LimitPatch> patch_;
};

}  // namespace

LimitTopology::LimitTopology(const Polygons& faces, int vertex_count, Scheme scheme)
    : tables_(std::make_unique<Tables>()) {
  check(faces, vertex_count, scheme);
  tables_->scheme = scheme;
  tables_->vertex_count = vertex_count;
  const int regular = scheme == Scheme::Loop ? 3 : 4;
  tables_->first_patch.push_back(0);
  bool one_each = true;
  for (std::int64_t f = 0; f < faces.count(); ++f) {
    const int patches = faces.degree(f) == regular ? 1 : faces.degree(f);
    tables_->first_patch.push_back(tables_->first_patch.back() + patches);
    one_each &= patches == 1;
  }
  if (!one_each) {
    for (int f = 0; f < static_cast<int>(faces.count()); ++f)
      tables_->face_of.resize(static_cast<size_t>(first_patch(f + 1)), f);
  }
  tables_->refiner = make_refiner(faces, vertex_count, scheme);
  tables_->factory = std::make_unique<BfrFactory>(*tables_->refiner, factory_options());
}

LimitTopology::~LimitTopology() = default;
Scheme LimitTopology::scheme() const { return tables_->scheme; }
int LimitTopology::vertex_count() const { return tables_->vertex_count; }
int LimitTopology::patch_count() const { return tables_->first_patch.back(); }
int LimitTopology::first_patch(int face) const {
  return tables_->first_patch[static_cast<size_t>(face)];
}
int LimitTopology::face_of(int patch) const {
  return tables_->face_of.empty() ? patch : tables_->face_of[static_cast<size_t>(patch)];
}

LimitSurface::LimitSurface(std::shared_ptr<const LimitTopology> topology, Points control)
    : topology_(std::move(topology)), control_(std::move(control)) {
  if (!topology_) throw std::invalid_argument("LimitSurface: no topology");
  if (control_.rows() != topology_->vertex_count()) {
    throw std::invalid_argument("LimitSurface: " + std::to_string(control_.rows()) +
                                " control points for " + std::to_string(topology_->vertex_count()) +
                                " vertices");
  }
}

LimitSurface::LimitSurface(const Polygons& faces, Points control, Scheme scheme)
    : LimitSurface(std::make_shared<LimitTopology>(faces, static_cast<int>(control.rows()), scheme),
                   control) {}

LimitPoint LimitSurface::evaluate(const LimitPlace& place) const {
  return patch(place.patch).evaluate(place.s, place.t);
}

LimitCurvature LimitSurface::curvature(const LimitPlace& place) const {
  return patch(place.patch).curvature(place.s, place.t);
}

std::vector<LimitPoint> LimitSurface::evaluate_all(std::span<const LimitPlace> places,
                                                   int threads) const {
  std::vector<LimitPoint> points(places.size());
  parallel_for(std::ssize(places), grain, threads, [&](std::int64_t first, std::int64_t last) {
    const auto begin = static_cast<size_t>(first), count = static_cast<size_t>(last - first);
    LastPatch patch(*this);
    LimitPoints found;
    for_each_run(places.subspan(begin, count), [&](const LimitRun& run) {
      patch.at(places[begin + run.first].patch).evaluate(run.s, run.t, run.count, found);
      for (size_t i = 0; i < run.count; ++i) points[begin + run.first + i] = found[i];
    });
  });
  return points;
}

std::vector<LimitCurvature> LimitSurface::curvature_all(std::span<const LimitPlace> places,
                                                        int threads) const {
  std::vector<LimitCurvature> curvatures(places.size());
  parallel_for(std::ssize(places), grain, threads, [&](std::int64_t first, std::int64_t last) {
    LastPatch patch(*this);
    for (auto i = static_cast<size_t>(first); i < static_cast<size_t>(last); ++i)
      curvatures[i] = patch.at(places[i].patch).curvature(places[i].s, places[i].t);
  });
  return curvatures;
}

}  // namespace sphparam
