#include "embedding/frame/axis_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "elementary.h"
#include "option_domain.h"
#include "sphere/face_rays.h"
#include "sphparam/parallel.h"

// Density. A triangle of source area A, magnified s = Ω/A, at polar angle ϕ from an axis has
// s / sin ϕ texels per source area (times a constant). With L = log2 s, l = log2 sin ϕ:
//   variance = Σ A(L − l)² / ΣA − (Σ A(L − l) / ΣA)²:
// cells of the sphere that know Σ A, Σ A L and Σ A L² tell it for every axis.
// Folds. A line straight in (θ, ϕ) bends away from the great circle, towards the equator: at a part
// f of its length ℓ by κ ℓ² f(1 − f)/2, κ its geodesic curvature. A triangle on that side folds
// when it is lower. Long and low triangles that may are looked at closely.

namespace sphparam {
namespace {

constexpr std::int64_t face_grain = 8192;
constexpr size_t at_once = 64;  // triangles whose logarithms are taken together
constexpr std::int64_t candidate_grain = 8;
constexpr int cells_a_side = 6;  // of each face of a cube
constexpr int cell_count = 6 * cells_a_side * cells_a_side;
constexpr float slack = 1.5f;  // of the test that looks for suspects: it is of first order
constexpr float low = 4;       // a triangle is low when its length exceeds that many heights
constexpr int meridians = 256;
constexpr double least_density_deviation = 0.02;  // of log2: what follows from coarse cells

size_t at(std::int64_t i) { return static_cast<size_t>(i); }

struct Cell {
  double area = 0;     // Σ A
  double logs = 0;     // Σ A L
  double squares = 0;  // Σ A L²

  void add(const Cell& other) {
    area += other.area;
    logs += other.logs;
    squares += other.squares;
  }
};
using Cells = std::array<Cell, cell_count>;

/// The cell of a ray: the face of the cube it meets, and where.
int cell_of(const Vector3& ray) {
  int axis = 0;
  const double size = ray.cwiseAbs().maxCoeff(&axis);
  const auto step = [&](double t) {
    return std::clamp(static_cast<int>((t / size + 1) / 2 * cells_a_side), 0, cells_a_side - 1);
  };
  const int side = 2 * axis + (ray[axis] < 0);
  return (side * cells_a_side + step(ray[(axis + 1) % 3])) * cells_a_side +
         step(ray[(axis + 2) % 3]);
}

Vector3 cell_centre(int cell) {
  const int side = cell / (cells_a_side * cells_a_side), axis = side / 2;
  const auto centre = [](int i) { return (2 * i + 1.0) / cells_a_side - 1; };
  Vector3 ray;
  ray[axis] = side % 2 ? -1 : 1;
  ray[(axis + 1) % 3] = centre(cell / cells_a_side % cells_a_side);
  ray[(axis + 2) % 3] = centre(cell % cells_a_side);
  return ray.normalized();
}

/// Points of a spiral over the half sphere z > 0, evenly spread.
Points spread_directions(int count) {
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  Points directions(count, 3);
  for (int k = 0; k < count; ++k) {
    const double z = (k + 0.5) / count, r = std::sqrt(1 - z * z);
    directions.row(k) << r * elementary::cos(golden_angle * k),
        r * elementary::sin(golden_angle * k), z;
  }
  return directions;
}

using ImageCorners = std::array<Vector3, 3>;

/// Axes as three lists, for loops that the compiler turns into vector instructions.
struct Axes {
  std::vector<float> x, y, z;
  std::vector<Eigen::Matrix3d> frames;  // rows: a right-handed frame, the axis last

