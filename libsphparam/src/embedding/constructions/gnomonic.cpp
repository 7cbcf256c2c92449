#include "embedding/constructions/gnomonic.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elementary.h"
#include "mesh/laplace_system.h"
#include "option_domain.h"
#include "sphere/face_rays.h"
#include "sphparam/mesh/edge_weights.h"
#include "sphparam/sphere/certificate.h"

// The link of S, run through clockwise about S, is the counter-clockwise boundary of everything
// else. With the link on a convex polygon around 0 and the rest one-to-one inside, the rays
// (u, v, 1) and S = (0, 0, −1) have positive determinants: a face of the disk has twice its area;
// a face (S, a, b) has sin of the gap from b to a, below π. A ray near S meets the star of S alone:
// degree 1. The stereographic lift has no such proof and is better in almost every case.

namespace sphparam {
namespace {

constexpr double least_kappa = 1e-12;       // of the greatest
constexpr double least_area_ratio = 1e-12;  // image to source; below is rounding, not shape
constexpr double centred = 1e-2;            // length of the mean point that is near enough to 0
constexpr int centring_steps = 60;
constexpr double longest_shift = 0.9;  // of a centring step, in the unit ball

/// Edges from `source` to every vertex.
std::vector<int> hop_counts(const Topology& topology, Vertex source) {
  std::vector<int> hops(static_cast<size_t>(topology.vertex_count()), -1);
  std::vector<Vertex> front{source};
  hops[static_cast<size_t>(source)] = 0;
  for (size_t i = 0; i < front.size(); ++i) {
    const int next = hops[static_cast<size_t>(front[i])] + 1;
    topology.for_each_outgoing(front[i], [&](Halfedge h) {
      int& count = hops[static_cast<size_t>(topology.target(h))];
      if (count >= 0) return;
      count = next;
      front.push_back(topology.target(h));
    });
  }
  return hops;
}

Vertex farthest(const std::vector<int>& hops) {
  return static_cast<Vertex>(std::max_element(hops.begin(), hops.end()) - hops.begin());
}

struct Ends {
  Vertex first, second;
};

/// The ends of a path that is longest, or nearly so, among the shortest ones.
Ends longest_path(const Topology& topology) {
  const Vertex first = farthest(hop_counts(topology, 0));
  return {first, farthest(hop_counts(topology, first))};
}

Vertex middle_of(const Topology& topology, Ends ends) {
  const std::vector<int> a = hop_counts(topology, ends.first);
  const std::vector<int> b = hop_counts(topology, ends.second);
  Vertex best = 0;
  const auto reach = [&](Vertex v) {
    return std::max(a[static_cast<size_t>(v)], b[static_cast<size_t>(v)]);
  };
  for (Vertex v = 1; v < topology.vertex_count(); ++v) {
    if (reach(v) < reach(best)) best = v;
  }
  return best;
}

Vertex largest_valence(const Topology& topology) {
  std::vector<int> valence(static_cast<size_t>(topology.vertex_count()), 0);
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
    ++valence[static_cast<size_t>(topology.origin(h))];
  }
  return static_cast<Vertex>(std::max_element(valence.begin(), valence.end()) - valence.begin());
}

/// Tutte's embeddings of the mesh without one vertex, for any κ.
class DiskSystem {
 public:
  DiskSystem(const TriangleMesh& mesh, const Topology& topology, Vertex south, int threads)
      : topology_(topology),
        south_(south),
        threads_(threads),
        weights_(mesh, topology, WeightKind::SymmetricMeanValue, threads),
        link_(place_link(mesh, topology, south)),
        system_(topology, roles(topology, south), true, threads) {}

  OneVertexDisk solve(const std::vector<double>& kappa = {}) {
    system_.factorise(weights_.with(topology_, kappa, threads_), threads_);
    return {south_, system_.solve(link_, {}, threads_)};
  }

 private:
  static std::vector<VertexRole> roles(const Topology& topology, Vertex south) {
    std::vector<VertexRole> roles(static_cast<size_t>(topology.vertex_count()), VertexRole::Free);
    roles[static_cast<size_t>(south)] = VertexRole::Removed;
    topology.for_each_outgoing(south, [&](Halfedge h) {
      roles[static_cast<size_t>(topology.target(h))] = VertexRole::Fixed;
    });
    return roles;
  }

  static MatrixX place_link(const TriangleMesh& mesh, const Topology& topology, Vertex south) {
    std::vector<Vertex> link;
    topology.for_each_outgoing(south, [&](Halfedge h) { link.push_back(topology.target(h)); });
    std::reverse(link.begin(), link.end());
    const size_t n = link.size();
    std::vector<double> length(n);
    double total = 0;
    for (size_t i = 0; i < n; ++i) {
      length[i] = (mesh.position(link[(i + 1) % n]) - mesh.position(link[i])).stableNorm();
      total += length[i];
    }
    // An edge is at most half of a closed polygon: each gap is at most 2π(1/2n + 1/4) ≤ 5π/6.
    MatrixX points = MatrixX::Zero(mesh.vertex_count(), 2);
    double run = 0;
    for (size_t i = 0; i < n; ++i) {
      const double even = static_cast<double>(i) / static_cast<double>(n);
      const double by_length = total > 0 && std::isfinite(total) ? run / total : even;
      const double angle = std::numbers::pi * (even + by_length);
      points.row(link[i]) << elementary::cos(angle), elementary::sin(angle);
      run += length[i];
    }
    return points;
  }

