#include "sliding/search_radius.h"

#include <algorithm>
#include <cstdint>

#include "sliding/sliding_constants.h"

namespace glissade::haptics {
namespace {

constexpr double kSmallestReach_m = 30e-6;
constexpr double kTicksAhead = 16.0;  // of the ghosts' motion
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

void SearchRadius::choose(const SimulatedParts& shared, double depenetration, double milliseconds) {
  const double ghosts = shared.ghost_motion();
  double slew = 0.0;
  for (const HeldPartState& part : shared.states)
    slew = std::max(slew, part.slew);
  double reach = 1.5 * std::max(ghosts, last_step_) + 2.0 * shared.largest_margin;
  if (last_clipped_) reach *= 2.0;
  reach = std::max(reach, depenetration + 2.0 * shared.largest_margin);
  reach_ = std::clamp(std::min(reach, slew + ghosts + 2.0 * shared.largest_margin), kSmallestReach_m, limit_);
  const double ticks_ahead = milliseconds > 0.0 ? shared.rules.contacts_ahead_ms / milliseconds : 0.0;
  reach_ahead_ = std::max(reach_, std::min(ticks_ahead * ghosts + 2.0 * shared.largest_margin, limit_ahead_));
  const double most = std::max(limit_by_work_, 2.0 * shared.largest_margin + kSmallestReach_m);
  reach_ = std::min(reach_, most);
  reach_ahead_ = std::min(reach_ahead_, most);
}

/// Finely tessellated surfaces that lie close together have very many pairs. A part that falls behind would look
/// farther with every search and so fall behind more; the limit on the reach ends that. Contacts ahead are a help that
/// must not make the answers late: their limit comes first. The look-ahead is limited only so that no search takes too
/// many calls: half of it makes a search little cheaper, but there are twice as many.
bool SearchRadius::look(SimulatedParts& shared, std::span<const BodyPair> ignored) {
  const double ahead = std::min(std::max(kTicksAhead * shared.ghost_motion(), kLeastLookAhead_m), limit_of_look_);
  const bool is_other = shared.candidates.look(reach_ahead_, ahead, ignored);
  if (!shared.candidates.covers(reach_ahead_) && shared.candidates.is_too_large() &&
      std::max(limit_by_work_, limit_of_look_) > kSmallestLimitOfSearch_m) {
    shared.candidates.cancel();
    const double farther = std::max(reach_ahead_, ahead);
    for (double* limit : {&limit_by_work_, &limit_of_look_})
      *limit = std::max(0.25 * std::min(*limit, farther), kSmallestLimitOfSearch_m);
  }
  if (!is_other) return false;
  const auto adapted = [&](double limit, bool is_affordable, double smallest, double largest = kLargestReach_m) {
    return std::clamp((is_affordable ? 1.25 : 0.5) * limit, smallest, largest);
  };
  limit_ = adapted(limit_, shared.candidates.size() <= shared.rules.affordable_pairs, kSmallestReachLimit_m);
  limit_ahead_ = adapted(limit_ahead_, shared.candidates.size() <= kAffordablePairsAhead, kSmallestLimitAhead_m);
  const std::int64_t calls = std::clamp(shared.candidates.calls_served(), 1, kMostCallsOfSearch);
  const std::int64_t work = shared.candidates.work();
  limit_by_work_ = adapted(limit_by_work_, work / calls <= shared.affordable_search, kSmallestLimitOfSearch_m);
  limit_of_look_ = adapted(limit_of_look_, work / kMostCallsOfSearch <= shared.affordable_search,
                           kSmallestLimitOfSearch_m, kMostLookAhead_m);
  return true;
}

void SearchRadius::note(const Step& step) {
  last_step_ = step.length;
  last_clipped_ = step.clipped;
}

}  // namespace glissade::haptics
