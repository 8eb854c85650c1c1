#include "sliding/step_forecast.h"

#include <algorithm>

#include "sliding/sliding_constants.h"

namespace glissade::haptics {
namespace {

/// In margins: what comes after a longer step is not told by how the last two shrank.
constexpr double kShort = 0.5;

/// What may be left to the next call: so much of the first step of the call, and at most so much of the margin, and so
/// many metres. At rest, the first step is so short that this says nothing.
constexpr double kLeftOfMotion = 0.02;
constexpr double kLeftOfMargin = 0.5;
constexpr double kLeft_m = 1e-6;

/// An earlier call tells of steps that are alike to a factor of this, and for so many calls.
constexpr double kAlike = 2.0;
constexpr int kTrustedCalls = 4;

}  // namespace

void StepForecast::begin_call(std::span<const Metaphor> parts, double largest_margin, double smallest_margin) {
  learn();
  steps_.clear();
  count_ = parts.size();
  margin_ = largest_margin;
  least_ = kNotWorthIt * largest_margin;
  // The target of the incremental metaphor starts from where the part is: nothing would be made up for.
  for (std::size_t p = 0; p < count_; ++p)
    most_left_[p] = parts[p] == Metaphor::kIncremental ? 0.0 : std::min(kLeftOfMargin * smallest_margin, kLeft_m);
}

/// Learns from the steps of the last call, if nothing shortened or turned them.
void StepForecast::learn() {
  for (Seen& seen : seen_)
    seen.calls += seen.calls > 0 ? 1 : 0;
  if (steps_.size() < 2) return;
  seen_.resize(std::max(seen_.size(), steps_.size()));
  const bool all_plain = std::all_of(steps_.begin(), steps_.end(), [](const Step& step) { return step.is_plain; });
  Lengths rest{};
  for (std::size_t p = 0; p < count_; ++p)
    rest[p] = std::min(rest_by_shrinking(p), steps_.back().lengths[p]);
  for (std::size_t i = steps_.size() - 1; i-- > 0;) {
    for (std::size_t p = 0; p < count_; ++p)
      rest[p] += steps_[i + 1].lengths[p];
    seen_[i] = all_plain ? Seen{steps_[i].lengths, rest, 1} : Seen{};
  }
}

void StepForecast::note(const Step& step) {
  steps_.push_back(step);
}

bool StepForecast::is_rest_worthless() const {
  if (steps_.back().length < least_) return true;
  if (!steps_.back().is_plain) return false;
  for (std::size_t p = 0; p < count_; ++p) {
    const double enough = std::max(least_, std::min(kLeftOfMotion * steps_.front().lengths[p], most_left_[p]));
    if (!(std::min(rest_by_shrinking(p), rest_by_earlier_call(p)) < enough)) return false;
  }
  return true;
}

/// Steps on the same contacts shrink by a constant factor at the least, as those of Newton's method do.
double StepForecast::rest_by_shrinking(std::size_t p) const {
  if (steps_.size() < 2 || steps_.back().length > kShort * margin_) return kUnbounded;
  const double before = steps_[steps_.size() - 2].lengths[p];
  const double last = steps_.back().lengths[p];
  return last == 0.0 ? 0.0 : last < before ? last * last / (before - last) : kUnbounded;
}

/// What is left after a step is of second order in its length.
double StepForecast::rest_by_earlier_call(std::size_t p) const {
  if (seen_.size() < steps_.size()) return kUnbounded;
  const Seen& seen = seen_[steps_.size() - 1];
  if (seen.calls == 0 || seen.calls > kTrustedCalls) return kUnbounded;
  const double then = std::max(seen.step[p], least_);
  const double now = std::max(steps_.back().lengths[p], least_);
  if (now > kAlike * then || then > kAlike * now) return kUnbounded;
  return seen.rest[p] * std::max(now / then, now * now / (then * then));
}

}  // namespace glissade::haptics
