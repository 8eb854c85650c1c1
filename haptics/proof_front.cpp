#include <algorithm>
#include <cmath>
#include <limits>

#include <glissade/collision/triangle_distance.h>
#include <glissade/haptics/proof_front.h>

namespace glissade::haptics {
namespace {

using Kind = TreeItem::Kind;

/// Of the margin. Contacts hold parts one margin apart, and proofs want no more than the floor.
constexpr double kEnough = 0.6;
static_assert(kEnough > kFloorOfMargin);

}  // namespace

TreeItem child_of(const ContactBody& body, std::uint32_t node, int child) {
  const collision::NodeHead& head = body.tree.nodes()[node];
  return {head.is_leaf(child) ? Kind::kLeaf : Kind::kNode, head.child(child), &body.boxes.box(node, child)};
}

void ProofFront::refresh(double radius, std::span<const BodyPair> ignored) {
  radius_ = radius;
  obligations_.clear();
  const auto count = static_cast<std::int32_t>(surroundings_.bodies().size());
  for (auto part = static_cast<std::int32_t>(surroundings_.obstacles().size()); part < count; ++part) {
    for (std::int32_t other = 0; other < part; ++other) {
      if (std::find(ignored.begin(), ignored.end(), BodyPair{other, part}) == ignored.end()) search(other, part);
    }
  }
  std::stable_sort(obligations_.begin(), obligations_.end(),
                   [](const Obligation& a, const Obligation& b) { return a.distance < b.distance; });
}

std::span<const Obligation> ProofFront::within(double distance) const {
  const auto end =
      std::upper_bound(obligations_.begin(), obligations_.end(), distance,
                       [](double limit, const Obligation& obligation) { return limit < obligation.distance; });
  return {obligations_.data(), static_cast<std::size_t>(end - obligations_.begin())};
}

void ProofFront::search(std::int32_t obstacle, std::int32_t part) {
  bodies_ = {obstacle, part};
  obstacle_ = surroundings_.bodies()[static_cast<std::size_t>(obstacle)];
  part_ = surroundings_.bodies()[static_cast<std::size_t>(part)];
  enough_ = kEnough * surroundings_.margin(obstacle, part);
  const TightBox& box_O = obstacle_.body->boxes.whole();
  const TightBox& box_P = part_.body->boxes.whole();
  open({{Kind::kNode, 0, &box_O}, obstacle_.X_WB * box_O.c}, {{Kind::kNode, 0, &box_P}, part_.X_WB * box_P.c});
}

/// Takes two items on as they are if that is enough; looks into the larger one if not.
void ProofFront::open(const PlacedItem& item_O, const PlacedItem& item_P) {
  const double radius_O = item_O.item.box->radius;
  const double radius_P = item_P.item.box->radius;
  if (radius_O < 0.0 || radius_P < 0.0) return;  // nothing is in there
  const double together = radius_O + radius_P + radius_;
  if ((item_P.c_W - item_O.c_W).squaredNorm() > together * together) return;
  const Separation apart = separation(item_O, item_P);
  if (apart.gap > radius_) return;
  if (apart.gap >= enough_) {
    obligations_.push_back({bodies_.obstacle, bodies_.part, item_O.item, item_P.item, apart.gap, apart.n_W});
    return;
  }
  const bool is_leaf_O = item_O.item.kind == Kind::kLeaf;
  const bool is_leaf_P = item_P.item.kind == Kind::kLeaf;
  if (is_leaf_O && is_leaf_P) {
    search_leaves(item_O.item, item_P.item);
    return;
  }
  const bool opens_O = !is_leaf_O && (is_leaf_P || radius_O >= radius_P);
  const PlacedBody& opened = opens_O ? obstacle_ : part_;
  const std::uint32_t node = opens_O ? item_O.item.number : item_P.item.number;
  for (int c = 0; c < opened.body->tree.nodes()[node].child_count(); ++c) {
    const TreeItem child = child_of(*opened.body, node, c);
    const PlacedItem placed{child, opened.X_WB * child.box->c};
    if (opens_O) {
      open(placed, item_P);
    } else {
      open(item_O, placed);
    }
  }
}

ProofFront::Separation ProofFront::separation(const PlacedItem& item_O, const PlacedItem& item_P) const {
  const TightBox& box_O = *item_O.item.box;
  const TightBox& box_P = *item_P.item.box;
  const Eigen::Vector3d between = item_P.c_W - item_O.c_W;
  Separation best{-std::numeric_limits<double>::infinity(), between};
  const auto look = [&](const Eigen::Vector3d& axis) {
    const double along = axis.dot(between);
    const double gap = std::abs(along) - box_O.extent_along(obstacle_.X_WB.linear().transpose() * axis) -
                       box_P.extent_along(part_.X_WB.linear().transpose() * axis);
    if (gap > best.gap) best = {gap, along < 0.0 ? (-axis).eval() : axis};
  };
  for (int i = 0; i < 3; ++i) {
    look(obstacle_.X_WB.linear() * box_O.axes.col(i));
    look(part_.X_WB.linear() * box_P.axes.col(i));
    if (best.gap > radius_) return best;
  }
  return best;
}

void ProofFront::search_leaves(const TreeItem& leaf_O, const TreeItem& leaf_P) {
  const auto& triangles_O = obstacle_.body->tree.leaves()[leaf_O.number].triangle;
  const auto& triangles_P = part_.body->tree.leaves()[leaf_P.number].triangle;
  for (const std::int32_t o : triangles_O) {
    if (o < 0) continue;  // none, or without area
    const collision::TrianglePoints points_O = obstacle_.triangle_W(o);
    for (const std::int32_t p : triangles_P) {
      if (p < 0) continue;
      const collision::TriangleDistance closest = collision::triangle_distance(points_O, part_.triangle_W(p));
      if (closest.distance > radius_) continue;
      obligations_.push_back({bodies_.obstacle,
                              bodies_.part,
                              {Kind::kTriangle, static_cast<std::uint32_t>(o), nullptr},
                              {Kind::kTriangle, static_cast<std::uint32_t>(p), nullptr},
                              closest.distance,
                              (closest.p_b - closest.p_a).normalized()});
    }
  }
}

}  // namespace glissade::haptics
