#include "certificate/pairs_to_certify.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glissade/base/assert.h>
#include <glissade/collision/dual_tree_traversal.h>

#include "certificate/obb_access.h"
#include "certificate/separating_planes.h"

namespace glissade::haptics {
namespace {

using Kind = TreeItem::Kind;

/// Fraction of the margin: the gap from which on box pairs are accepted. Contacts hold parts one margin apart, and
/// certificates need the minimum clearance only.
constexpr double kEnough = 0.6;
static_assert(kEnough > kMinClearanceOfMargin);

/// Accepts box pairs that the plane of the flat side of either box separates.
class PairSearch final : public collision::DualTreeVisitor {
 public:
  PairSearch(const BodyPair& bodies, const PlacedBody& obstacle, const PlacedBody& part, double margin,
             std::vector<PairToCertify>& to_certify)
      : bodies_(bodies),
        obstacle_(obstacle),
        part_(part),
        X_OV_(relative_pose(obstacle.X_WB, part.X_WB)),
        enough_(kEnough * margin),
        to_certify_(to_certify) {}

  const collision::DopTree& tree_O() const { return obstacle_.body->tree; }
  const collision::DopTree& tree_V() const { return part_.body->tree; }
  const Eigen::Isometry3d& X_OV() const { return X_OV_; }

  bool accepts(const collision::TreeChild& child_O, const collision::TreeChild& child_V) override {
    const Obb& box_O = obb_tree_of(*obstacle_.body).box(child_O.node, child_O.child);
    const Obb& box_V = obb_tree_of(*part_.body).box(child_V.node, child_V.child);
    if (box_O.radius < 0.0 || box_V.radius < 0.0) return true;  // an empty box
    const Eigen::Vector3d between_O = X_OV_ * box_V.c - box_O.c;
    for (const Eigen::Vector3d& n_O : {box_O.axes.col(0).eval(), (X_OV_.linear() * box_V.axes.col(0)).eval()}) {
      const double along = n_O.dot(between_O);
      const double gap =
          std::abs(along) - box_O.extent_along(n_O) - box_V.extent_along(X_OV_.linear().transpose() * n_O);
      if (gap < enough_) continue;
      add(child_of(*obstacle_.body, child_O.node, child_O.child), child_of(*part_.body, child_V.node, child_V.child),
          gap, along < 0.0 ? (-n_O).eval() : n_O);
      return true;
    }
    return false;
  }

  void visit(const collision::ClosePair& pair) override {
    const geometry::TriangleMesh& mesh_O = tree_O().mesh();
    const geometry::TriangleMesh& mesh_V = tree_V().mesh();
    const Eigen::Vector3d n_O = (pair.p_B - pair.p_A).normalized();
    double top = -std::numeric_limits<double>::infinity();
    double bottom = std::numeric_limits<double>::infinity();
    for (int corner = 0; corner < 3; ++corner) {
      top = std::max(top, n_O.dot(mesh_O.corner(pair.triangles.triangle_A, corner)));
      bottom = std::min(bottom, n_O.dot(X_OV_ * mesh_V.corner(pair.triangles.triangle_B, corner)));
    }
    // The direction between points a few nanometres apart is ill-conditioned: it separates the triangles by less than
    // their distance.
    add({Kind::kTriangle, static_cast<std::uint32_t>(pair.triangles.triangle_A), nullptr},
        {Kind::kTriangle, static_cast<std::uint32_t>(pair.triangles.triangle_B), nullptr}, bottom - top, n_O);
  }

 private:
  void add(const TreeItem& item_O, const TreeItem& item_V, double distance, const Eigen::Vector3d& n_O) {
    to_certify_.push_back({bodies_, item_O, item_V, distance, obstacle_.X_WB.linear() * n_O});
  }

  BodyPair bodies_;
  const PlacedBody& obstacle_;
  const PlacedBody& part_;
  Eigen::Isometry3d X_OV_;
  double enough_;  // metres
  std::vector<PairToCertify>& to_certify_;
};

/// Whether the bounding spheres of two bodies are farther apart than `distance` (metres).
bool are_far_apart(const PlacedBody& a, const PlacedBody& b, double distance) {
  const collision::DopTree& tree_a = a.body->tree;
  const collision::DopTree& tree_b = b.body->tree;
  const double together = tree_a.radius() + tree_b.radius() + distance;
  return (a.X_WB * tree_a.center() - b.X_WB * tree_b.center()).squaredNorm() > together * together;
}

}  // namespace

TreeItem child_of(const ContactBody& body, std::uint32_t node, int child) {
  const collision::TreeNode head = body.tree.node(node);
  GLISSADE_ASSERT(child < head.child_count());
  return {head.is_leaf(child) ? Kind::kLeaf : Kind::kNode, head.child(child), &obb_tree_of(body).box(node, child)};
}

void find_pairs_to_certify(const ContactScene& scene, std::span<const PlacedBody> bodies, double radius,
                           std::span<const BodyPair> ignored, collision::QueryWorkspace& workspace,
                           std::vector<PairToCertify>& to_certify) {
  to_certify.clear();
  for (std::size_t part = scene.obstacles().size(); part < bodies.size(); ++part) {
    for (std::size_t other = 0; other < part; ++other) {
      if (!ContactScene::can_touch(scene.group(other), scene.group(part))) continue;
      const BodyPair pair{static_cast<std::int32_t>(other), static_cast<std::int32_t>(part)};
      if (std::binary_search(ignored.begin(), ignored.end(), pair)) continue;
      if (are_far_apart(bodies[other], bodies[part], radius)) continue;  // as most bodies are in a large scene
      PairSearch search(pair, bodies[other], bodies[part], scene.margin(pair.obstacle, pair.part), to_certify);
      collision::traverse_near(search.tree_O(), search.tree_V(), search.X_OV(), radius, workspace, search);
    }
  }
}

}  // namespace glissade::haptics
