#include <algorithm>
#include <chrono>
#include <cmath>

#include <glissade/base/assert.h>
#include <glissade/geometry/rigid_pose.h>
#include <glissade/haptics/multi_part_sliding.h>

#include "sliding/contact_report.h"
#include "sliding/search_radius.h"
#include "sliding/simulated_parts.h"
#include "sliding/sliding_constants.h"
#include "sliding/starts.h"
#include "sliding/step_finder.h"

namespace glissade::haptics {

/// The whole cycle: look around, project, certify, move. It repeats until all parts have arrived or hardly move any
/// more.
class MultiPartSliding::Cycle {
 public:
  Cycle(std::vector<Obstacle> obstacles, const std::vector<HeldPart>& parts, const SlidingRules& rules)
      : shared_(std::move(obstacles), parts, rules),
        step_finder_(shared_),
        starts_(shared_, parts, kTouching * step_finder_.certain_distance()) {}

  const SimulatedParts& shared() const { return shared_; }
  HeldPartState& part(std::size_t number) {
    GLISSADE_ASSERT(number < shared_.count());
    return shared_.states[number];
  }

  void grasp(std::size_t number, const Eigen::Isometry3d& X_WG) {
    if (part(number).grasp(X_WG)) step_finder_.rows().forget_forces();
  }

  void release(std::size_t number) {
    part(number).result.X_WG = part(number).result.X_WV;
    part(number).rest(SlidingState::kReleased);
    step_finder_.rows().forget_forces();
  }

  void advance(std::span<const Eigen::Isometry3d> X_WG, double milliseconds) {
    time_ += std::chrono::duration<double, std::milli>(milliseconds);
    if (!follow_ghosts(X_WG, milliseconds)) return;
    starts_.depenetrate(kSlew_m * milliseconds);
    int cycles = 1;
    while (!take_step(milliseconds, cycles == shared_.rules.max_cycles))
      ++cycles;
    report_contacts(shared_, starts_.overlaps(), step_finder_.rows().all_contacts(), milliseconds);
    // With several parts the contacts are reported where the last step has led.
    const double reach =
        shared_.count() == 1 ? radius_.reach_ahead() : std::max(0.0, radius_.reach_ahead() - radius_.last_step());
    for (HeldPartState& part : shared_.states) {
      if (part.is_held()) part.end_tick(cycles, reach, milliseconds);
    }
  }

 private:
  /// In units of `StepFinder::certain_distance`: bodies closer than this count as overlapping at the start.
  static constexpr double kTouching = 4.0;

  /// Moves the ghosts of held parts to those poses that are rigid, and those of scripted parts to their scripts.
  /// Returns whether any ghost was moved.
  bool follow_ghosts(std::span<const Eigen::Isometry3d> X_WG, double milliseconds) {
    bool any = false;
    double ghosts = 0.0;
    for (std::size_t p = 0; p < shared_.count(); ++p) {
      HeldPartState& part = shared_.states[p];
      part.begin_tick();
      const std::optional<Eigen::Isometry3d> rigid =
          geometry::rigid_pose(part.script ? part.script->pose_at(time_) : X_WG[p]);
      if (!part.is_held() || !rigid) continue;
      any = true;
      part.follow(*rigid, milliseconds);
      ghosts += part.ghost_motion;
    }
    // One part may push another as fast as its own ghost moves.
    for (HeldPartState& part : shared_.states)
      part.slew = part.metaphor == Metaphor::kForceFeedback ? kSlew_m * milliseconds + ghosts : kUnbounded;
    return any;
  }

