#include <algorithm>
#include <cmath>
#include <limits>

#include <glissade/collision/near_visit.h>
#include <glissade/haptics/proof_front.h>

namespace glissade::haptics {
namespace {

using Kind = TreeItem::Kind;

/// Of the margin: the gap with which boxes are taken on. Contacts hold parts one margin apart, and proofs want no more
/// than the floor.
constexpr double kEnough = 0.6;
static_assert(kEnough > kFloorOfMargin);

/// Takes on pairs of boxes that the plane of the flat side of either separates.
class FrontSearch final : public collision::NearVisitor {
 public:
  FrontSearch(const BodyPair& bodies, const PlacedBody& obstacle, const PlacedBody& part, double margin,
              std::vector<Obligation>& obligations)
      : bodies_(bodies),
        obstacle_(obstacle),
        part_(part),
        X_OP_(obstacle.X_WB.inverse(Eigen::Isometry) * part.X_WB),
        enough_(kEnough * margin),
        obligations_(obligations) {}

  const collision::DopTree& tree_O() const { return obstacle_.body->tree; }
  const collision::DopTree& tree_P() const { return part_.body->tree; }
  const Eigen::Isometry3d& X_OP() const { return X_OP_; }

  bool takes(const collision::TreeChild& child_O, const collision::TreeChild& child_P) override {
    const TightBox& box_O = obstacle_.body->boxes.box(child_O.node, child_O.child);
    const TightBox& box_P = part_.body->boxes.box(child_P.node, child_P.child);
    if (box_O.radius < 0.0 || box_P.radius < 0.0) return true;  // nothing is in there
    const Eigen::Vector3d between_O = X_OP_ * box_P.c - box_O.c;
    for (const Eigen::Vector3d& n_O : {box_O.axes.col(0).eval(), (X_OP_.linear() * box_P.axes.col(0)).eval()}) {
      const double along = n_O.dot(between_O);
      const double gap =
          std::abs(along) - box_O.extent_along(n_O) - box_P.extent_along(X_OP_.linear().transpose() * n_O);
      if (gap < enough_) continue;
      add(child_of(*obstacle_.body, child_O.node, child_O.child), child_of(*part_.body, child_P.node, child_P.child),
          gap, along < 0.0 ? (-n_O).eval() : n_O);
      return true;
    }
    return false;
  }

  void visit(const collision::ClosePair& pair) override {
    const collision::TriangleMesh& mesh_O = tree_O().mesh();
    const collision::TriangleMesh& mesh_P = tree_P().mesh();
    const Eigen::Vector3d n_O = (pair.p_B - pair.p_A).normalized();
    double top = -std::numeric_limits<double>::infinity();
    double bottom = std::numeric_limits<double>::infinity();
    for (int corner = 0; corner < 3; ++corner) {
      top = std::max(top, n_O.dot(mesh_O.corner(pair.triangles.triangle_A, corner)));
      bottom = std::min(bottom, n_O.dot(X_OP_ * mesh_P.corner(pair.triangles.triangle_B, corner)));
    }
    // Of points a few nanometres apart the direction is not sharp, and keeps the triangles less apart than they are.
    add({Kind::kTriangle, static_cast<std::uint32_t>(pair.triangles.triangle_A), nullptr},
        {Kind::kTriangle, static_cast<std::uint32_t>(pair.triangles.triangle_B), nullptr}, bottom - top, n_O);
  }

 private:
  void add(const TreeItem& item_O, const TreeItem& item_P, double distance, const Eigen::Vector3d& n_O) {
    obligations_.push_back({bodies_, item_O, item_P, distance, obstacle_.X_WB.linear() * n_O});
  }

  BodyPair bodies_;
  const PlacedBody& obstacle_;
  const PlacedBody& part_;
  Eigen::Isometry3d X_OP_;
  double enough_;  // metres
  std::vector<Obligation>& obligations_;
};

/// Whether the spheres about two bodies are further apart than `distance` (metres).
bool are_far_apart(const PlacedBody& a, const PlacedBody& b, double distance) {
  const collision::DopTree& tree_a = a.body->tree;
  const collision::DopTree& tree_b = b.body->tree;
  const double together = tree_a.radius() + tree_b.radius() + distance;
  return (a.X_WB * tree_a.center() - b.X_WB * tree_b.center()).squaredNorm() > together * together;
}

}  // namespace

TreeItem child_of(const ContactBody& body, std::uint32_t node, int child) {
  const collision::NodeHead& head = body.tree.nodes()[node];
  return {head.is_leaf(child) ? Kind::kLeaf : Kind::kNode, head.child(child), &body.boxes.box(node, child)};
}

void find_obligations(const Surroundings& surroundings, std::span<const PlacedBody> bodies, double radius,
                      std::span<const BodyPair> ignored, collision::QueryWorkspace& workspace,
                      std::vector<Obligation>& obligations) {
  obligations.clear();
  for (std::size_t part = surroundings.obstacles().size(); part < bodies.size(); ++part) {
    for (std::size_t other = 0; other < part; ++other) {
      const BodyPair pair{static_cast<std::int32_t>(other), static_cast<std::int32_t>(part)};
      if (std::find(ignored.begin(), ignored.end(), pair) != ignored.end()) continue;
      if (are_far_apart(bodies[other], bodies[part], radius)) continue;  // as most are in a scene of many
      FrontSearch search(pair, bodies[other], bodies[part], surroundings.margin(pair.obstacle, pair.part), obligations);
      collision::visit_near(search.tree_O(), search.tree_P(), search.X_OP(), radius, workspace, search);
    }
  }
  std::stable_sort(obligations.begin(), obligations.end(),
                   [](const Obligation& a, const Obligation& b) { return a.distance < b.distance; });
}

}  // namespace glissade::haptics
