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

template <typename Body>
collision::ObjectDescription description(const std::shared_ptr<const Body>& body, const Eigen::Isometry3d& X_WB,
                                         int group) {
  return {{body, &body->tree}, {body, &body->hull}, X_WB, group};
}

}  // namespace

Surroundings::Surroundings(std::vector<Obstacle> obstacles, const std::shared_ptr<const SlidingPart>& part_V,
                           double greatest_reach)
    : obstacles_(std::move(obstacles)),
      world_(static_cast<int>(obstacles_.size()) + 1),
      pipeline_(world_, clock_, pipeline_options(greatest_reach)) {
  if (obstacles_.empty()) throw std::invalid_argument("there is nothing that the part could touch");
  world_.ignore_groups(kObstacles, kObstacles);
  for (Obstacle& obstacle : obstacles_) {
    const std::optional<Eigen::Isometry3d> X_WO = collision::rigid_pose(obstacle.X_WO);
    if (!X_WO) throw std::invalid_argument("the pose of " + obstacle.name + " is not a rotation and translation");
    obstacle.X_WO = *X_WO;
    world_.add(description(obstacle.body, obstacle.X_WO, kObstacles));
  }
  part_ = world_.add(description(part_V, Eigen::Isometry3d::Identity(), kPart));
}

const collision::FrameResult& Surroundings::look_around(const Eigen::Isometry3d& X_WV, double reach) {
  if (!world_.move(part_, X_WV)) throw std::invalid_argument("the part cannot be at a pose that is none");
  const collision::FrameResult& frame = pipeline_.step(reach);
  ++frames_;
  sum_ += frame.report;
  return frame;
}

}  // namespace glissade::haptics