  explicit Axes(const Points& directions) {
    for (Eigen::Index k = 0; k < directions.rows(); ++k) {
      const Vector3 n = directions.row(k), u = n.unitOrthogonal();
      x.push_back(static_cast<float>(n.x()));
      y.push_back(static_cast<float>(n.y()));
      z.push_back(static_cast<float>(n.z()));
      Eigen::Matrix3d& frame = frames.emplace_back();
      frame << u.transpose(), n.cross(u).transpose(), n.transpose();
    }
  }
  size_t size() const { return x.size(); }
};

/// A triangle seen from its longest edge.
struct LongEdge {
  float length, height;                    // of the edge, and of the triangle above it
  float foot;                              // of that height, as a part of the edge
  Eigen::Vector3f middle, along, towards;  // unit: radial, of the edge, to the apex
};

/// Is the longest edge short beside the height above it, det / length?
bool is_round(const ImageCorners& triangle, double det) {
  const auto& [a, b, c] = triangle;
  const double longest =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return longest < low * det;
}

LongEdge long_edge(const ImageCorners& x, double det) {
  size_t first = 0;
  double length2 = 0;
  for (size_t i = 0; i < 3; ++i) {
    const double l = (x[(i + 1) % 3] - x[i]).squaredNorm();
    if (l > length2) length2 = l, first = i;
  }
  const Vector3 &p = x[first], &q = x[(first + 1) % 3], &r = x[(first + 2) % 3];
  const double length = std::sqrt(length2), foot = (r - p).dot(q - p) / length2;
  const Vector3 middle = (p + q).normalized(), along = (q - p) / length;
  return {static_cast<float>(length), static_cast<float>(det / length),
          static_cast<float>(foot),   middle.cast<float>(),
          along.cast<float>(),        middle.cross(along).cast<float>()};
}

/// Marks the axes that the triangle may fold for. With (c, p, q) the axis in the frame (middle,
/// along, towards) and S² = p² + q²: cot ϕ = |c|/S, the edge's heading has cosine p/S and sine q/S,
/// and its line bends by κ = cot ϕ |q|/S (1 + p²/S²) away from the pole.
void mark_suspects(const LongEdge& t, const Axes& axes, unsigned char* suspect) {
  const float bend = slack * t.length * t.length * t.foot * (1 - t.foot) / 2;
  const float near = t.length * t.length;
  const Eigen::Vector3f m = t.middle, e = t.along, g = t.towards;
  const float *x = axes.x.data(), *y = axes.y.data(), *z = axes.z.data();
  const size_t count = axes.size();
  for (size_t k = 0; k < count; ++k) {
    const float c = m[0] * x[k] + m[1] * y[k] + m[2] * z[k];
    const float p = e[0] * x[k] + e[1] * y[k] + e[2] * z[k];
    const float q = g[0] * x[k] + g[1] * y[k] + g[2] * z[k];
    const float s = p * p + q * q, poleward = c * q;
    // h < κ ℓ² f(1 − f)/2, the apex on the side away from the pole
    suspect[k] = (t.height * s * s < -poleward * bend * (s + p * p)) | (s < near);
  }
}

/// Adds 1 for every axis that the triangle folds for.
void count_folds(const ImageCorners& t, double det, const Axes& axes,
                 std::vector<unsigned char>& suspect, std::vector<int>& folds) {
  if (is_round(t, det)) return;
  mark_suspects(long_edge(t, det), axes, suspect.data());
  for (size_t k = 0; k < axes.size(); ++k) {
    if (!suspect[k]) continue;
    const Eigen::Matrix3d& frame = axes.frames[k];
    folds[k] += folds_in_chart(frame * t[0], frame * t[1], frame * t[2]);
  }
}

/// What the axes are judged by.
struct Survey {
  Cells cells{};
  std::vector<double> folds;  // per axis
};

/// What a run of triangles adds to a survey.
struct SurveyPart {
  Cells cells{};
  std::vector<int> folds;  // per axis
};

/// Logarithms are taken of many at once.
SurveyPart survey_run(const Topology& topology, const RestTriangles& source, const SphereMap& map,
                      const Axes& axes, Face first, Face last) {
  SurveyPart part{{}, std::vector<int>(axes.size(), 0)};
  std::vector<unsigned char> suspect(axes.size());
  std::array<ImageCorners, at_once> triangles;
  std::array<double, at_once> dets, areas, ratios, logs;
  for (Face f = first; f < last;) {
    size_t count = 0;
    for (; f < last && count < at_once; ++f) {
      const auto [a, b, c] = triangles[count] = face_rays(topology, map, f);
      dets[count] = a.dot((b - a).cross(c - a));
      areas[count] = source[at(f)].area;
      ratios[count] = dets[count] / (2 * areas[count]);
      if (dets[count] > 0) ++count;
    }
    elementary::log2(std::span(ratios).first(count), std::span(logs).first(count));
    for (size_t i = 0; i < count; ++i) {
      const auto& [a, b, c] = triangles[i];
      const double area = areas[i], log = logs[i];
      part.cells[at(cell_of(a + b + c))].add({area, area * log, area * log * log});
      count_folds(triangles[i], dets[i], axes, suspect, part.folds);
    }
  }
  return part;
}

Survey survey_triangles(const Topology& topology, const RestTriangles& source, const SphereMap& map,
                        const Axes& axes, int threads) {
  const std::int64_t faces = topology.face_count();
  std::vector<SurveyPart> parts(at((faces + face_grain - 1) / face_grain));
  parallel_for(faces, face_grain, threads, [&](std::int64_t first, std::int64_t last) {
    parts[at(first / face_grain)] =
        survey_run(topology, source, map, axes, static_cast<Face>(first), static_cast<Face>(last));
  });
  Survey survey{{}, std::vector<double>(axes.size(), 0)};
  for (const SurveyPart& part : parts) {
    for (size_t i = 0; i < part.cells.size(); ++i) survey.cells[i].add(part.cells[i]);
    for (size_t k = 0; k < part.folds.size(); ++k) survey.folds[k] += part.folds[k];
  }
  return survey;
}

/// Standard deviation of log2(texels per source area).
double density_spread(const Cells& cells, const Points& centres, const Vector3& axis) {
  // A cell is no point: its own extent keeps the logarithm finite.
  constexpr double blur = std::numbers::pi / cell_count;
  double area = 0, linear = 0, quadratic = 0;
  for (int i = 0; i < cell_count; ++i) {
    const double cosine = axis.dot(centres.row(i));
    const double l = elementary::log2(std::max(0.0, 1 - cosine * cosine) + blur) / 2;
    const Cell& cell = cells[at(i)];
    area += cell.area;
    linear += cell.logs - l * cell.area;
    quadratic += cell.squares - l * (2 * cell.logs - l * cell.area);
  }
  const double mean = linear / area;
  return std::sqrt(std::max(0.0, quadratic / area - mean * mean));
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// (value − mean) / standard deviation, of which at least `least` is assumed: less is no
/// difference.
std::vector<double> standardised(std::vector<double> values, double least) {
  const double middle = mean(values);
  double variance = 0;
  for (const double value : values) variance += (value - middle) * (value - middle);
  variance /= static_cast<double>(values.size());
  const double deviation = std::max(least, std::sqrt(variance));
  for (double& value : values) value = (value - middle) / deviation;
  return values;
}

/// θ as it grows, but piecewise linear in x and y: 0 to 4, without a call of atan2.
double diamond_angle(double x, double y) {
  const double size = std::abs(x) + std::abs(y);
  if (size == 0) return 0;
  const double t = y / size;
  return x < 0 ? 2 - t : (y < 0 ? 4 + t : t);
}

std::vector<float> angles_in_meridians(const SphereMap& map, int threads) {
  std::vector<float> angles(at(map.points.rows()));
  parallel_for(map.points.rows(), face_grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t v = first; v < last; ++v) {
      angles[at(v)] =
          static_cast<float>(diamond_angle(map.points(v, 0), map.points(v, 1)) * (meridians / 4.0));
    }
  });
  return angles;
}

/// How often half-edges cross each meridian eastwards, the short way round: once a triangle that
/// the meridian crosses.
std::vector<int> count_crossings(const Topology& topology, const std::vector<float>& angles,
                                 int threads) {
  using Changes = std::array<int, meridians + 1>;  // +1 where an edge begins to cross, −1 behind
  const std::int64_t faces = topology.face_count();
  std::vector<Changes> parts(at((faces + face_grain - 1) / face_grain), Changes{});
  parallel_for(faces, face_grain, threads, [&](std::int64_t first, std::int64_t last) {
    Changes& change = parts[at(first / face_grain)];
    const auto cross = [&](float from, float to) {
      const bool wraps = std::abs(to - from) > meridians / 2;
      if (from == to || (to > from) == wraps) return;  // not eastwards
      ++change[at(std::lround(std::ceil(from)))];
      --change[at(std::lround(std::ceil(to)))];
      change[0] += wraps;
      change[meridians] -= wraps;
    };
    for (auto f = static_cast<Face>(first); f < static_cast<Face>(last); ++f) {
      const float a = angles[at(topology.vertex(f, 0))], b = angles[at(topology.vertex(f, 1))],
                  c = angles[at(topology.vertex(f, 2))];
      cross(a, b);
      cross(b, c);
      cross(c, a);
    }
  });
  std::vector<int> crossed(meridians, 0);
  int sum = 0;
  for (size_t m = 0; m < meridians; ++m) {
    for (const Changes& change : parts) sum += change[m];
    crossed[m] = sum;
  }
  return crossed;
}

}  // namespace

