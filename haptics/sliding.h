#pragma once

/// Sliding contact (paper §3): the visible part follows the ghost as nearly as the obstacles allow, and is never inside
/// anything, neither at rest nor on its way. How: see `joint_sliding.h`, which does the same for several parts.

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/haptics/joint_sliding.h>
#include <glissade/haptics/sliding_simulation.h>

namespace glissade::haptics {

struct SlidingOptions {
  Metaphor metaphor = Metaphor::kForceFeedback;
  /// By default that of `default_stiffness`: k_r = k_t ρ².
  std::optional<CouplingStiffness> stiffness{};
  SlidingRules rules{};
};

/// The simulation of one part among fixed obstacles. Deterministic: the same calls give the same bits.
/// Not thread-safe; several simulations may share bodies.
class Sliding final : public SlidingSimulation {
 public:
  /// Throws std::invalid_argument as `JointSliding` does.
  Sliding(std::vector<Obstacle> obstacles, std::shared_ptr<const SlidingPart> part_V,
          const Eigen::Isometry3d& X_WV_start, const SlidingOptions& options = {})
      : sliding_(std::move(obstacles),
                 {{.part_V = std::move(part_V),
                   .X_WV_start = X_WV_start,
                   .metaphor = options.metaphor,
                   .stiffness = options.stiffness}},
                 options.rules) {}

  void grasp(const Eigen::Isometry3d& X_WG) override { sliding_.grasp(0, X_WG); }
  void release() override { sliding_.release(0); }
  const SlidingResult& advance(const Eigen::Isometry3d& X_WG, double milliseconds = 1.0) override {
    sliding_.advance({&X_WG, 1}, milliseconds);
    return sliding_.result(0);
  }

  const SlidingResult& result() const override { return sliding_.result(0); }
  const SlidingPart& part() const override { return sliding_.part(0); }
  const CouplingStiffness& stiffness() const override { return sliding_.stiffness(0); }
  double margin() const override { return sliding_.margin(0); }
  /// Metres that every certified path keeps away from obstacles without a margin of their own, unless it started
  /// nearer.
  double floor() const { return kFloorOfMargin * margin(); }
  /// What is around the part.
  const Surroundings& surroundings() const { return sliding_.surroundings(); }
  /// What looking for it took.
  const SearchAccount& search_account() const { return sliding_.search_account(); }

 private:
  JointSliding sliding_;
};

}  // namespace glissade::haptics
