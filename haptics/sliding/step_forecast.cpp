#include "sliding/step_forecast.h"

#include <algorithm>

#include "sliding/sliding_constants.h"

namespace glissade::haptics {
namespace {

/// In margins: what a longer step leads to is not told by how steps shrink.
constexpr double kShort = 0.5;

/// So much of the first step of a call, and at most so much of the margin, may be left to the next call. At rest, the
/// first step is so short that this says nothing.
constexpr double kLeftOfMotion = 0.02;
constexpr double kLeftOfMargin = 0.5;

/// An earlier call tells of steps that are alike to a factor of this, and for so many calls.
constexpr double kAlike = 2.0;
constexpr int kTrustedCalls = 8;

}  // namespace

void StepForecast::begin_call(double margin) {
  margin_ = margin;
  count_ = 0;
  for (Pair& pair : earlier_)
    ++pair.calls;
}

void StepForecast::note(const Step& step) {
  if (count_ == 0) {
    first_ = step.length;
  } else {
    if (earlier_.size() < count_) earlier_.resize(count_);
    earlier_[count_ - 1] = {last_.length, step.length, 0};
    for (std::size_t p = 0; p < shrinks_.size(); ++p)
      shrinks_[p] = step.lengths[p] < last_.lengths[p] ? step.lengths[p] / last_.lengths[p] : 1.0;
  }
  last_ = step;
  ++count_;
}

bool StepForecast::is_next_worthless() const {
  const double least = kNotWorthIt * margin_;
  if (last_.length < least) return true;
  if (!last_.is_plain) return false;
  const double enough = std::max(least, std::min(kLeftOfMotion * first_, kLeftOfMargin * margin_));
  return std::min(by_shrinking(), by_earlier_call()) < enough;
}

/// Steps on the same contacts shrink by a constant factor at the least, as those of Newton's method do.
double StepForecast::by_shrinking() const {
  if (count_ == 1 || last_.length > kShort * margin_) return kUnbounded;
  double next = 0.0;
  for (std::size_t p = 0; p < shrinks_.size(); ++p)
    next += shrinks_[p] * last_.lengths[p];
  return next;
}

double StepForecast::by_earlier_call() const {
  if (earlier_.size() < count_) return kUnbounded;
  const Pair& pair = earlier_[count_ - 1];
  if (pair.calls > kTrustedCalls || last_.length > kAlike * pair.length || pair.length > kAlike * last_.length)
    return kUnbounded;
  return pair.next * last_.length / pair.length;
}

}  // namespace glissade::haptics
