#pragma once

/// Sliding contact (paper §3): the visible part follows the ghost as nearly as the obstacles allow, and is never inside
/// anything, neither at rest nor on its way. How: see `joint_sliding.h`, which does the same for several parts.

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/devices/pose_trajectory.h>
#include <glissade/haptics/joint_sliding.h>
#include <glissade/haptics/sliding_simulation.h>

namespace glissade::haptics {

struct SlidingOptions {
  Metaphor metaphor = Metaphor::kForceFeedback;
  /// By default that of `default_stiffness`: k_r = k_t ρ².
  std::optional<CouplingStiffness> stiffness{};
  SlidingRules rules{};
};

/// A part that moves on its own, or in the other hand: it follows its script as any held part follows its ghost.
struct ScriptedPart {
  std::shared_ptr<const SlidingPart> part_B;
  devices::PoseTrajectory script_X_WB;
  std::chrono::nanoseconds start{0};  ///< the script's time at which the simulation begins
  /// Against translation, and k_r = k_t ρ². By default a thousand times that of a hand, so that it pushes and is hardly
  /// pushed; as stiff as the hand it is another hand.
  double grip_N_per_m = 1e6;
  std::string name = "a moving part";  ///< for messages
};

/// The simulation of one part among obstacles, most of which stand still. Deterministic: the same calls give the same
/// bits. Not thread-safe; several simulations may share bodies.
class Sliding final : public SlidingSimulation {
 public:
  /// Throws std::invalid_argument as `JointSliding` does, of which the part is the first and the scripted ones are the
  /// others.
  Sliding(std::vector<Obstacle> obstacles, std::shared_ptr<const SlidingPart> part_V,
          const Eigen::Isometry3d& X_WV_start, const SlidingOptions& options = {},
          std::vector<ScriptedPart> scripted = {});

  void grasp(const Eigen::Isometry3d& X_WG) override { sliding_.grasp(0, X_WG); }
  void release() override { sliding_.release(0); }
  /// Scripts go on by as much, whoever holds the part, and whatever X_WG is.
  const SlidingResult& advance(const Eigen::Isometry3d& X_WG, double milliseconds = 1.0) override;

  const SlidingResult& result() const override { return sliding_.result(0); }
  const SlidingPart& part() const override { return sliding_.part(0); }
  const CouplingStiffness& stiffness() const override { return sliding_.stiffness(0); }
  double margin() const override { return sliding_.margin(0); }
  /// Metres that every certified path keeps away from obstacles without a margin of their own, unless it started
  /// nearer.
  double floor() const { return kFloorOfMargin * margin(); }
  std::span<const Eigen::Isometry3d> scripted_X_WB() const override { return scripted_X_WB_; }
  /// What is around the part.
  const Surroundings& surroundings() const { return sliding_.surroundings(); }
  /// What looking for it took.
  const SearchAccount& search_account() const { return sliding_.search_account(); }

 private:
  JointSliding sliding_;
  std::vector<ScriptedPart> scripted_;
  std::vector<Eigen::Isometry3d> scripted_X_WB_;
  std::vector<Eigen::Isometry3d> ghosts_X_WG_;           // of all parts
  std::chrono::duration<double, std::milli> time_{0.0};  // since the simulation began
};

}  // namespace glissade::haptics
