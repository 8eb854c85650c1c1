#include "search/near_pairs.h"

#include <cmath>
#include <limits>

#include <glissade/collision/dop_query.h>

#include "certificate/separating_planes.h"
#include "search/round_down.h"

namespace glissade::contact {
namespace {

/// Fraction of the margin: the gap from which on box pairs are accepted, and triangle pairs are not measured. Contacts
/// hold parts one margin apart, and certificates need the minimum clearance only.
constexpr double kEnough = 0.6;
static_assert(kEnough > kMinClearanceOfMargin);

constexpr double kAllDistances = std::numeric_limits<double>::infinity();

/// Work of taking over and sorting a pair, in the unit of `collision::WorkMeter`: rough, and high rather than low.
constexpr std::int64_t kWorkOfPair = 400;

/// Accepts box pairs that the plane of the flat side of either box separates.
class PairSearch final : public collision::DualTreeVisitor {
 public:
  PairSearch(const BodyPair& bodies, const PlacedBody& obstacle, const PlacedBody& part, double margin,
             const SearchRange& range, collision::WorkMeter* meter, std::vector<NearPair>& pairs,
             std::vector<PairToCertify>& boxes)
      : bodies_(bodies),
        obstacle_(obstacle),
        part_(part),
        X_OV_(relative_pose(obstacle.X_WB, part.X_WB)),
        enough_(kEnough * margin),
        range_(range),
        meter_(meter),
        pairs_(pairs),
        boxes_(boxes) {}

  const collision::DopTree& tree_O() const { return obstacle_.body->tree; }
  const collision::DopTree& tree_V() const { return part_.body->tree; }
  const Eigen::Isometry3d& X_OV() const { return X_OV_; }
  double enough() const { return enough_; }

  bool accepts(const collision::TreeChild& child_O, const collision::TreeChild& child_V) override {
    if (!is_sought(child_O, child_V)) return false;
    const collision::Obb& box_O = obstacle_.body->obbs->box(child_O.node, child_O.child);
    const collision::Obb& box_V = part_.body->obbs->box(child_V.node, child_V.child);
    if (box_O.radius < 0.0 || box_V.radius < 0.0) return true;  // an empty box
    const Eigen::Vector3d between_O = X_OV_ * box_V.c - box_O.c;
    for (const Eigen::Vector3d& n_O : {box_O.axes.col(0).eval(), (X_OV_.linear() * box_V.axes.col(0)).eval()}) {
      const double along = n_O.dot(between_O);
      const double gap =
          std::abs(along) - box_O.extent_along(n_O) - box_V.extent_along(X_OV_.linear().transpose() * n_O);
      if (gap < enough_) continue;
      begin_pair();
      boxes_.push_back({bodies_, child_of(*obstacle_.body, child_O.node, child_O.child),
                        child_of(*part_.body, child_V.node, child_V.child), static_cast<double>(round_down(gap)),
                        obstacle_.X_WB.linear() * (along < 0.0 ? (-n_O).eval() : n_O)});
      return true;
    }
    return false;
  }

  void visit(const collision::NearTriangles& pair) override {
    const bool may_yield_contact = obstacle_.body->topology.can_stop_each_other(
        pair.triangles.triangle_A, part_.body->topology, pair.triangles.triangle_B);
    add(pair, may_yield_contact, true);
  }
  void visit_below_accepted(const collision::NearTriangles& pair) override { add(pair, true, false); }

 private:
  /// Marks of nodes: those of their children below which all, or some, triangles count for contacts with others that
  /// do, too.
  static const std::vector<std::uint8_t>& marks_of_whole(const ContactBody& body) {
    return body.features.whole_children();
  }
  static const std::vector<std::uint8_t>& marks_of_any(const ContactBody& body) {
    return body.features.at_least_half().nodes;
  }
  static bool is_marked(const std::vector<std::uint8_t>& marks, const collision::TreeChild& child) {
    return (marks[child.node] >> child.child & 1U) != 0;
  }

  bool is_sought(const collision::TreeChild& child_O, const collision::TreeChild& child_V) const {
    const auto are_marked = [&](const auto& marks_of) {
      return is_marked(marks_of(*obstacle_.body), child_O) && is_marked(marks_of(*part_.body), child_V);
    };
    switch (range_.sought) {
      case SoughtPairs::kWithDistances:
        return true;
      case SoughtPairs::kWithPlanes:
        return !are_marked(marks_of_whole);
      case SoughtPairs::kWithPlanesInCloseFit:
        return !are_marked(marks_of_any);
    }
    return true;
  }

  void begin_pair() {
    if (pairs_.size() + boxes_.size() >= range_.most_pairs) throw TooManyPairs{};
    if (meter_ != nullptr) meter_->spend(kWorkOfPair);
  }

  void add(const collision::NearTriangles& pair, bool may_yield_contact, bool is_to_certify) {
    begin_pair();
    pairs_.push_back({{bodies_, pair.triangles.triangle_A, pair.triangles.triangle_B},
                      obstacle_.X_WB.linear() * pair.n_A,
                      static_cast<double>(round_down(pair.gap)),
                      pair.separator == collision::Separator::kPlaneOfB,
                      may_yield_contact,
                      is_to_certify});
  }

  BodyPair bodies_;
  const PlacedBody& obstacle_;
  const PlacedBody& part_;
  Eigen::Isometry3d X_OV_;
  double enough_;  // metres
  const SearchRange& range_;
  collision::WorkMeter* meter_;
  std::vector<NearPair>& pairs_;
  std::vector<PairToCertify>& boxes_;
};

}  // namespace

PairToCertify to_certify(const NearPair& pair) {
  const auto item = [](std::int32_t triangle) {
    return TreeItem{TreeItem::Kind::kTriangle, static_cast<std::uint32_t>(triangle), nullptr};
  };
  return {pair.bodies, item(pair.obstacle_triangle), item(pair.part_triangle), pair.distance, pair.n_W};
}

void find_near_pairs(const BodyPair& bodies, const PlacedBody& obstacle, const PlacedBody& part, double margin,
                     const SearchRange& range, collision::QueryWorkspace& workspace, collision::WorkMeter* meter,
                     std::vector<NearPair>& pairs, std::vector<PairToCertify>& boxes) {
  PairSearch search(bodies, obstacle, part, margin, range, meter, pairs, boxes);
  const collision::PairSelection features{&obstacle.body->features, &part.body->features};
  collision::traverse_near(
      search.tree_O(), search.tree_V(), search.X_OV(),
      {.within = range.radius,
       .exact_below = range.sought == SoughtPairs::kWithDistances ? kAllDistances : search.enough()},
      workspace, search, &features);
}

}  // namespace glissade::contact
