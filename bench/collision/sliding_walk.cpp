#include "sliding_walk.h"

#include <algorithm>
#include <cmath>

namespace glissade::bench {
namespace {

using collision::DopTree;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kTurn = 0.05;   // random change of the directions of motion per step
constexpr double kNormal = 0.5;  // share of a step that goes towards or away from A

class Walker {
 public:
  Walker(const DopTree& tree_A, const DopTree& tree_B, const SlidingStep& step, std::uint64_t seed)
      : tree_A_(tree_A), tree_B_(tree_B), step_(step), source_(tree_A, tree_B, seed) {}

  // Moves to a position at the distance `gap` from A.
  void start(double gap) {
    do {
      R_AB_ = source_.rotation();
      const Vector3d axis = source_.direction();
      if (const auto distance = source_.approach(R_AB_, axis, gap)) {
        p_AB_ = *distance * axis;
        return;
      }
    } while (true);
  }

  std::vector<Isometry3d> walk(const SlidingPhase& phase, std::size_t frames) {
    steps_to_sink_ = phase.gap < 0.0 ? static_cast<int>(-phase.gap / (kNormal * step_.length)) : 0;
    std::vector<Isometry3d> poses;
    while (poses.size() < frames) {
      advance(std::max(phase.gap, 0.0), phase.gap < 0.0);
      poses.push_back(pose(R_AB_, p_AB_));
    }
    return poses;
  }

 private:
  // Moves towards A if farther away than the gap, otherwise away from it. Inside, it first sinks and then moves along.
  void advance(double gap, bool inside) {
    const Vector3d outward = p_AB_.norm() > step_.length ? Vector3d(p_AB_.normalized()) : Vector3d::UnitX();
    const bool close = collision::intersects(tree_A_, tree_B_, pose(R_AB_, p_AB_), workspace_, gap);
    double normal = close ? kNormal : -kNormal;
    if (inside && close) {
      normal = steps_to_sink_ > 0 ? -kNormal : 0.0;
      --steps_to_sink_;
    }
    along_ = (along_ + kTurn * source_.direction()).normalized();
    const Vector3d tangent = (along_ - along_.dot(outward) * outward).normalized();
    p_AB_ += step_.length * (normal * outward + std::sqrt(1.0 - normal * normal) * tangent);
    spin_ = (spin_ + kTurn * source_.direction()).normalized();
    R_AB_ = Eigen::Quaterniond(Eigen::AngleAxisd(step_.angle, spin_) * R_AB_).normalized().toRotationMatrix();
  }

  const DopTree& tree_A_;
  const DopTree& tree_B_;
  SlidingStep step_;
  PoseSource source_;
  collision::QueryWorkspace workspace_;
  Matrix3d R_AB_ = Matrix3d::Identity();
  Vector3d p_AB_ = Vector3d::Zero();
  Vector3d along_ = Vector3d::UnitX();
  Vector3d spin_ = Vector3d::UnitZ();
  int steps_to_sink_ = 0;
};

}  // namespace

std::vector<std::vector<Isometry3d>> sliding_walk(const DopTree& tree_A, const DopTree& tree_B,
                                                  const std::vector<SlidingPhase>& phases, std::size_t frames,
                                                  const SlidingStep& step, std::uint64_t seed) {
  Walker walker(tree_A, tree_B, step, seed);
  walker.start(std::max(phases.front().gap, 0.0));
  std::vector<std::vector<Isometry3d>> parts;
  for (const SlidingPhase& phase : phases)
    parts.push_back(walker.walk(phase, frames));
  return parts;
}

}  // namespace glissade::bench
