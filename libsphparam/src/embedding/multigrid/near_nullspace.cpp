#include "embedding/multigrid/near_nullspace.h"

#include <cmath>
#include <iterator>

#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/parallel.h"

// Aggregate C with centre c, frame (u, v, c), radius r moves its points x by four fields:
//   r u × x,  r v × x,  c × x,  c − x,
// two turns that carry it along, a turn in its plane, a dilation: P maps their amounts to tangent
// coordinates. Everything is relative to c and r, so that aggregates of radius 1e-9 on a
// protrusion's tip are as well scaled as any, and entries are near 1.
//
// With τ = a u + b v the tangent vector of coordinates (a, b) at x and ω = x × τ = a v − b u, the
// four fields have the products  r U·ω,  r V·ω,  (c − x)·ω,  (c − x)·τ  with τ.

namespace sphparam {
namespace {

/// Centre and radius of an aggregate of points with radii of their own.
template <class Centre, class Radius>
AggregateSite gather_site(const std::vector<int>& members, int first, int last,
                          const Centre& centre, const Radius& radius) {
  AggregateSite site;
  Vector3 sum = Vector3::Zero();
  for (int m = first; m < last; ++m) sum += centre(members[at(m)]);
  site.centre = sum.stableNormalized();
  double squares = 0;
  for (int m = first; m < last; ++m) {
    const double r = radius(members[at(m)]);
    squares += (centre(members[at(m)]) - site.centre).squaredNorm() + r * r;
  }
  site.radius = std::sqrt(squares / (last - first));
  return site;
}

}  // namespace

std::vector<AggregateSite> gather_sites(const PointRows& rows, const Aggregates& aggregates,
                                        int threads) {
  std::vector<AggregateSite> sites(at(aggregates.count()));
  parallel_for(std::ssize(sites), row_grain, threads, [&](std::int64_t begin, std::int64_t end) {
    for (int c = static_cast<int>(begin); c < static_cast<int>(end); ++c) {
      sites[at(c)] = gather_site(
          aggregates.members, aggregates.start[at(c)], aggregates.start[at(c) + 1],
          [&](int i) { return rows.points[i].vector(); },
          [&](int i) { return static_cast<double>(rows.units[i]); });
    }
  });
  return sites;
}

std::vector<AggregateSite> gather_sites(const std::vector<AggregateSite>& children,
                                        const Aggregates& aggregates) {
  std::vector<AggregateSite> sites(at(aggregates.count()));
  for (int c = 0; c < aggregates.count(); ++c) {
    sites[at(c)] = gather_site(
        aggregates.members, aggregates.start[at(c)], aggregates.start[at(c) + 1],
        [&](int i) { return children[at(i)].centre; },
        [&](int i) { return children[at(i)].radius; });
  }
  return sites;
}

std::vector<Block<2, near_nullspace>> point_prolongation(const PointRows& rows,
                                                         const Aggregates& aggregates,
                                                         const std::vector<AggregateSite>& sites,
                                                         int threads) {
  std::vector<Block<2, near_nullspace>> p(aggregates.of_row.size());
  parallel_for(std::ssize(p), row_grain, threads, [&](std::int64_t begin, std::int64_t end) {
    for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
      if (aggregates.of_row[at(row)] < 0) continue;
      const AggregateSite& site = sites[at(aggregates.of_row[at(row)])];
      const Vector3 x = rows.points[row].vector(), d = site.centre - x;
      const TangentFrame own = tangent_frame(x), frame = tangent_frame(site.centre);
      const double radius = site.radius;
      const double at_u[near_nullspace] = {radius * frame.u.dot(own.v), radius * frame.v.dot(own.v),
                                           d.dot(own.v), d.dot(own.u)};
      const double at_v[near_nullspace] = {
          -radius * frame.u.dot(own.u), -radius * frame.v.dot(own.u), -d.dot(own.u), d.dot(own.v)};
      for (int k = 0; k < near_nullspace; ++k) {
        p[at(row)](0, k) = at_u[k] / rows.units[row];
        p[at(row)](1, k) = at_v[k] / rows.units[row];
      }
    }
  });
  return p;
}

