#include "cycle/step_forecast.h"

#include <algorithm>
#include <span>

#include <glissade/base/assert.h>

#include "cycle/sliding_constants.h"

namespace glissade::contact {
namespace {

/// In margins: only steps as short as this shrink on as they did, and at best by this factor.
constexpr double kShort = 0.5;
constexpr double kFastest = 0.1;

/// What may be left to the next call: so much of the first step of the call, and at most so much of the margin, and so
/// many metres. At rest, the first step is so short that this says nothing.
constexpr double kLeftOfMotion = 0.02;
constexpr double kLeftOfMargin = 0.5;
constexpr double kLeft_m = 1e-6;

/// Of the way of three steps: parts that come back as near as this to where they were go in a circle.
constexpr double kOpenOfCircle = 0.02;

/// An earlier call tells of steps that are alike to a factor of this, and for so many calls.
constexpr double kAlike = 2.0;
constexpr int kTrustedCalls = 4;

}  // namespace

void StepForecast::begin_call(std::span<const PartToForecast> parts, double largest_margin, double smallest_margin) {
  learn();
  steps_.clear();
  count_ = parts.size();
  margin_ = largest_margin;
  least_ = kNotWorthIt * largest_margin;
  for (std::size_t p = 0; p < count_; ++p) {
    // The target of the incremental metaphor starts from where the part is: nothing would be made up for.
    const bool makes_up = traits_of(parts[p].metaphor).makes_up;
    most_left_[p] = makes_up ? std::min(kLeftOfMargin * smallest_margin, kLeft_m) : 0.0;
    levers_[p] = parts[p].lever;
  }
}

/// Learns from the last call, if it ended because its remainder was worthless, and nothing shortened or damped a step.
void StepForecast::learn() {
  if (!steps_.empty() && !std::all_of(steps_.begin(), steps_.end(), [](const Step& step) { return step.is_plain; })) {
    seen_.clear();
    return;
  }
  const bool shrinks = steps_.size() > 1 && (steps_.back().length < least_ || !goes_in_circle());
  const bool is_whole = shrinks && is_remainder_worthless();
  Lengths remainder = is_whole ? expected_remainders() : Lengths{};
  for (Seen& seen : seen_)
    seen.calls += seen.calls > 0 && seen.calls <= kTrustedCalls ? 1 : 0;
  if (!is_whole) return;
  seen_.resize(std::max(seen_.size(), steps_.size()));
  for (std::size_t i = steps_.size() - 1; i-- > 0;) {
    for (std::size_t p = 0; p < count_; ++p)
      remainder[p] += steps_[i + 1].lengths[p];
    seen_[i] = {steps_[i].lengths, remainder, 1};
  }
}

void StepForecast::note(const Step& step) {
  steps_.push_back(step);
}

void StepForecast::forget() {
  steps_.clear();
  seen_.clear();
}

bool StepForecast::is_remainder_worthless() const {
  GLISSADE_ASSERT(!steps_.empty());
  if (steps_.back().length < least_) return true;
  if (!steps_.back().is_plain) return false;
  return goes_in_circle() || is_worthless(expected_remainders());
}

bool StepForecast::is_worthless(const Lengths& remainder) const {
  for (std::size_t p = 0; p < count_; ++p) {
    const double enough = std::max(least_, std::min(kLeftOfMotion * steps_.front().lengths[p], most_left_[p]));
    if (!(remainder[p] < enough)) return false;
  }
  return true;
}

bool StepForecast::goes_in_circle() const {
  constexpr std::size_t kStepsOfCircle = 3;
  if (steps_.size() < kStepsOfCircle) return false;
  const auto last = std::span(steps_).last(kStepsOfCircle);
  if (!std::all_of(last.begin(), last.end(), [](const Step& step) { return step.is_plain; })) return false;
  for (std::size_t p = 0; p < count_; ++p) {
    geometry::Displacement sum;
    double way = 0.0;
    for (const Step& step : last) {
      sum.v += step.displacements[p].v;
      sum.w += step.displacements[p].w;
      way += step.lengths[p];
    }
    if (geometry::motion_bound(sum, levers_[p]) > kOpenOfCircle * way) return false;
  }
  return true;
}

StepForecast::Lengths StepForecast::expected_remainders() const {
  Lengths remainder{};
  if (steps_.back().length < least_) return steps_.back().lengths;
  for (std::size_t p = 0; p < count_; ++p)
    remainder[p] = std::min(by_shrinking(p), by_earlier_call(p));
  return remainder;
}

/// Steps on the same contacts shrink by a constant factor at the least, as those of Newton's method do.
double StepForecast::by_shrinking(std::size_t p) const {
  if (steps_.size() < 2 || !steps_[steps_.size() - 2].is_plain || steps_.back().length > kShort * margin_)
    return kUnbounded;
  const double before = steps_[steps_.size() - 2].lengths[p];
  const double last = steps_.back().lengths[p];
  if (last == 0.0) return 0.0;
  const double factor = std::max(kFastest, last / before);
  return factor < 1.0 ? last * factor / (1.0 - factor) : kUnbounded;
}

/// The remainder grows with the second power of the step, and is not taken to shrink faster than the step.
double StepForecast::by_earlier_call(std::size_t p) const {
  if (seen_.size() < steps_.size()) return kUnbounded;
  const Seen& seen = seen_[steps_.size() - 1];
  if (seen.calls == 0 || seen.calls > kTrustedCalls) return kUnbounded;
  const double then = std::max(seen.step[p], least_);
  const double now = std::max(steps_.back().lengths[p], least_);
  if (now > kAlike * then || then > kAlike * now) return kUnbounded;
  return seen.remainder[p] * std::max(now / then, now * now / (then * then));
}

}  // namespace glissade::contact
