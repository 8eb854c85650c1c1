#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include <glissade/base/assert.h>
#include <glissade/contact/multi_part_sliding.h>
#include <glissade/geometry/displacement.h>

#include "cycle/contact_report.h"
#include "cycle/search_radius.h"
#include "cycle/simulated_parts.h"
#include "cycle/sliding_constants.h"
#include "cycle/starts.h"
#include "cycle/step_finder.h"
#include "cycle/step_forecast.h"
#include "work/work_budget.h"

namespace glissade::contact {

/// The whole cycle: look around, project, certify, move. It repeats until all parts have arrived or hardly move any
/// more, or the work of a call is used up. A cycle that has to wait for the next call goes on there with the ghosts
/// with which it began; so its result is that of a simulation that is called less often.
class MultiPartSliding::Cycle {
 public:
  Cycle(std::vector<Obstacle> obstacles, const std::vector<HeldPart>& parts, const std::vector<RiderChain>& chains,
        const SlidingRules& rules)
      : shared_(std::move(obstacles), parts, chains, rules), step_finder_(shared_), starts_(shared_) {
    if (!shared_.seats.empty()) measure_levers();
  }

  const SimulatedParts& shared() const { return shared_; }
  const CallStatistics& statistics() const { return statistics_; }
  std::int64_t answered_call() const { return answered_call_; }
  bool is_within_cycle() const { return step_finder_.is_under_way() || waits_for_search_; }
  HeldPartState& part(std::size_t number) {
    GLISSADE_ASSERT(number < shared_.count());
    return shared_.states[number];
  }

  void grasp(std::size_t number, const Eigen::Isometry3d& X_WG, const Eigen::Vector3d& p_Vref) {
    step_finder_.give_up();  // the answer under way goes on with another cycle
    part(number).grasp(X_WG, p_Vref);
    forecast_.forget();
    tell_reference(number);
  }

  void release(std::size_t number) {
    step_finder_.give_up();  // the answer under way goes on with another cycle
    part(number).result.X_WG = part(number).result.X_WV;
    part(number).rest(SlidingState::kReleased);
    forecast_.forget();
    part(number).p_Vref = part(number).part_V->p_Vref();
    tell_reference(number);
  }

  void place_riders(std::size_t chain, std::span<const Eigen::Isometry3d> X_WB) {
    step_finder_.give_up();  // the answer under way goes on with another cycle
    shared_.riders.place(chain, X_WB) ? shared_.candidates.clear() : shared_.candidates.moved();
    measure_levers();
  }

  void remove_riders(std::size_t chain) {
    step_finder_.give_up();
    shared_.riders.remove(chain);
    shared_.candidates.clear();
    measure_levers();
  }

  void attach(std::size_t chain, std::int32_t part) {
    step_finder_.give_up();
    shared_.riders.attach(chain, part);
    shared_.candidates.clear();
    measure_levers();
  }

  void advance(std::span<const Eigen::Isometry3d> X_WG, double milliseconds) {
    time_ += std::chrono::duration<double, std::milli>(milliseconds);
    unanswered_ms_ += milliseconds;
    shared_.candidates.begin_call();
    WorkBudget budget{shared_.work_of_steps};
    ++statistics_.calls;
    bool is_complete = !is_under_way_ || go_on(budget);
    if (is_complete) is_complete = !budget.is_used_up() && (!begin(X_WG) || go_on(budget));
    for (HeldPartState& part : shared_.states)
      part.result.ended_early = !is_complete;
    statistics_.ended_early += is_complete ? 0 : 1;
    statistics_.unsettled_friction = step_finder_.unsettled_friction();
    statistics_.most_work = std::max(statistics_.most_work, shared_.work_of_steps - budget.left);
  }

 private:
  /// In the reach of this call: what is found at its end serves for the next one, whose ghosts may move a little
  /// faster.
  static constexpr double kReachOfNextCall = 1.05;

  enum class Progress { kNextCycle, kDone, kUsedUp };

