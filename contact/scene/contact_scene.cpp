#include "scene/contact_scene.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <glissade/geometry/displacement.h>

namespace glissade::contact {
namespace {

void check_margin(double margin, const std::string& whose) {
  if (margin > 0.0 && margin <= kGreatestMargin_m) return;
  throw std::invalid_argument("the margin " + whose + " is " + std::to_string(1e3 * margin) +
                              " mm; it must be positive and at most " + std::to_string(1e3 * kGreatestMargin_m) +
                              " mm");
}

}  // namespace

ContactScene::ContactScene(std::vector<Obstacle> obstacles, std::vector<std::shared_ptr<const SlidingPart>> parts,
                           std::span<const double> margins)
    : ContactScene(std::move(obstacles), std::move(parts), margins.size(), margins,
                   std::vector<int>(margins.size(), kPart)) {}

ContactScene::ContactScene(std::vector<Obstacle> obstacles, std::vector<std::shared_ptr<const SlidingPart>> movers,
                           std::size_t first_rider, std::span<const double> margins, std::span<const int> groups)
    : obstacles_(std::move(obstacles)),
      movers_(std::move(movers)),
      first_rider_(first_rider),
      groups_(obstacles_.size(), kStill),
      leaders_(obstacles_.size() + movers_.size(), kStands) {
  groups_.insert(groups_.end(), groups.begin(), groups.end());
  for (std::size_t part = 0; part < first_rider; ++part) {
    leaders_[body_of_mover(part)] = static_cast<std::int32_t>(part);
    p_Vref_.push_back(movers_[part]->p_Vref());
  }
  if (obstacles_.size() + movers_.size() < 2) throw std::invalid_argument("there is nothing that the part could touch");
  for (Obstacle& obstacle : obstacles_) {
    if (obstacle.body == nullptr) throw std::invalid_argument(obstacle.name + " needs a body, not a null pointer");
    const std::optional<Eigen::Isometry3d> X_WO = geometry::rigid_pose(obstacle.X_WO);
    if (!X_WO) throw std::invalid_argument("the pose of " + obstacle.name + " is not a rotation and translation");
    if (obstacle.margin) check_margin(*obstacle.margin, "of " + obstacle.name);
    obstacle.X_WO = *X_WO;
    bodies_.push_back({obstacle.body.get(), obstacle.X_WO});
  }
  for (std::size_t mover = 0; mover < margins.size(); ++mover) {
    const double margin = margins[mover];
    check_margin(margin, "of a part");
    for (const Obstacle& obstacle : obstacles_)
      margins_.push_back(obstacle.margin.value_or(margin));
    for (std::size_t other = 0; other < margins.size(); ++other) {
      const bool is_with_rider = std::max(mover, other) >= first_rider;
      margins_.push_back(is_with_rider ? std::max(margin, margins[other]) : std::min(margin, margins[other]));
    }
  }
  for (const double margin : margins_)
    min_clearances_.push_back(kMinClearanceOfMargin * margin);
  for (const auto& mover : movers_)
    bodies_.push_back({mover.get(), Eigen::Isometry3d::Identity()});
}

Eigen::Vector3d ContactScene::p_Bref(std::size_t mover) const {
  const std::int32_t part = leaders_[body_of_mover(mover)];
  if (mover < first_rider_) return p_Vref_[mover];
  if (part == kStands) return movers_[mover]->p_Vref();
  const auto leader = static_cast<std::size_t>(part);
  const Eigen::Isometry3d& X_WB = bodies_[body_of_mover(mover)].X_WB;
  return X_WB.inverse(Eigen::Isometry) * (bodies_[body_of_mover(leader)].X_WB * p_Vref_[leader]);
}

double ContactScene::lever(std::size_t mover) const {
  return (p_Bref(mover) - movers_[mover]->p_Vref()).norm() + movers_[mover]->radius();
}

}  // namespace glissade::contact
