#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <glissade/collision/rigid_pose.h>
#include <glissade/haptics/surroundings.h>

namespace glissade::haptics {
namespace {

constexpr int kObstacles = 0;  // groups of the interest matrix
constexpr int kPart = 1;

// The other processors belong to the haptic thread and to whoever shows the scene.
collision::PipelineOptions pipeline_options(double greatest_reach) {
  return {.query = collision::PairQuery::kClosePairs, .greatest_distance = greatest_reach, .threads = 1};
}

void check_margin(double margin, const std::string& whose) {
  if (margin > 0.0 && margin <= kGreatestMargin_m) return;
  throw std::invalid_argument("the margin " + whose + " is " + std::to_string(1e3 * margin) +
                              " mm; it must be positive and at most " + std::to_string(1e3 * kGreatestMargin_m) +
                              " mm");
}

template <typename Body>
collision::ObjectDescription description(const std::shared_ptr<const Body>& body, const Eigen::Isometry3d& X_WB,
                                         int group) {
  return {{body, &body->tree}, {body, &body->hull}, X_WB, group};
}

}  // namespace

Surroundings::Surroundings(std::vector<Obstacle> obstacles, std::vector<std::shared_ptr<const SlidingPart>> parts,
                           std::span<const double> margins, double greatest_reach)
    : obstacles_(std::move(obstacles)),
      parts_(std::move(parts)),
      world_(static_cast<int>(obstacles_.size() + parts_.size())),
      pipeline_(world_, clock_, pipeline_options(greatest_reach)) {
  if (obstacles_.size() + parts_.size() < 2) throw std::invalid_argument("there is nothing that the part could touch");
  world_.ignore_groups(kObstacles, kObstacles);
  for (Obstacle& obstacle : obstacles_) {
    const std::optional<Eigen::Isometry3d> X_WO = collision::rigid_pose(obstacle.X_WO);
    if (!X_WO) throw std::invalid_argument("the pose of " + obstacle.name + " is not a rotation and translation");
    if (obstacle.margin) check_margin(*obstacle.margin, "of " + obstacle.name);
    obstacle.X_WO = *X_WO;
    world_.add(description(obstacle.body, obstacle.X_WO, kObstacles));
    bodies_.push_back({obstacle.body.get(), obstacle.X_WO});
  }
  for (const double margin : margins) {
    check_margin(margin, "of a part");
    for (const Obstacle& obstacle : obstacles_)
      margins_.push_back(obstacle.margin.value_or(margin));
    for (const double other : margins)
      margins_.push_back(std::min(margin, other));
  }
  for (const double margin : margins_)
    floors_.push_back(kFloorOfMargin * margin);
  for (const auto& part_V : parts_) {
    part_ids_.push_back(world_.add(description(part_V, Eigen::Isometry3d::Identity(), kPart)));
    bodies_.push_back({part_V.get(), Eigen::Isometry3d::Identity()});
  }
}

void Surroundings::place(std::size_t part, const Eigen::Isometry3d& X_WV) {
  if (!world_.move(part_ids_[part], X_WV)) throw std::invalid_argument("the part cannot be at a pose that is none");
  bodies_[body_of_part(part)].X_WB = X_WV;
}

const collision::FrameResult& Surroundings::look_around(double reach) {
  const collision::FrameResult& frame = pipeline_.step(reach);
  ++frames_;
  sum_ += frame.report;
  return frame;
}

}  // namespace glissade::haptics