  /// Begins to answer these ghosts. Returns whether there is anything to do.
  bool begin(std::span<const Eigen::Isometry3d> X_WG) {
    milliseconds_ = std::exchange(unanswered_ms_, 0.0);
    begun_call_ = statistics_.calls;
    if (!follow_ghosts(X_WG)) {
      answered_call_ = statistics_.calls;
      return false;
    }
    leave_seats();
    starts_.depenetrate(kSlew_m * milliseconds_);
    is_under_way_ = true;
    cycles_ = 0;
    parts_to_forecast_.clear();
    for (const HeldPartState& part : shared_.states)
      parts_to_forecast_.push_back({part.metaphor, part.lever});
    forecast_.begin_call(parts_to_forecast_, shared_.largest_margin, shared_.smallest_margin);
    return true;
  }

  /// Goes on with the answer. Returns false if the budget is used up before it is complete.
  bool go_on(WorkBudget& budget) {
    Progress progress = Progress::kNextCycle;
    while (progress == Progress::kNextCycle && !(cycles_ > 0 && budget.is_used_up()))
      progress = take_step(budget);
    if (progress == Progress::kUsedUp) return false;
    for (HeldPartState& part : shared_.states) {
      if (part.is_held()) part.end_tick(milliseconds_);
    }
    is_under_way_ = false;
    return progress == Progress::kDone;
  }

  /// Moves the ghosts of held parts to those poses that are rigid, and those of scripted parts to their scripts.
  /// Returns whether any ghost was moved.
  bool follow_ghosts(std::span<const Eigen::Isometry3d> X_WG) {
    bool any = false;
    double ghosts = 0.0;
    for (std::size_t p = 0; p < shared_.count(); ++p) {
      HeldPartState& part = shared_.states[p];
      part.begin_tick();
      const std::optional<Eigen::Isometry3d> rigid =
          geometry::rigid_pose(part.script ? part.script->pose_at(time_) : X_WG[p]);
      if (!part.is_held() || !rigid) continue;
      any = true;
      part.follow(*rigid, milliseconds_);
      ghosts += part.ghost_motion;
    }
    // One part may push another as fast as its own ghost moves.
    for (HeldPartState& part : shared_.states)
      part.slew = traits_of(part.metaphor).limits_speed ? kSlew_m * milliseconds_ + ghosts : kUnbounded;
    return any;
  }

  /// One cycle, or the rest of one. It is the last if no more are allowed, or if another one is not worth it.
  Progress take_step(WorkBudget& budget) {
    if (!step_finder_.is_under_way()) {
      radius_.choose(shared_, starts_.depenetration(), milliseconds_, cycles_ == 0);
      find_ignored();
      if (radius_.look(shared_, ignored_)) starts_.restore_min_clearances();
      waits_for_search_ = !shared_.candidates.covers(radius_.needed());
      if (waits_for_search_) return waits_for_next_call() ? Progress::kUsedUp : Progress::kNextCycle;
      step_finder_.look(radius_.reach(), radius_.reach_ahead(), budget);
    }
    const std::optional<Step> step = step_finder_.find(budget);
    if (!step) return Progress::kUsedUp;
    ++cycles_;
    answered_call_ = begun_call_;
    const bool all_arrived = std::all_of(step->arrives.begin(), step->arrives.begin() + std::ssize(shared_.states),
                                         [](bool arrives) { return arrives; });
    forecast_.note(*step);
    // A step that lacks candidates tells nothing of those that follow.
    const bool is_cut_off = step->is_reach_short || step->is_uncovered;
    bool is_done =
        cycles_ == shared_.rules.max_cycles || all_arrived || (!is_cut_off && forecast_.is_remainder_worthless());
    const bool looks_again = is_done && !budget.is_used_up() && is_elsewhere(*step);
    double reach = step_finder_.rows().complete();
    if (!looks_again && (is_done || budget.is_used_up())) reach = step_finder_.rows().find_ahead(budget);
    move(*step);
    radius_.note(shared_, *step);
    if (looks_again) {
      const StepForecast::Lengths left = look_where_it_led(budget);
      // The forecast was wrong where a contact begins or ends.
      is_done = cycles_ == shared_.rules.max_cycles || forecast_.goes_in_circle() || forecast_.is_worthless(left);
      reach = is_done || budget.is_used_up() ? step_finder_.rows().find_ahead(budget) : step_finder_.rows().complete();
    }
    if (is_done) radius_.prepare_next(shared_, ignored_);
    for (std::size_t p = 0; p < shared_.count(); ++p) {
      HeldPartState& part = shared_.states[p];
      if (part.is_held() && !starts_.is_pushed_out(p)) part.turn_target();
    }
    if (shared_.count() > 1 && !looks_again) reach = std::max(0.0, reach - radius_.last_step());
    report(reach);
    return is_done ? Progress::kDone : Progress::kNextCycle;
  }

