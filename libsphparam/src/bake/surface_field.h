#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/mesh/surface_point.h"

namespace sphparam {

struct HeatScale;
struct TexelRun;

/// What the values of a field are, and so how they may be filtered and stored.
enum class FieldKind : std::uint8_t {
  Colour,     // sRGB in [0, 1] as stored; averaged in linear light
  Data,       // averaged as it is, never colour-converted
  Direction,  // unit vectors: averaged, then made unit again; stored as ½ + ½·n in integers
  Label,      // never averaged: the value at the texel's centre
  Place,      // numbers that have no mean, as longitudes at ±180°: those at the texel's centre
};

/// Whether values of neighbouring places make a value.
inline bool has_means(FieldKind kind) {
  return kind != FieldKind::Label && kind != FieldKind::Place;
}

/// How a texel found its point of the source.
enum class Found : std::uint8_t {
  Here,         // by the map; or along the normal, on what faces the same way
  Back,         // along the normal, on what faces the other way
  Nearest,      // the normal's line met nothing near: the nearest point, …
  NearestBack,  // … on what faces the other way
};
/// Whether it is no more than the nearest point.
inline bool is_nearest(Found found) {
  return found == Found::Nearest || found == Found::NearestBack;
}

/// A point of the source surface that a texel asks for.
struct SurfaceSample {
  SurfacePoint point;       // in the source mesh
  std::uint64_t seed;       // of the texel and sample: the same for any number of threads and tiles
  SurfacePoint place = {};  // in the chart that the image is for (chart.triangles, chart.wedges)
  // What the weights change by from a sample to the next one, and to the row below.
  Vector3 step = Vector3::Zero(), below = Vector3::Zero();
  Found found = Found::Here;
  float wall = 0;  // how much of it a wall hides: see CalmWalls
};

/// Samples of neighbouring texels of a row on one face of the source: the i-th has the barycentric
/// weights first + i·step, some roundings outside the face at most.
struct SurfaceRun {
  Face face;
  int count;
  Vector3 first, step;
  Vector3 below;  // what the weights change by from a row to the next
  Found found = Found::Here;
};

/// Whether it is the back of the source that is seen: its normals are turned round then.
inline bool is_back(Found found) { return found == Found::Back || found == Found::NearestBack; }

/// Something that has a value everywhere on the source mesh: a texture, a property, what rays see.
struct SurfaceField {
  std::string name;  // "position", "scalar:thickness"
  int channels = 1;  // 1, 3 or 4; one more with coverage, but never more than 4
  /// The last channel is coverage: 1 on the surface, 0 on fillers; averaged as it is, whatever the
  /// kind. Else a fourth one of colours is alpha.
  bool has_coverage = false;
  FieldKind kind = FieldKind::Data;
  std::string about = {};   // one line for metadata: unit, space, convention
  std::string unit = {};    // "m", "degree"; empty: none, or nobody knows
  bool eight_bits = false;  // data that need no more, where integers may have them
  std::vector<std::pair<std::string, std::string>> texts = {};  // more metadata of its own
  // Where values of integer images come from and go to; none: known only once all are baked.
  std::optional<std::pair<double, double>> range = std::nullopt;
  // What is added to values and range, a channel: far from 0, for their extent, float32 would round
  // away what tells them apart. 0 elsewhere.
  std::array<double, 3> origin = {};
  // Of colours that stand for numbers: see `as_heat`. Null: of all others, and of labels whose
  // table has colours.
  std::shared_ptr<const HeatScale> scale = nullptr;
  bool calm = false;         // shows nothing of what walls hide: see CalmWalls
  bool clear_walls = false;  // and its alpha is 0 there

  /// Fills values[channels·i …] for sample i. Called from many threads at once.
  std::function<void(std::span<const SurfaceSample> samples, float* values)> evaluate = {};
  /// The same for runs, the values of all in their order. For fields that can do with less than a
  /// whole sample a texel, and for those that want to know how large a texel is on the surface;
  /// `evaluate` is not called then. Colours are linear here: to be averaged they would be made so.
  std::function<void(std::span<const SurfaceRun> runs, float* values)> evaluate_runs = {};
  /// Changes values once they are there, by how much of each a wall hides and where it lies in the
  /// chart; colours are linear.
  std::function<void(std::span<const float> hidden, std::span<const TexelRun> places,
                     float* values)>
      amend = {};

  /// What is to be told once all values are there; null, or an empty text: nothing.
  std::function<std::string()> remark = {};

  /// Of the values proper: those of the kind.
  int proper_channels() const { return has_coverage ? channels - 1 : channels; }
  bool is_far() const { return origin != std::array<double, 3>{}; }
  /// Of a channel, coverage too.
  double origin_of(int channel) const {
    return channel < std::min(proper_channels(), 3) ? origin[static_cast<size_t>(channel)] : 0;
  }
};

}  // namespace sphparam
