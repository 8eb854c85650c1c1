#pragma once

/// The simulation's side of the haptic loop.

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include <glissade/contact/multi_part_sliding.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/haptics/contact_set.h>

#include "loop/contact_set_maker.h"
#include "loop/finger_rows.h"
#include "loop/patch_maker.h"

namespace glissade::haptics {

/// Answers the ghost poses of the haptic thread, one after the other. Not thread-safe.
class Answerer {
 public:
  /// Lets go of all parts without a script, which hands may take later. `simulation` must outlive this object.
  explicit Answerer(grasping::GraspSimulation& simulation);

  /// The set before the first answer.
  ContactSet at_start();

  /// Grasps and releases of `ghosts` happen first, then all parts move for the time since the last call, which is
  /// `first` at the first one. Where this call is late, parts and hands go through the motion since the last call in
  /// steps: a hand that closes while it arrives would otherwise arrive as a fist. The numbers of the sets are 1, 2, 3,
  /// … The time of a set is that of the ghosts which its poses answer: older ones where the work of a call did not
  /// suffice for the newest. The answer takes the place of `set`, which must be new or an older one of this object.
  void answer(const Ghosts& ghosts, std::chrono::nanoseconds first, ContactSet& set);

 private:
  void advance(const Ghosts& ghosts, double milliseconds);
  void tell_hands(ContactSet& set);
  std::chrono::nanoseconds time_of_answered() const;

  grasping::GraspSimulation& simulation_;
  const contact::MultiPartSliding& sliding_;
  std::int64_t calls_before_;                             // of `MultiPartSliding::advance`, by others
  std::array<std::int64_t, contact::kMaxParts> holds_{};  // those that the simulation knows
  std::optional<Ghosts> answered_;
  /// The times of the ghosts of the last calls of the simulation, by their numbers: more than a set may be old before
  /// its force has faded.
  std::array<std::chrono::nanoseconds, 1024> times_{};
  std::int64_t calls_ = 0;
  std::int64_t sequence_ = 0;
  std::vector<UrgentContact> scratch_;
  PatchMaker patches_;
  FingerRows fingers_;
  std::vector<Eigen::Isometry3d> X_WG_;        // of each part
  std::vector<grasping::HandTarget> targets_;  // of each hand
};

}  // namespace glissade::haptics
