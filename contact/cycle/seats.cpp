#include "cycle/seats.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>

#include <glissade/collision/dop_query.h>

#include "cycle/inset.h"
#include "cycle/orientation.h"

namespace glissade::contact {
namespace {

/// Poses on a way out at which insets are looked at. Each step on it is certified in any case: this only tells whether
/// it is worth going.
constexpr int kLooksOnWay = 64;
/// Corners move farther than faces: where a corner touches, the gap of an inset may be so many times what it should be.
constexpr double kMuchOfGap = 1.02;
/// Of the margin: an open part that must move farther to be free does not only touch.
constexpr double kFarthestAside = 2.0;

/// Finds the seats of one part.
class SeatsOfPart {
 public:
  SeatsOfPart(const ContactScene& scene, std::size_t part, const std::vector<HeldPart>& parts, OverlapRule rule)
      : scene_(scene),
        part_(part),
        parts_(parts),
        rule_(rule),
        body_(static_cast<std::int32_t>(scene.body_of_mover(part))) {}

  std::vector<Seat> find(double touching) {
    for (std::int32_t other = 0; other < body_; ++other) {
      if (!are_within(std::max(touching, kApartByRounding * margin_of_inset(other)), other)) continue;
      if (std::optional<Seat> seat = seat_in(other)) {
        seats_.push_back(std::move(*seat));
      } else if (are_within(touching, other)) {
        refuse(other, may_depenetrate(other) ? ", and no way out of it can be certified" : "");
      }
    }
    for (Seat& seat : seats_) {
      if (seat.depth > seat.margin) seat.way_out_W = way_out(seat);
    }
    return std::move(seats_);
  }

 private:
  const PlacedBody& placed(std::int32_t body) const { return scene_.bodies()[static_cast<std::size_t>(body)]; }
  const SlidingPart& part_V() const { return *scene_.movers()[part_]; }
  bool is_obstacle(std::int32_t body) const { return body < std::ssize(scene_.obstacles()); }
  Eigen::Isometry3d X_OV(std::int32_t other) const {
    return placed(other).X_WB.inverse(Eigen::Isometry) * placed(body_).X_WB;
  }

  [[noreturn]] void refuse(std::int32_t other, const std::string& why) const {
    const auto number = static_cast<std::size_t>(other);
    const std::string& name =
        is_obstacle(other) ? scene_.obstacles()[number].name : parts_[number - scene_.obstacles().size()].name;
    throw std::invalid_argument(parts_[part_].name + " collides with " + name + " at its start pose" + why);
  }

  /// The margin of the inset, which is a rider.
  double margin_of_inset(std::int32_t other) const {
    if (is_obstacle(other)) return scene_.margin(other, body_);
    const auto margin = [&](std::size_t part) {
      const auto body = static_cast<std::int32_t>(scene_.body_of_mover(part));
      return scene_.margin(body, body);
    };
    return std::max(margin(part_), margin(static_cast<std::size_t>(other) - scene_.obstacles().size()));
  }

  bool may_depenetrate(std::int32_t other) const {
    return rule_ == OverlapRule::kDepenetrate && is_obstacle(other) && !parts_[part_].script;
  }

  bool are_within(double distance, std::int32_t other) {
    return collision::intersects(placed(other).body->tree, part_V().tree, X_OV(other), workspace_, distance);
  }

  std::shared_ptr<const SlidingPart> inset_at(double depth) {
    return std::make_shared<const SlidingPart>(std::make_shared<geometry::TriangleMesh>(inset_->at(depth)),
                                               part_V().p_Vref());
  }

  double gap_of(const SlidingPart& inset_V, std::int32_t other) {
    return collision::distance(placed(other).body->tree, inset_V.tree, X_OV(other), workspace_).distance;
  }

