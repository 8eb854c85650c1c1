#include "cycle/search_radius.h"

#include <algorithm>
#include <cstdint>

#include "cycle/sliding_constants.h"

namespace glissade::contact {
namespace {

constexpr double kSmallestReach_m = 30e-6;
constexpr double kReachOfStep = 1.1;  // in the motion of the ghosts, or of the last step
constexpr double kMakeDo = 0.1;       // of the reach: covered candidates that suffice for the beginning of a step
constexpr double kMakeDoAhead = 0.8;  // the same of the reach of contacts ahead
constexpr double kMargins = 4.0;      // covered at least: contacts that touched keep their numbers up to three
constexpr double kTicksAhead = 16.0;  // of the ghosts' motion
constexpr double kFewSteps = 2.0;     // a look-ahead that serves for fewer is not worth its pairs, if these are many
constexpr std::size_t kFewPairs = 500;
constexpr double kShareAhead = 0.15;  // of a step: instead, for a step that leads elsewhere than expected
constexpr double kLeastLookAhead_m = 45e-6;
constexpr double kSmallestReachLimit_m = 0.2e-3;
constexpr std::size_t kAffordablePairsAhead = 3000;
constexpr double kSmallestLimitAhead_m = 50e-6;
constexpr double kSmallestLimitOfSearch_m = 60e-6;
constexpr int kMostCallsOfSearch = 4;  // over which the work of a search is spread in the account

}  // namespace

SearchRadius::SearchRadius()
    : limit_(kLargestReach_m),
      limit_ahead_(kLargestReach_m),
      limit_by_work_(kLargestReach_m),
      limit_of_look_(kMostLookAhead_m) {}

void SearchRadius::choose(const SimulatedParts& shared, double depenetration, double milliseconds,
                          bool is_first_cycle) {
  const double ghosts = shared.ghost_motion();
  double slew = 0.0;
  for (const HeldPartState& part : shared.states)
    slew = std::max(slew, part.slew);
  const double step = kReachOfStep * std::max(ghosts, last_step_);
  double reach = step + 2.0 * shared.largest_margin;
  if (was_reach_short_) reach *= 2.0;
  reach = std::max(reach, depenetration + 2.0 * shared.largest_margin);
  reach_ = std::clamp(std::min(reach, slew + ghosts + 2.0 * shared.largest_margin), kSmallestReach_m, limit_);
  const double ticks_ahead = milliseconds > 0.0 ? shared.rules.contacts_ahead_ms / milliseconds : 0.0;
  reach_ahead_ = std::max(reach_, std::min(ticks_ahead * ghosts + 2.0 * shared.largest_margin, limit_ahead_));
  const double most = std::max(limit_by_work_, 2.0 * shared.largest_margin + kSmallestReach_m);
  reach_ = std::min(reach_, most);
  reach_ahead_ = std::min(reach_ahead_, most);
  next_step_ = std::min(step, reach_);
  const bool is_cheap = shared.candidates.pairs().size() <= kFewPairs;
  least_radius_ = reach_ahead_ > reach_ || is_cheap ? reach_ahead_ : kSmallestReach_m;
  is_first_cycle_ = is_first_cycle;
}

/// Finely tessellated surfaces that lie close together have very many pairs. A part that falls behind would look
/// farther with every search and so fall behind more; the limit on the reach ends that. Contacts ahead are a help that
/// must not make the answers late: their limit comes first. The look-ahead is limited only so that no search takes too
/// many calls: half of it makes a search little cheaper, but there are twice as many.
bool SearchRadius::look(SimulatedParts& shared, std::span<const BodyPair> ignored) {
  CandidatePairs& candidates = shared.candidates;
  const double ahead = farther(shared);
  const bool has_contacts_ahead = reach_ahead_ > reach_;
  const double share = has_contacts_ahead ? kMakeDoAhead * reach_ahead_ : kMakeDo * reach_;
  const double least = std::max(share, std::min(reach_, kMargins * shared.largest_margin));
  needed_ = reach_ahead_;
  has_shrunk_ = false;
  bool is_other = false;
  if (!candidates.covers(reach_ahead_)) {
    if (is_first_cycle_) is_other = candidates.take_ahead(least, next_step_);
    const bool looks_along = missed_length_ > 0.0 && !is_other && !candidates.found_too_many();
    if (looks_along) is_other = look_along_missed(shared, std::max(least, ahead), ignored);
    if (candidates.found_too_many()) {
      shrink(candidates, std::max(needed_, ahead));
      return false;
    }
    if (candidates.covers(least) && (is_other || !looks_along)) {
      needed_ = least;
    } else if (!is_first_cycle_ && !looks_along && !has_contacts_ahead) {
      needed_ = std::min(reach_ahead_, std::max(least, 2.0 * last_step_));  // the steps of an answer mostly shrink
    }
  }
  if (candidates.look(needed_, ahead, ignored)) is_other = true;
  if (candidates.covers(needed_)) look_ahead(shared, ignored);
  if (!candidates.covers(needed_) && candidates.is_too_large()) shrink(candidates, std::max(needed_, ahead));
  if (!is_other) return false;
  const auto adapted = [&](double limit, bool is_affordable, double smallest, double largest = kLargestReach_m) {
    return std::clamp((is_affordable ? 1.25 : 0.5) * limit, smallest, largest);
  };
  limit_ = adapted(limit_, candidates.pairs().size() <= shared.rules.affordable_pairs, kSmallestReachLimit_m);
  limit_ahead_ = adapted(limit_ahead_, candidates.pairs().size() <= kAffordablePairsAhead, kSmallestLimitAhead_m);
  const std::int64_t calls = std::clamp(candidates.calls_served(), 1, kMostCallsOfSearch);
  const std::int64_t work = candidates.work();
  const auto is_affordable = [&](std::int64_t share_of_work) {
    return share_of_work <= shared.affordable_search && !candidates.are_many();
  };
  limit_by_work_ = adapted(limit_by_work_, is_affordable(work / calls), kSmallestLimitOfSearch_m);
  limit_of_look_ =
      adapted(limit_of_look_, is_affordable(work / kMostCallsOfSearch), kSmallestLimitOfSearch_m, kMostLookAhead_m);
  return true;
}

/// After a search within `wanted` (metres) that was too large: gives it up, and makes the next one smaller. The
/// smallest one goes on over more calls, or begins again with more memory.
void SearchRadius::shrink(CandidatePairs& candidates, double wanted) {
  if (std::max(limit_by_work_, limit_of_look_) > kSmallestLimitOfSearch_m) {
    candidates.cancel();
    for (double* limit : {&limit_by_work_, &limit_of_look_})
      *limit = std::max(0.25 * std::min(*limit, wanted), kSmallestLimitOfSearch_m);
    has_shrunk_ = true;
  } else if (candidates.found_too_many()) {
    candidates.allow_twice_as_many();
    has_shrunk_ = true;
  }
}

/// Makes the pairs near the way candidates that the last step has missed, as far as the reach.
bool SearchRadius::look_along_missed(SimulatedParts& shared, double least, std::span<const BodyPair> ignored) const {
  const double length = std::min(missed_length_, reach_);
  Displacements way = missed_;
  for (geometry::Displacement& d : way)
    d = d.scaled(length / missed_length_);
  return shared.candidates.look_along(shared.of_parts(way), length, least, ignored);
}

void SearchRadius::prepare_next(SimulatedParts& shared, std::span<const BodyPair> ignored) const {
  if (!shared.candidates.serve_for(next_step_)) look_ahead(shared, ignored);
}

void SearchRadius::look_ahead(SimulatedParts& shared, std::span<const BodyPair> ignored) const {
  shared.candidates.look_ahead(next_step_, least_radius_, farther(shared), ignored);
}

/// Metres that a search looks farther than the reach.
double SearchRadius::farther(const SimulatedParts& shared) const {
  const double ahead = std::min(std::max(kTicksAhead * shared.ghost_motion(), kLeastLookAhead_m), limit_of_look_);
  const bool is_worth_it = ahead >= kFewSteps * next_step_ || shared.candidates.pairs().size() <= kFewPairs;
  return is_worth_it ? ahead : std::min(ahead, kShareAhead * next_step_);
}

void SearchRadius::note(const SimulatedParts& shared, const Step& step) {
  last_step_ = step.length;
  was_reach_short_ = step.is_reach_short;
  missed_ = step.missed;
  missed_length_ = 0.0;
  if (!step.is_reach_short && !step.is_uncovered) return;
  // Not the bound of the motion, which does not grow evenly with the displacement.
  for (std::size_t p = 0; p < shared.count(); ++p)
    missed_length_ += missed_[p].v.norm() + shared.states[p].lever * missed_[p].w.norm();
}

}  // namespace glissade::contact
