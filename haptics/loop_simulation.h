#pragma once

/// The simulation's side of the haptic loop, as `HapticServer`, `run_offline` and `Replay` use it.

#include <cstddef>
#include <memory>

#include <Eigen/Geometry>

#include <glissade/contact/multi_part_sliding.h>
#include <glissade/haptics/contact_set.h>

namespace glissade::haptics {

/// Parts that hands lead, and possibly hands with fingers that move among them. Deterministic: the same calls give the
/// same bits. Not thread-safe.
class LoopSimulation {
 public:
  virtual ~LoopSimulation() = default;

  virtual const contact::MultiPartSliding& parts() const = 0;

  /// Hands begin to hold the part, or hold it anew, with its ghost at X_WG; the last one lets go of it. As
  /// `MultiPartSliding::grasp` and `MultiPartSliding::release`.
  virtual void take_part(std::size_t part, const Eigen::Isometry3d& X_WG) = 0;
  virtual void leave_part(std::size_t part) = 0;

  /// Everything moves for `milliseconds`: parts that hands hold towards their ghosts, hands with fingers towards their
  /// postures. A hand holds what `ghosts` say.
  virtual void advance(const Ghosts& ghosts, double milliseconds) = 0;

  /// Writes the answers for hands with fingers into `set`. Their decisions take effect with the ghosts that tell them.
  virtual void tell_hands(ContactSet& set) const = 0;

 protected:
  LoopSimulation() = default;
  LoopSimulation(const LoopSimulation&) = default;
  LoopSimulation& operator=(const LoopSimulation&) = default;
};

/// Parts in the loop; their hands have no fingers.
class PartsInLoop final : public LoopSimulation {
 public:
  /// `parts` must outlive this object.
  explicit PartsInLoop(contact::MultiPartSliding& parts) : parts_(parts) {}

  const contact::MultiPartSliding& parts() const override { return parts_; }
  void take_part(std::size_t part, const Eigen::Isometry3d& X_WG) override { parts_.grasp(part, X_WG); }
  void leave_part(std::size_t part) override { parts_.release(part); }
  void advance(const Ghosts& ghosts, double milliseconds) override;
  void tell_hands(ContactSet& /*set*/) const override {}

 private:
  contact::MultiPartSliding& parts_;
};

/// What a loop runs: a simulation of hands and parts, or of parts alone.
class SimulationInLoop {
 public:
  /// What is passed must outlive this object.
  SimulationInLoop(LoopSimulation& simulation) : simulation_(&simulation, [](LoopSimulation*) {}) {}
  SimulationInLoop(contact::MultiPartSliding& parts) : simulation_(std::make_shared<PartsInLoop>(parts)) {}

  LoopSimulation& operator*() const { return *simulation_; }
  LoopSimulation* operator->() const { return simulation_.get(); }

 private:
  std::shared_ptr<LoopSimulation> simulation_;
};

}  // namespace glissade::haptics
