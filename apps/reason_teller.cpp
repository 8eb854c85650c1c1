#include <glissade/apps/reason_teller.h>
#include <glissade/haptics/contact_set.h>

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

void ReasonTeller::note(const devices::LimitReasons& reasons, std::chrono::nanoseconds age,
                        std::chrono::nanoseconds contact_set_age) noexcept {
  const bool is_fading = reasons.is_fading() || contact_set_age > haptics::kFullForce;
  if (is_fading) fading_.publish({reasons, age, contact_set_age});
  is_fading_.store(is_fading, std::memory_order_release);
}

std::string ReasonTeller::news() {
  const bool is_fading = is_fading_.load(std::memory_order_acquire);
  if (fading_.update()) {
    const Fading& newest = fading_.value();
    const bool are_contacts_old = !newest.reasons.is_fading();
    const std::size_t reason = are_contacts_old ? devices::kLimitReasons.size() : first_reason(newest.reasons);
    if (told_ == reason) return {};
    told_ = reason;
    if (are_contacts_old) {
      const auto milliseconds = newest.contact_set_age / std::chrono::milliseconds(1);
      return "reduced force: the simulation's contacts are " + std::to_string(milliseconds) + " ms old";
    }
    return to_text(newest.reasons, newest.age);
  }
  if (is_fading || !told_) return {};
  told_.reset();
  return "the force returns";
}

}  // namespace glissade::apps