bool folds_in_chart(const Vector3& a, const Vector3& b, const Vector3& c) {
  constexpr double pi = std::numbers::pi;
  const std::array<Vector3, 3> x{a, b, c};
  // θ of each corner, ϕ of each; two more fill the lanes.
  std::array<double, 8> sines, cosines, angles;
  sines.fill(0), cosines.fill(1);
  for (size_t i = 0; i < 3; ++i) {
    const double r = x[i].head<2>().norm();
    if (r == 0) return false;
    sines[i] = x[i].y(), cosines[i] = x[i].x();
    sines[i + 3] = r, cosines[i + 3] = x[i].z();
  }
  elementary::atan2(sines, cosines, angles);
  const double *theta = angles.data(), *phi = theta + 3;
  const auto short_way = [&](size_t i, size_t j) {
    const double d = theta[j] - theta[i];
    return d > pi ? d - 2 * pi : (d < -pi ? d + 2 * pi : d);
  };
  const double ab = short_way(0, 1), bc = short_way(1, 2), ca = short_way(2, 0);
  if (std::abs(ab + bc + ca) > pi) return false;  // once around a pole
  // East is +θ, north is −ϕ: counter-clockwise on the sphere is clockwise in (θ, ϕ).
  return ab * (phi[2] - phi[0]) + ca * (phi[1] - phi[0]) >= 0;
}

