#pragma once

/// The simulation's side of the haptic loop, as `HapticServer`, `run_offline` and `Replay` use it.

#include <cstddef>

#include <Eigen/Geometry>

#include <glissade/haptics/contact_set.h>

namespace glissade::haptics {

class MultiPartSliding;

/// Parts that hands lead, and possibly hands with fingers that move among them. Deterministic: the same calls give the
/// same bits. Not thread-safe.
class LoopSimulation {
 public:
  virtual ~LoopSimulation() = default;

  virtual const MultiPartSliding& parts() const = 0;

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

}  // namespace glissade::haptics
