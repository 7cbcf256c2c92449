#pragma once

#include <limits>
#include <vector>

#include "rays/ray_scene.h"
#include "rays/scene_frame.h"

namespace sphparam {

/// A search for the nearest point of a mesh, as it goes on: whoever has a tree comes to triangles
/// with it, and passes over those that lie beyond what it says.
class NearestSearch {
 public:
  /// near_enough: squared; the search ends with a point that is as near. faces: of the mesh, by the
  /// numbers that the tree has for them. All but the number outlive it.
  NearestSearch(const TriangleMesh& mesh, const std::vector<Face>& faces, const SceneFrame& frame,
                const Vector3& point, double near_enough);

  const Vector3& point() const { return point_; }
  /// What a tree in floats is to be searched about, in coordinates of the frame: the point, or one
  /// on the way to it where it is far away.
  const Vector3& centre() const { return centre_; }
  bool is_far_away() const { return widening_ > 0; }
  const NearestPoint& best() const { return best_; }
  /// Squared, from the point: a box farther than that has nothing to offer.
  double beyond() const { return beyond_; }
  /// The same from `centre`, in coordinates of the frame.
  float radius() const;
  /// The same where only what is near enough is of interest.
  float radius_of_near_enough() const;
  void pass_over_what_is_not_near_enough();

  /// Is this face nearer than the best so far? Then it is the best.
  bool consider(Face face);
  /// The same of the face with this number; false too where the search has ended.
  bool come_to(unsigned number);
  bool ends() const { return best_.squared_distance <= near_enough_; }
  /// How many numbers it came to.
  int visited() const { return visited_; }

 private:
  bool is_beyond_best(const Vector3& a, const Vector3& b, const Vector3& c) const;
  double widened_square(double squared) const;
  float widened(double known) const;

  const TriangleMesh& mesh_;
  const std::vector<Face>& faces_;
  const SceneFrame& frame_;
  const Vector3& point_;
  const double near_enough_;  // squared; where triangles are piled up, all of them are near
  const double slack_;        // of squared distances of boxes
  int visited_ = 0;
  double beyond_ = std::numeric_limits<double>::infinity();
  Vector3 centre_;       // p, or p' where p is far away; local
  double widening_ = 0;  // of the squared radius
  NearestPoint best_ = {{-1, Vector3::Zero()}, std::numeric_limits<double>::infinity()};
  Vector3 foot_ = Vector3::Zero();  // of the best; local
};

}  // namespace sphparam