  /// Without a budget, a search that was too large is followed by a smaller one at once.
  bool waits_for_next_call() const { return shared_.rules.work_budget || !radius_.has_shrunk(); }

  /// Whether the step has led pushed parts so far that the contacts at its beginning tell little of those at its end.
  bool is_elsewhere(const Step& step) const {
    return !step_finder_.forces().empty() && step.length > kNotWorthIt * shared_.largest_margin;
  }

  /// Finds the contacts where the last step has led, with their forces: the hand feels these until the next answer, and
  /// the next step begins with them. Returns how far the parts would still go.
  StepForecast::Lengths look_where_it_led(WorkBudget& budget) {
    radius_.choose(shared_, starts_.depenetration(), milliseconds_, true);
    step_finder_.look(kReachOfNextCall * radius_.reach(), kReachOfNextCall * radius_.reach_ahead(), budget);
    const StepForecast::Lengths left = step_finder_.find_forces(budget);
    step_finder_.rows().take_forces(step_finder_.forces());
    for (HeldPartState& part : shared_.states)
      part.result.X_WV_of_contacts = part.result.X_WV;
    return left;
  }

  void leave_seats() {
    if (!starts_.leave_seats()) return;
    shared_.candidates.clear();
    measure_levers();
  }

  /// The pairs of bodies that no search looks at: those of seats, and those that keep their distance.
  void find_ignored() {
    ignored_ = shared_.riders.inert_pairs();
    const auto sorted = std::ssize(ignored_);
    ignored_.insert(ignored_.end(), starts_.ignored().begin(), starts_.ignored().end());
    std::inplace_merge(ignored_.begin(), ignored_.begin() + sorted, ignored_.end());
  }

  void tell_reference(std::size_t number) {
    shared_.scene.set_p_Vref(number, part(number).p_Vref);
    measure_levers();
  }

  void measure_levers() {
    for (std::size_t p = 0; p < shared_.count(); ++p) {
      HeldPartState& part = shared_.states[p];
      part.lever = std::max(shared_.scene.lever(p), shared_.riders.lever(static_cast<std::int32_t>(p)));
    }
  }

  void move(const Step& step) {
    step_finder_.rows().take_forces(step_finder_.forces());
    for (std::size_t p = 0; p < shared_.count(); ++p) {
      HeldPartState& part = shared_.states[p];
      part.result.X_WV_before_step = part.result.X_WV_of_contacts = part.result.X_WV;
      if (!part.is_held()) continue;
      // An arrival copies the pose at which the part aimed, so that the coupling wrench is zero and not merely small.
      // Standing still keeps every bit.
      if (step.arrives[p]) {
        part.result.X_WV = part.X_WS;
      } else if (step.lengths[p] > 0.0) {
        part.result.X_WV = geometry::displaced(part.result.X_WV, part.p_Vref, step.displacements[p]);
      }
      part.moved += step.lengths[p];
      if (step.lengths[p] == 0.0 && !step.arrives[p]) continue;
      shared_.scene.place(p, part.result.X_WV);
      shared_.riders.follow(static_cast<std::int32_t>(p));
    }
    shared_.candidates.moved();
  }

  /// Reports the cycle: its contacts within `reach`, and where it has led. With several parts the contacts are reported
  /// where the step has led.
  void report(double reach) {
    report_contacts(shared_, starts_.ways_out(), step_finder_.rows().all_contacts(), milliseconds_);
    for (HeldPartState& part : shared_.states) {
      if (part.is_held()) part.end_cycle(cycles_, reach);
    }
  }

