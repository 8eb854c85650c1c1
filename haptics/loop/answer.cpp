#include "loop/answer.h"

#include <algorithm>

namespace glissade::haptics {

namespace {
constexpr double kLongestCatchUp_ms = 250.0;
}  // namespace

Answerer::Answerer(LoopSimulation& simulation)
    : simulation_(simulation),
      sliding_(simulation.parts()),
      calls_before_(sliding_.call_statistics().calls),
      patches_(sliding_) {
  for (std::size_t p = 0; p < sliding_.part_count(); ++p) {
    if (!sliding_.is_scripted(p)) simulation_.leave_part(p);
  }
}

ContactSet Answerer::at_start() const {
  ContactSet set;
  set.part_count = static_cast<std::int32_t>(sliding_.part_count());
  for (std::size_t p = 0; p < sliding_.part_count(); ++p) {
    set.parts[p].p_Vref = sliding_.p_Vref(p);
    set.parts[p].X_WV = sliding_.result(p).X_WV;
  }
  simulation_.tell_hands(set);
  return set;
}

void Answerer::answer(const Ghosts& ghosts, std::chrono::nanoseconds first, ContactSet& set) {
  for (std::size_t p = 0; p < sliding_.part_count(); ++p) {
    const GhostOfPart& ghost = ghosts.parts[p];
    if (sliding_.is_scripted(p) || ghost.hold == holds_[p]) continue;
    if (ghost.release > holds_[p]) simulation_.leave_part(p);
    if (ghost.is_held) simulation_.take_part(p, ghost.X_WG);
    holds_[p] = ghost.hold;
  }
  // An answer that takes long must not slow the parts down: the slew is a speed.
  const std::chrono::nanoseconds passed = answered_ ? ghosts.time - *answered_ : first;
  answered_ = ghosts.time;
  const double milliseconds = std::chrono::duration<double, std::milli>(passed).count();
  simulation_.advance(ghosts, std::clamp(milliseconds, 0.0, kLongestCatchUp_ms));
  ++sequence_;
  times_[static_cast<std::size_t>(sequence_) % times_.size()] = ghosts.time;
  renew_contact_set(sliding_, sequence_, time_of_answered(), scratch_, set);
  for (std::size_t p = 0; p < sliding_.part_count(); ++p)
    set.parts[p].hold = holds_[p];
  patches_.tell(set);
  simulation_.tell_hands(set);
}

std::chrono::nanoseconds Answerer::time_of_answered() const {
  const std::int64_t oldest = std::max<std::int64_t>(1, sequence_ - std::ssize(times_) + 1);
  const std::int64_t answered = std::clamp(sliding_.answered_call() - calls_before_, oldest, sequence_);
  return times_[static_cast<std::size_t>(answered) % times_.size()];
}

}  // namespace glissade::haptics