void restrict_from_points(const PointRows& rows, const Aggregates& aggregates,
                          const std::vector<AggregateSite>& sites, const double* r, double* b,
                          int threads) {
  parallel_for(std::ssize(sites), row_grain, threads, [&](std::int64_t begin, std::int64_t end) {
    for (auto c = static_cast<size_t>(begin); c < static_cast<size_t>(end); ++c) {
      const AggregateSite& site = sites[c];
      Vector3 turn = Vector3::Zero();
      double spin = 0, dilation = 0;
      for (int m = aggregates.start[c]; m < aggregates.start[c + 1]; ++m) {
        const int row = aggregates.members[at(m)];
        const Vector3 x = rows.points[row].vector(), d = site.centre - x;
        const TangentFrame own = tangent_frame(x);
        const double s = 1.0 / rows.units[row];
        const double along_u = s * r[2 * row], along_v = s * r[2 * row + 1];
        const Vector3 omega = along_u * own.v - along_v * own.u;
        turn += omega;
        spin += d.dot(omega);
        dilation += d.dot(along_u * own.u + along_v * own.v);
      }
      const TangentFrame frame = tangent_frame(site.centre);
      b[near_nullspace * c] = site.radius * frame.u.dot(turn);
      b[near_nullspace * c + 1] = site.radius * frame.v.dot(turn);
      b[near_nullspace * c + 2] = spin;
      b[near_nullspace * c + 3] = dilation;
    }
  });
}

void prolong_to_points(const PointRows& rows, const Aggregates& aggregates,
                       const std::vector<AggregateSite>& sites, const double* y, double* x,
                       int threads) {
  parallel_for(std::ssize(sites), row_grain, threads, [&](std::int64_t begin, std::int64_t end) {
    for (auto c = static_cast<size_t>(begin); c < static_cast<size_t>(end); ++c) {
      const AggregateSite& site = sites[c];
      const double* amounts = y + near_nullspace * c;
      const TangentFrame frame = tangent_frame(site.centre);
      const Vector3 turn = site.radius * (amounts[0] * frame.u + amounts[1] * frame.v);
      for (int m = aggregates.start[c]; m < aggregates.start[c + 1]; ++m) {
        const int row = aggregates.members[at(m)];
        const Vector3 point = rows.points[row].vector(), d = site.centre - point;
        const TangentFrame own = tangent_frame(point);
        const Vector3 omega = turn + amounts[2] * d, away = amounts[3] * d;
        const double s = 1.0 / rows.units[row];
        x[2 * row] += s * (omega.dot(own.v) + away.dot(own.u));
        x[2 * row + 1] += s * (away.dot(own.v) - omega.dot(own.u));
      }
    }
  });
}

std::vector<Block<near_nullspace>> site_prolongation(const std::vector<AggregateSite>& children,
                                                     const Aggregates& aggregates,
                                                     const std::vector<AggregateSite>& parents) {
  std::vector<Block<near_nullspace>> p(children.size());
  for (int c = 0; c < aggregates.count(); ++c) {
    const AggregateSite& site = parents[at(c)];
    const TangentFrame frame = tangent_frame(site.centre);
    for (int m = aggregates.start[at(c)]; m < aggregates.start[at(c) + 1]; ++m) {
      const int row = aggregates.members[at(m)];
      const AggregateSite& child = children[at(row)];
      const TangentFrame own = tangent_frame(child.centre);
      // A turn ω of the parent is the turn (ω·u/r, ω·v/r, ω·c) of the child.
      const Vector3 d = site.centre - child.centre;  // C·u = d·u, U·c = −U·d
      const double s = 1 / child.radius, larger = site.radius * s;
      const double along = site.centre.dot(child.centre);
      const auto set = [&](int i, int j, double value) { p[at(row)](i, j) = value; };
      set(0, 0, larger * frame.u.dot(own.u));
      set(1, 0, larger * frame.u.dot(own.v));
      set(2, 0, -site.radius * frame.u.dot(d));
      set(0, 1, larger * frame.v.dot(own.u));
      set(1, 1, larger * frame.v.dot(own.v));
      set(2, 1, -site.radius * frame.v.dot(d));
      set(0, 2, s * d.dot(own.u));
      set(1, 2, s * d.dot(own.v));
      set(2, 2, along);
      // The dilation about C carries the child along, (d·u) u + (d·v) v, and dilates it.
      set(0, 3, -s * d.dot(own.v));
      set(1, 3, s * d.dot(own.u));
      set(3, 3, along);
    }
  }
  return p;
}

}  // namespace sphparam