  const Topology& topology_;
  Vertex south_;
  int threads_;
  EdgeWeights weights_;
  MatrixX link_;
  LaplaceSystem system_;
};

/// The disk, moved by −centre and scaled by ρ, on the sphere.
SphereMap lift_stereographically(const OneVertexDisk& disk, const Eigen::RowVector2d& centre,
                                 double rho) {
  SphereMap map{Points(disk.points.rows(), 3)};
  for (Eigen::Index v = 0; v < disk.points.rows(); ++v) {
    const Eigen::RowVector2d p = rho * (disk.points.row(v) - centre);
    const double r2 = p.squaredNorm();
    // 2 − 2r²/(1 + r²) would lose the digits of points near the north pole.
    map.points.row(v) = Eigen::RowVector3d(2 * p.x(), 2 * p.y(), 1 - r2).normalized();
  }
  map.points.row(disk.south) << 0, 0, -1;
  return map;
}

/// κ ← κ·√(image area / source area), greatest 1.
void reweight(std::vector<double>& kappa, const Topology& topology, const RestTriangles& source,
              const SphereMap& map) {
  double greatest = 0;
  for (Face f = 0; f < topology.face_count(); ++f) {
    const double ratio =
        std::abs(distortion(source[static_cast<size_t>(f)], face_rays(topology, map, f)).s);
    double& k = kappa[static_cast<size_t>(f)];
    k *= std::sqrt(std::max(ratio, least_area_ratio));
    greatest = std::max(greatest, k);
  }
  for (double& k : kappa) k = std::max(k / greatest, least_kappa);
}

/// A map with what decides between maps.
struct Candidate {
  SphereMap map;
  long folds;
  bool bijective;

  Candidate(const Topology& topology, SphereMap m, int threads) : map(std::move(m)) {
    const Certificate certificate = certify(topology, map, threads);
    folds = certificate.fold_count();
    bijective = certificate.bijective();
  }
};

/// One attempt: a certified map or the best there is, without the vertex `south`.
class Attempt {
 public:
  Attempt(const TriangleMesh& mesh, const Topology& topology, const RestTriangles& source,
          Vertex south, const GnomonicOptions& options)
      : topology_(topology),
        source_(source),
        options_(options),
        areas_(vertex_areas(topology, source)),
        system_(mesh, topology, south, options.threads),
        disk_(system_.solve()) {
    report_.south = south;
  }

  GnomonicEmbedding run() {
    GnomonicEmbedding best = untangled(stereographic(), true);
    if (best.bijective) return best;
    GnomonicEmbedding other =
        untangled(Candidate(topology_, gnomonic_lift(disk_, areas_), options_.threads), false);
    if (other.bijective || folds_after(other) < folds_after(best)) best = std::move(other);
    return best;
  }

  static long folds_after(const GnomonicEmbedding& e) { return e.report.untangling.folds_after; }

 private:
  Candidate stereographic() {
    const DistortionEnergy energy{.lambda = options_.lambda};
    const auto lift = [&](const OneVertexDisk& disk) {
      return Candidate(topology_, stereographic_lift(disk, areas_), options_.threads);
    };
    const auto energy_of = [&](const Candidate& c) {
      return distortion_energy(topology_, source_, c.map, energy, options_.threads);
    };
    Candidate best = lift(disk_);
    double best_energy = energy_of(best);
    SphereMap last = best.map;
    std::vector<double> kappa(static_cast<size_t>(topology_.face_count()), 1.0);
    for (int i = 1; i <= options_.reweightings; ++i) {
      sphparam::report(options_.progress, "gnomonic", i / (options_.reweightings + 1.0));
      reweight(kappa, topology_, source_, last);
      Candidate next = lift(system_.solve(kappa));
      const double next_energy = energy_of(next);
      if (next.folds > best.folds) break;
      last = next.map;
      // E does not fall steadily on the way: the fixed link pulls against κ.
      if (next.folds == best.folds && !(next_energy < best_energy)) continue;
      best = std::move(next);
      best_energy = next_energy;
      report_.reweightings = i;
    }
    return best;
  }

  GnomonicEmbedding untangled(Candidate lifted, bool stereographic) {
    GnomonicEmbedding result{std::move(lifted.map), lifted.bijective, report_};
    result.report.stereographic = stereographic;
    result.report.lift_folds = lifted.folds;
    if (!stereographic) result.report.reweightings = 0;
    if (lifted.bijective) return result;
    Untangled repaired = untangle(
        topology_, source_, result.map,
        {.lambda = options_.lambda, .threads = options_.threads, .progress = options_.progress});
    result.report.untangling = repaired.report;
    const Candidate candidate(topology_, std::move(repaired.map), options_.threads);
    result.bijective = candidate.bijective;
    result.map = candidate.map;
    return result;
  }