  /// One cycle. Returns whether it was the last: `is_last`, or another one is not worth it.
  bool take_step(double milliseconds, bool is_last) {
    radius_.choose(shared_, starts_.depenetration(), milliseconds);
    if (radius_.look(shared_, starts_.overlaps().pairs())) starts_.restore_min_clearances();
    step_finder_.look(radius_.reach());
    const Step step = step_finder_.find();
    const bool all_arrived = std::all_of(step.arrives.begin(), step.arrives.begin() + std::ssize(shared_.states),
                                         [](bool arrives) { return arrives; });
    const bool ends = is_last || all_arrived || step.length < kNotWorthIt * shared_.largest_margin;
    if (ends && radius_.reach_ahead() > radius_.reach()) step_finder_.rows().find_ahead(radius_.reach_ahead());
    move(step);
    radius_.note(step);
    for (std::size_t p = 0; p < shared_.count(); ++p) {
      HeldPartState& part = shared_.states[p];
      if (part.is_held() && starts_.overlaps().way_out_of(p) == nullptr) part.turn_target();
    }
    return ends;
  }

  void move(const Step& step) {
    step_finder_.rows().take_forces(step_finder_.forces());
    for (std::size_t p = 0; p < shared_.count(); ++p) {
      HeldPartState& part = shared_.states[p];
      if (!part.is_held()) continue;
      // An arrival copies the pose at which the part aimed, so that the coupling wrench is zero and not merely small.
      // Standing still keeps every bit.
      if (step.arrives[p]) {
        part.result.X_WV = part.X_WS;
      } else if (step.lengths[p] > 0.0) {
        part.result.X_WV = geometry::displaced(part.result.X_WV, part.p_Vref(), step.displacements[p]);
      }
      part.moved += step.lengths[p];
      if (step.lengths[p] > 0.0 || step.arrives[p]) shared_.scene.place(p, part.result.X_WV);
    }
    shared_.candidates.moved();
  }

  SimulatedParts shared_;
  StepFinder step_finder_;
  Starts starts_;
  SearchRadius radius_;
  std::chrono::duration<double, std::milli> time_{0.0};  // since the simulation began
};

MultiPartSliding::MultiPartSliding(std::vector<Obstacle> obstacles, const std::vector<HeldPart>& parts,
                                   const SlidingRules& rules)
    : cycle_(std::make_unique<Cycle>(std::move(obstacles), parts, rules)) {}

MultiPartSliding::MultiPartSliding(MultiPartSliding&&) noexcept = default;
MultiPartSliding& MultiPartSliding::operator=(MultiPartSliding&&) noexcept = default;
MultiPartSliding::~MultiPartSliding() = default;

void MultiPartSliding::grasp(std::size_t part, const Eigen::Isometry3d& X_WG) {
  GLISSADE_ASSERT(!is_scripted(part));
  if (const std::optional<Eigen::Isometry3d> rigid = geometry::rigid_pose(X_WG)) cycle_->grasp(part, *rigid);
}

void MultiPartSliding::release(std::size_t part) {
  GLISSADE_ASSERT(!is_scripted(part));
  cycle_->release(part);
}

void MultiPartSliding::advance(std::span<const Eigen::Isometry3d> X_WG, double milliseconds) {
  GLISSADE_ASSERT(X_WG.size() == part_count());
  GLISSADE_ASSERT(milliseconds >= 0.0 && std::isfinite(milliseconds));
  cycle_->advance(X_WG, milliseconds);
}

std::size_t MultiPartSliding::part_count() const {
  return cycle_->shared().count();
}

const SlidingResult& MultiPartSliding::result(std::size_t part) const {
  return cycle_->part(part).result;
}

const SlidingPart& MultiPartSliding::part(std::size_t part) const {
  return *cycle_->part(part).part_V;
}

const CouplingStiffness& MultiPartSliding::stiffness(std::size_t part) const {
  return cycle_->part(part).stiffness;
}

double MultiPartSliding::margin(std::size_t part) const {
  return cycle_->part(part).margin;
}

bool MultiPartSliding::is_scripted(std::size_t part) const {
  return cycle_->part(part).is_scripted();
}

std::size_t MultiPartSliding::obstacle_count() const {
  return cycle_->shared().scene.obstacles().size();
}

geometry::Displacement MultiPartSliding::error(std::size_t part) const {
  return cycle_->part(part).lag();
}

const SearchStatistics& MultiPartSliding::search_statistics() const {
  return cycle_->shared().candidates.statistics();
}

const ContactScene& MultiPartSliding::scene() const {
  return cycle_->shared().scene;
}

}  // namespace glissade::haptics
