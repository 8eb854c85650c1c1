#pragma once

/// The work that a call of the simulation may still do.

#include <cstdint>
#include <limits>

namespace glissade::contact {

/// More work than any call does.
inline constexpr std::int64_t kUnlimitedWork = std::numeric_limits<std::int64_t>::max();

/// Counts down, in the unit of `collision::WorkMeter`: about a nanosecond of an ordinary processor, counted and never
/// measured, so that the same inputs give the same bits on every machine.
struct WorkBudget {
  std::int64_t left = kUnlimitedWork;  ///< negative by what the last indivisible piece took too much

  void spend(std::int64_t work) { left -= work; }
  bool is_used_up() const { return left <= 0; }
};

}  // namespace glissade::contact
