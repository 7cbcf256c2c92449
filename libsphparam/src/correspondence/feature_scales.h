#pragma once

#include <map>
#include <optional>

#include "sphparam/correspondence/match.h"
#include "sphparam/mesh/topology.h"

namespace sphparam {

/// Values of two surfaces that are to agree, averaged over one distance and brought to one size.
struct FeatureField {
  Functions from, to;  // #V×k each: mean 0, mean square 1 over either surface
};

/// Values that are to agree, seen from afar and from near: a coarse level of a surface looks at
/// averages over distances that its vertices can tell.
///
/// Each column is first centred on its median and cut at three times its spread (half the range of
/// the middle 68 %), so that a few wild numbers say no more than others. Numbers that are not
/// finite count as the median. Same bits for any number of threads.
class FeatureScales {
 public:
  /// The meshes are those over which averages are taken, of the area 4π each; borrowed.
  /// Requires: `features` as `match_surfaces` does.
  FeatureScales(const TriangleMesh& from, const Topology& from_topology, const TriangleMesh& to,
                const Topology& to_topology, const MatchFeatures& features);

  /// Averages over about this distance: of distances that are powers of √2, the next greater one.
  /// Cost: that of averages, at the first call for a distance; calls at once are not safe.
  const FeatureField& at(double distance) const;
  /// As they are, but for what is cut.
  FeatureField raw() const;
  double weight() const { return weight_; }

 private:
  struct Side {
    const TriangleMesh& mesh;
    const Topology& topology;
    VectorX face_area, area;
    Functions values;
  };

  static Side side_of(const TriangleMesh& mesh, const Topology& topology, const Functions& values);
  static Functions averaged(const Side& side, double distance);

  Side from_, to_;
  double weight_;
  mutable std::map<int, FeatureField> fields_;  // by the exponent of √2
};

/// Whether finite values of it differ.
bool varies(const VectorX& values);

/// A column of features that has finite numbers on clearly more of one surface than of the other.
struct OneSidedFeature {
  Eigen::Index column;
  double here, there;  // the shares of the areas where it has
};

/// The first of them; nothing where there is none.
std::optional<OneSidedFeature> one_sided_feature(const MatchFeatures& features,
                                                 const MappedMesh& from, const MappedMesh& to);

/// Correlation of columns over a surface with these areas of its vertices: their mean.
double correlation_of(const Functions& a, const Functions& b, const VectorX& area);

}  // namespace sphparam
