#include <glissade/apps/reason_teller.h>

namespace glissade::apps {

namespace {

/// Number of the most serious reason.
std::size_t first_reason(const devices::LimitReasons& reasons) {
  std::size_t i = 0;
  while (i < devices::kLimitReasons.size() && !(reasons.*devices::kLimitReasons[i].flag))
    ++i;
  return i;
}

}  // namespace

void ReasonTeller::note(const devices::LimitReasons& reasons, std::chrono::nanoseconds age) noexcept {
  if (reasons.is_fading()) fading_.publish({reasons, age});
  is_fading_.store(reasons.is_fading(), std::memory_order_release);
}

std::string ReasonTeller::news() {
  const bool is_fading = is_fading_.load(std::memory_order_acquire);
  if (fading_.update()) {
    const Fading& newest = fading_.value();
    const std::size_t reason = first_reason(newest.reasons);
    if (told_ == reason) return {};
    told_ = reason;
    return to_text(newest.reasons, newest.age);
  }
  if (is_fading || !told_) return {};
  told_.reset();
  return "the force returns";
}

}  // namespace glissade::apps
