#include "io/formats/gltf/gltf_nodes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "number_text.h"
#include "sphparam/io/losses.h"

// The nodes of a scene form trees; each is visited once, with the product of the transforms above
// it. The stack is our own: trees may be as deep as they like.

namespace sphparam {
namespace {

class NodeWalk {
 public:
  NodeWalk(const GltfDocument& document, const std::string& name, std::vector<std::string>& notes)
      : document_(document), name_(name), notes_(notes) {}

  std::vector<int> roots() {
    if (!document_.scenes.empty()) {
      const int scene = std::max(document_.default_scene, 0);
      if (scene >= static_cast<int>(document_.scenes.size()))
        fail("scene " + std::to_string(scene) + " is not there");
      if (document_.scenes.size() > 1)
        add_loss(notes_, "all scenes but number " + std::to_string(scene) + " of " +
                             std::to_string(document_.scenes.size()));
      return document_.scenes[static_cast<std::size_t>(scene)];
    }
    // Without a scene: every node that is no child.
    std::vector<char> is_child(document_.nodes.size());
    for (const GltfDocument::Node& node : document_.nodes)
      for (const int child : node.children)
        if (child >= 0 && child < static_cast<int>(is_child.size()))
          is_child[static_cast<std::size_t>(child)] = 1;
    std::vector<int> roots;
    for (std::size_t node = 0; node < is_child.size(); ++node)
      if (!is_child[node]) roots.push_back(static_cast<int>(node));
    return roots;
  }

  PlacedScene visit(const std::vector<int>& roots) const {
    PlacedScene placed;
    std::vector<int> flat, hidden;
    placed.nodes.resize(document_.nodes.size());
    std::vector<char> seen(document_.nodes.size());
    std::vector<Visit> waiting;
    const auto wait_for = [&](const std::vector<int>& nodes, const Transform& above, bool is_seen) {
      for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
        if (*node < 0 || *node >= static_cast<int>(document_.nodes.size()))
          fail("node " + std::to_string(*node) + " is not there");
        if (std::exchange(seen[static_cast<std::size_t>(*node)], 1))
          fail("node " + std::to_string(*node) + " has two parents");
        waiting.push_back({*node, above, is_seen});
      }
    };
    wait_for(roots, {}, true);
    while (!waiting.empty()) {
      const Visit here = waiting.back();
      waiting.pop_back();
      const GltfDocument::Node& node = document_.nodes[static_cast<std::size_t>(here.node)];
      const Transform transform = here.above * local_transform(here.node);
      const bool is_seen = here.is_seen && !node.is_hidden;
      placed.nodes[static_cast<std::size_t>(here.node)] = transform;
      if (node.mesh >= 0) {
        check_placement(here.node, transform);
        if (!is_seen)
          hidden.push_back(here.node);
        else if (transform.linear.determinant() == 0)
          flat.push_back(here.node);
        else
          placed.meshes.push_back({node.mesh, here.node, transform});
      }
      wait_for(node.children, transform, is_seen);
    }
    leave_out(flat, placed, "scale to nothing", "its transform is singular");
    leave_out(hidden, placed, "hide", "it is hidden, as all else is (KHR_node_visibility)");
    return placed;
  }

 private:
  struct Visit {
    int node;
    Transform above;
    bool is_seen;  // no node above hides it
  };

  [[noreturn]] void fail(const std::string& message) const { throw ReadError(name_, message); }

  void check_placement(int id, const Transform& transform) const {
    const int mesh = document_.nodes[static_cast<std::size_t>(id)].mesh;
    if (mesh >= static_cast<int>(document_.meshes.size()))
      fail("mesh " + std::to_string(mesh) + " is not there");
    if (!std::isfinite(transform.linear.determinant()))
      fail("node " + std::to_string(id) + ": its transform is not finite");
  }

  /// Exporters hide things by a scale of 0, or by a word: KHR_node_visibility.
  void leave_out(const std::vector<int>& nodes, const PlacedScene& placed, const char* how,
                 const char* nothing_left) const {
    if (nodes.empty()) return;
    const std::string first = "node " + std::to_string(nodes.front());
    if (placed.meshes.empty()) fail(first + ": " + nothing_left);
    const auto count = static_cast<long>(nodes.size());
    add_loss(notes_, counted(count, "mesh", "meshes") + " that nodes " + how + ", as " + first);
  }

  Transform local_transform(int id) const {
    const GltfDocument::Node& node = document_.nodes[static_cast<std::size_t>(id)];
    const auto check = [&](bool good, const char* message) {
      if (!good) fail("node " + std::to_string(id) + ": " + message);
    };
    const auto has_size = [](const std::vector<double>& numbers, std::size_t size) {
      return numbers.empty() || numbers.size() == size;
    };
    check(has_size(node.matrix, 16) && has_size(node.translation, 3) &&
              has_size(node.rotation, 4) && has_size(node.scale, 3),
          "its transform has the wrong number of numbers");
    if (!node.matrix.empty()) {
      const Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
      check(matrix.row(3) == Eigen::RowVector4d(0, 0, 0, 1), "its matrix is not affine");
      return {matrix.topLeftCorner<3, 3>(), matrix.topRightCorner<3, 1>()};
    }
    const auto or_else = [](const std::vector<double>& numbers, double otherwise) {
      return numbers.empty() ? Vector3(Vector3::Constant(otherwise))
                             : Vector3(Eigen::Map<const Vector3>(numbers.data()));
    };
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    if (const auto& r = node.rotation; !r.empty())
      rotation = Eigen::Quaterniond(r[3], r[0], r[1], r[2]);
    check(rotation.norm() > 0, "its rotation is zero");
    return composed(or_else(node.translation, 0), rotation, or_else(node.scale, 1));
  }

  const GltfDocument& document_;
  const std::string& name_;
  std::vector<std::string>& notes_;
};

}  // namespace

Transform composed(const Vector3& translation, const Eigen::Quaterniond& rotation,
                   const Vector3& scale) {
  return {rotation.normalized().toRotationMatrix() * scale.asDiagonal(), translation};
}

PlacedScene place_scene(const GltfDocument& document, const std::string& name,
                        std::vector<std::string>& notes) {
  NodeWalk walk(document, name, notes);
  return walk.visit(walk.roots());
}

}  // namespace sphparam
