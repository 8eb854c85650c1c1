#include "worn_glove.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace glissade::test_support {
namespace {

using hands::kJoints;

devices::SimulatedGloveParameters wearer(const grasping::Posture& fist,
                                         std::vector<std::chrono::nanoseconds> grip_changes) {
  devices::SimulatedGloveParameters parameters;
  std::copy_n(fist.values.begin(), kJoints, parameters.grasp_posture.begin());
  parameters.open_posture.emplace().fill(0.0);
  parameters.starts_closed = false;
  parameters.grip_changes = std::move(grip_changes);
  return parameters;
}

devices::GloveState unseen(devices::GloveState state) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  state.X_WH.translation().fill(kNaN);
  state.joint_angles.fill(kNaN);
  return state;
}

}  // namespace

WornGlove::WornGlove(const geometry::TriangleMesh& object, const Eigen::Isometry3d& X_WB,
                     geometry::PoseTrajectory script_X_WR, const grasping::Posture& fist,
                     std::vector<std::chrono::nanoseconds> grip_changes)
    : hand(object, X_WB),
      glove_(std::move(script_X_WR), wearer(fist, std::move(grip_changes))),
      forces_(haptics::finger_hand(grasping::make_hand()), glove_.descriptor()),
      envelope_(glove_.descriptor()) {}

void WornGlove::run(int milliseconds) {
  for (int i = 0; i < milliseconds; ++i)
    step();
}

void WornGlove::step() {
  constexpr int kPatience_ms = 20;  // without a target, before the clasp is told
  const hands::JointValues before = glove_.state().joint_angles;
  glove_.step(std::chrono::milliseconds(1), command_);
  for (std::size_t i = 0; i < kJoints; ++i) {
    const double moved = glove_.state().joint_angles[i] - before[i];
    const double friction = descriptor().joint_damping * moved / 1e-3;
    energy_ += (friction - command_.values().joint_torques[i]) * moved;
  }

  const bool is_seen = lost_for_-- <= 0;
  lost_for_ = std::max(lost_for_, 0);
  silent_for_ = is_seen ? 0 : silent_for_ + 1;
  const devices::GloveState told = is_seen ? glove_.state() : unseen(glove_.state());
  if (silent_for_ == kPatience_ms) hand.clasp.lose_track();
  hand.clasp.advance({told.X_WH, {told.joint_angles.begin(), told.joint_angles.end()}});
  rows_.tell(hand.clasp, hand.clasp.contacts(), 0, answer_);
  wanted_ = forces_.update(told.joint_angles, answer_);
  devices::GloveCommand command{.sequence = told.sequence, .state_sequence = told.sequence, .state_time = told.time};
  command.joint_torques = wanted_;
  command_ = envelope_.limit(command, told, told.time);
}

}  // namespace glissade::test_support