AxisChoice choose_axis(const Topology& topology, const RestTriangles& source, const SphereMap& map,
                       const AxisOptions& options) {
  require_at_least("candidates", options.candidates, 1);
  const Points axes = spread_directions(options.candidates);
  const Survey survey = survey_triangles(topology, source, map, Axes(axes), options.threads);
  Points centres(cell_count, 3);
  for (int i = 0; i < cell_count; ++i) centres.row(i) = cell_centre(i);
  std::vector<double> spread(at(axes.rows()));
  parallel_for(axes.rows(), candidate_grain, options.threads,
               [&](std::int64_t first, std::int64_t last) {
                 for (std::int64_t k = first; k < last; ++k) {
                   spread[at(k)] = density_spread(survey.cells, centres, axes.row(k));
                 }
               });
  const std::vector<double> fold_score = standardised(survey.folds, 1);
  const std::vector<double> density_score = standardised(spread, least_density_deviation);
  size_t best = 0;
  const auto score = [&](size_t k) { return fold_score[k] + density_score[k]; };
  for (size_t k = 1; k < spread.size(); ++k) {
    if (score(k) < score(best)) best = k;
  }
  double balance = 0;  // of the source's area between the half spheres
  AxisChoice choice{axes.row(static_cast<Eigen::Index>(best))};
  for (int i = 0; i < cell_count; ++i) {
    balance += survey.cells[at(i)].area * choice.axis.dot(centres.row(i));
  }
  if (balance < 0) choice.axis = -choice.axis;
  choice.folds = survey.folds[best];
  choice.mean_folds = mean(survey.folds);
  choice.density_spread = spread[best];
  choice.mean_density_spread = mean(spread);
  return choice;
}

double choose_meridian(const Topology& topology, const SphereMap& map, int threads) {
  const std::vector<int> crossed =
      count_crossings(topology, angles_in_meridians(map, threads), threads);
  const auto best = std::ranges::min_element(crossed) - crossed.begin();
  const double d = 4.0 * static_cast<double>(best) / meridians;  // back to (x, y)
  const double y = d <= 1 ? d : (d <= 3 ? 2 - d : d - 4);
  const double x = (d <= 1 || d >= 3) ? 1 - std::abs(y) : std::abs(y) - 1;
  const double theta = elementary::atan2(y, x);
  return theta < 0 ? theta + 2 * std::numbers::pi : theta;
}

}  // namespace sphparam