  /// Nothing where no inset is free.
  std::optional<Seat> seat_in(std::int32_t other) {
    const double margin = margin_of_inset(other);
    if (!inset_) inset_.emplace(part_V().tree.mesh());
    if (!inset_->exists()) return seat_of_open_part(other, margin);
    const auto depth = inset_->overlap(*placed(other).body, X_OV(other), kTouchingOfMargin * margin);
    if (!depth) return std::nullopt;
    if (*depth > margin && !may_depenetrate(other)) refuse(other, "");
    const double wanted = kGapOfInset * margin;
    auto inset_V = inset_at(*depth + wanted);
    double gap = gap_of(*inset_V, other);
    if (gap > kMuchOfGap * wanted) {
      inset_V = inset_at(*depth + wanted * wanted / gap);
      gap = gap_of(*inset_V, other);
    }
    const double lost = wanted - gap;  // next to nothing
    if (lost > 0.5 * kClearanceOfInset * margin) return std::nullopt;
    return Seat{{other, body_}, *depth, margin, std::move(inset_V), kClearanceOfInset * margin - std::max(0.0, lost)};
  }

  /// Nothing where no short way leads out: where the part also touches the body from the other side. A sheet that lies
  /// on a closed body may be as near to the inside of the body, which is no way out.
  std::optional<Seat> seat_of_open_part(std::int32_t other, double margin) {
    const double wanted = kGapOfInset * margin;
    const ContactBody& body = *placed(other).body;
    const Eigen::Vector3d way_O =
        collision::find_way_out(body.tree, part_V().tree, X_OV(other), workspace_, wanted).way_out_A;
    if (way_O.norm() > kFarthestAside * margin) return std::nullopt;
    for (const double side : {1.0, -1.0}) {
      const Eigen::Vector3d way_V = side * X_OV(other).linear().transpose() * way_O;
      const auto mesh = std::make_shared<geometry::TriangleMesh>(
          geometry::transformed(part_V().tree.mesh(), Eigen::Isometry3d(Eigen::Translation3d(way_V))));
      auto aside_V = std::make_shared<const SlidingPart>(mesh, part_V().p_Vref());
      const double min_clearance = kClearanceOfInset * margin;
      if (gap_of(*aside_V, other) < min_clearance || encloses(body.tree.mesh(), X_OV(other) * mesh->corner(0, 0)))
        continue;
      return Seat{{other, body_}, std::max(0.0, way_O.norm() - wanted), margin, std::move(aside_V), min_clearance};
    }
    return std::nullopt;
  }

  std::optional<Eigen::Vector3d> way_out(const Seat& seat) {
    const PlacedBody& other = placed(seat.bodies.obstacle);
    const Eigen::Vector3d way_W =
        other.X_WB.linear() *
        collision::find_way_out(other.body->tree, part_V().tree, X_OV(seat.bodies.obstacle), workspace_, seat.margin)
            .way_out_A;
    for (int i = 1; i <= kLooksOnWay; ++i) {
      if (!are_insets_free(static_cast<double>(i) / kLooksOnWay * way_W)) return std::nullopt;
    }
    return way_W;
  }

  bool are_insets_free(const Eigen::Vector3d& moved_W) {
    return std::none_of(seats_.begin(), seats_.end(), [&](const Seat& seat) {
      const PlacedBody& other = placed(seat.bodies.obstacle);
      Eigen::Isometry3d X = X_OV(seat.bodies.obstacle);
      X.translation() += other.X_WB.linear().transpose() * moved_W;
      return collision::intersects(other.body->tree, seat.inset_V->tree, X, workspace_);
    });
  }

  const ContactScene& scene_;
  std::size_t part_;
  const std::vector<HeldPart>& parts_;
  OverlapRule rule_;
  std::int32_t body_;
  std::optional<Inset> inset_;
  collision::QueryWorkspace workspace_;
  std::vector<Seat> seats_;
};

}  // namespace

std::vector<Seat> find_seats(const ContactScene& scene, const std::vector<HeldPart>& parts, OverlapRule rule,
                             double touching) {
  std::vector<Seat> seats;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    for (Seat& seat : SeatsOfPart(scene, part, parts, rule).find(touching))
      seats.push_back(std::move(seat));
  }
  return seats;
}

}  // namespace glissade::contact