  SimulatedParts shared_;
  StepFinder step_finder_;
  Starts starts_;
  SearchRadius radius_;
  StepForecast forecast_;
  std::vector<PartToForecast> parts_to_forecast_;  // scratch memory
  std::vector<BodyPair> ignored_;
  CallStatistics statistics_;
  std::chrono::duration<double, std::milli> time_{0.0};  // since the simulation began
  double unanswered_ms_ = 0.0;                           // since the ghosts that the newest answer is for
  // Of the answer under way, or of the last one:
  bool is_under_way_ = false;
  bool waits_for_search_ = false;
  double milliseconds_ = 0.0;
  int cycles_ = 0;
  std::int64_t begun_call_ = 0;
  std::int64_t answered_call_ = 0;  // whose ghosts the poses answer
};

MultiPartSliding::MultiPartSliding(std::vector<Obstacle> obstacles, const std::vector<HeldPart>& parts,
                                   const SlidingRules& rules, const std::vector<RiderChain>& chains)
    : cycle_(std::make_unique<Cycle>(std::move(obstacles), parts, chains, rules)) {}

MultiPartSliding::MultiPartSliding(MultiPartSliding&&) noexcept = default;
MultiPartSliding& MultiPartSliding::operator=(MultiPartSliding&&) noexcept = default;
MultiPartSliding::~MultiPartSliding() = default;

void MultiPartSliding::grasp(std::size_t part, const Eigen::Isometry3d& X_WG) {
  grasp(part, X_WG, this->part(part).p_Vref());
}

void MultiPartSliding::grasp(std::size_t part, const Eigen::Isometry3d& X_WG, const Eigen::Vector3d& p_Vref) {
  GLISSADE_ASSERT(!is_scripted(part));
  GLISSADE_ASSERT((p_Vref - this->part(part).p_Vref()).norm() <= kFarthestPoint * this->part(part).radius());
  if (const std::optional<Eigen::Isometry3d> rigid = geometry::rigid_pose(X_WG)) cycle_->grasp(part, *rigid, p_Vref);
}

void MultiPartSliding::release(std::size_t part) {
  GLISSADE_ASSERT(!is_scripted(part));
  cycle_->release(part);
}

void MultiPartSliding::place_riders(std::size_t chain, std::span<const Eigen::Isometry3d> X_WB) {
  GLISSADE_ASSERT(chain < cycle_->shared().riders.chain_count());
  cycle_->place_riders(chain, X_WB);
}

void MultiPartSliding::remove_riders(std::size_t chain) {
  GLISSADE_ASSERT(chain < cycle_->shared().riders.chain_count());
  cycle_->remove_riders(chain);
}

void MultiPartSliding::attach(std::size_t chain, std::size_t part) {
  GLISSADE_ASSERT(chain < cycle_->shared().riders.chain_count() && part < part_count());
  cycle_->attach(chain, static_cast<std::int32_t>(part));
}

void MultiPartSliding::detach(std::size_t chain) {
  GLISSADE_ASSERT(chain < cycle_->shared().riders.chain_count());
  cycle_->attach(chain, ContactScene::kStands);
}

void MultiPartSliding::advance(std::span<const Eigen::Isometry3d> X_WG, double milliseconds) {
  GLISSADE_ASSERT(X_WG.size() == part_count());
  GLISSADE_ASSERT(milliseconds >= 0.0 && std::isfinite(milliseconds));
  cycle_->advance(X_WG, milliseconds);
}

bool MultiPartSliding::is_within_cycle() const {
  return cycle_->is_within_cycle();
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

const Eigen::Vector3d& MultiPartSliding::p_Vref(std::size_t part) const {
  return cycle_->part(part).p_Vref;
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

std::int32_t MultiPartSliding::part_of_body(std::int32_t body) const {
  return cycle_->shared().scene.leader(body);
}

geometry::Displacement MultiPartSliding::lag(std::size_t part) const {
  return cycle_->part(part).lag();
}

const SearchStatistics& MultiPartSliding::search_statistics() const {
  return cycle_->shared().candidates.statistics();
}

const CallStatistics& MultiPartSliding::call_statistics() const {
  return cycle_->statistics();
}

std::int64_t MultiPartSliding::answered_call() const {
  return cycle_->answered_call();
}

const ContactScene& MultiPartSliding::scene() const {
  return cycle_->shared().scene;
}

}  // namespace glissade::contact