  const Topology& topology_;
  const RestTriangles& source_;
  const GnomonicOptions& options_;
  VectorX areas_;
  DiskSystem system_;
  OneVertexDisk disk_;
  GnomonicReport report_;
};

std::vector<Vertex> vertices_to_leave_out(const Topology& topology,
                                          const std::optional<Vertex>& south) {
  if (south) return {*south};
  const Ends ends = longest_path(topology);
  std::vector<Vertex> candidates;
  for (const Vertex v :
       {middle_of(topology, ends), largest_valence(topology), ends.first, ends.second}) {
    if (std::find(candidates.begin(), candidates.end(), v) == candidates.end()) {
      candidates.push_back(v);
    }
  }
  return candidates;
}

}  // namespace

Vertex middle_vertex(const Topology& topology) {
  return middle_of(topology, longest_path(topology));
}

OneVertexDisk tutte_disk(const TriangleMesh& mesh, const Topology& topology, Vertex south,
                         int threads) {
  require_vertex("south", south, topology.vertex_count());
  return DiskSystem(mesh, topology, south, threads).solve();
}

VectorX vertex_areas(const Topology& topology, const RestTriangles& source) {
  VectorX areas = VectorX::Zero(topology.vertex_count());
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
    areas[topology.origin(h)] += source[static_cast<size_t>(Topology::face(h))].area / 3;
  }
  return areas;
}

SphereMap gnomonic_lift(const OneVertexDisk& disk, const VectorX& areas) {
  // z = 1/√(1 + ρ²r²) has mean ½ where the weights are even over the half sphere. Only powers of
  // two are tried: they keep the disk's orientations exactly.
  const double wanted = (areas.sum() - areas[disk.south]) / 2;
  double rho = 1;
  for (double mean = areas.sum(); mean > wanted && rho < 0x1p64;) {
    rho *= 2;
    mean = 0;
    for (Eigen::Index v = 0; v < disk.points.rows(); ++v) {
      if (v != disk.south)
        mean += areas[v] / std::sqrt(1 + rho * rho * disk.points.row(v).squaredNorm());
    }
  }
  Points rays(disk.points.rows(), 3);
  rays.leftCols<2>() = rho * disk.points;
  rays.col(2).setOnes();
  rays.row(disk.south) << 0, 0, -1;
  return normalised(std::move(rays));
}

SphereMap stereographic_lift(const OneVertexDisk& disk, const VectorX& areas) {
  // Newton's method on the mean of the images under the Möbius transformations that the plane's
  // translations and scalings are: a shift by a in the ball moves x by 2(a − (a·x)x).
  Eigen::RowVector2d centre = Eigen::RowVector2d::Zero();
  double rho = 1;
  SphereMap map = lift_stereographically(disk, centre, rho);
  for (int i = 0; i < centring_steps; ++i) {
    Vector3 mean = Vector3::Zero();
    Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
    for (Eigen::Index v = 0; v < map.points.rows(); ++v) {
      const Vector3 x = map.points.row(v);
      mean += areas[v] * x;
      slope += 2 * areas[v] * (Eigen::Matrix3d::Identity() - x * x.transpose());
    }
    if (mean.norm() < centred * areas.sum()) break;
    Vector3 shift = -slope.ldlt().solve(mean);
    if (!shift.allFinite()) shift = -mean / areas.sum();
    if (shift.norm() > longest_shift) shift *= longest_shift / shift.norm();
    centre -= shift.head<2>().transpose() / rho;
    rho *= (1 - shift.z()) / (1 + shift.z());
    map = lift_stereographically(disk, centre, rho);
  }
  return map;
}

GnomonicEmbedding gnomonic_embedding(const TriangleMesh& mesh, const Topology& topology,
                                     const GnomonicOptions& options) {
  if (options.south) require_vertex("south", *options.south, topology.vertex_count());
  require_between("lambda", options.lambda, 0, greatest_lambda);
  require_at_least("reweightings", options.reweightings, 0);
  require_at_least("sweeps", options.sweeps, 0);
  const RestTriangles source = measure_source(mesh, options.threads);
  std::optional<GnomonicEmbedding> best;
  int attempts = 0;
  for (const Vertex south : vertices_to_leave_out(topology, options.south)) {
    GnomonicEmbedding next = Attempt(mesh, topology, source, south, options).run();
    ++attempts;
    if (!best || next.bijective || Attempt::folds_after(next) < Attempt::folds_after(*best)) {
      best = std::move(next);
    }
    if (best->bijective) break;
  }
  best->report.attempts = attempts;
  Relaxation relaxed = relax(topology, source, best->map,
                             {.energy = {.lambda = options.lambda},
                              .sweeps = options.sweeps,
                              .threads = options.threads,
                              .progress = options.progress});
  best->map = std::move(relaxed.map);
  best->report.relaxation = relaxed.report;
  return *std::move(best);
}

}  // namespace sphparam
