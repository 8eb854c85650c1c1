#include <glissade/apps/run/reason_teller.h>
#include <glissade/apps/text.h>

namespace glissade::apps {

namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kQuiet = std::chrono::seconds(5);
constexpr nanoseconds kBackForGood = std::chrono::milliseconds(500);
constexpr nanoseconds kLastingLimit = std::chrono::milliseconds(100);

}  // namespace

void ReasonTeller::note(nanoseconds time, const ForceReason& reason) noexcept {
  // A change that finds no room is noted in the next tick.
  const std::size_t kind = reason.kind();
  if (kind != noted_kind_ && changes_.push({time, reason})) noted_kind_ = kind;
  noted_time_.store(time, std::memory_order_release);
}

std::vector<TimedSentence> ReasonTeller::news() {
  std::vector<TimedSentence> sentences;
  Change change;
  while (changes_.pop(change)) {
    const bool was_fading = present_.reason.is_fading();
    if (was_fading && !change.reason.is_fading()) back_since_ = change.time;
    if (!was_fading && change.reason.is_fading() && !told_fade_) lost_since_ = change.time;
    present_ = change;
    if (present_.reason.is_fading()) tell_present(present_.time, sentences);
  }
  const nanoseconds now = noted_time_.load(std::memory_order_acquire);
  if (present_.reason.is_fading()) {
    tell_present(now, sentences);  // it may have begun too soon after it was told last
    return sentences;
  }
  if (told_fade_ && now - back_since_ >= kBackForGood) {
    told_fade_.reset();
    const double lost_s = std::chrono::duration<double>(back_since_ - lost_since_).count();
    sentences.push_back({back_since_, "the force returns after " + fixed_text(lost_s, lost_s < 0.01 ? 3 : 2) + " s"});
  }
  // Sentences are told in the order of their times.
  const bool is_limited = present_.reason.cause != ForceReason::Cause::kNone && !told_fade_;
  if (is_limited && now - present_.time >= kLastingLimit) tell_present(now, sentences);
  return sentences;
}

void ReasonTeller::tell_present(nanoseconds now, std::vector<TimedSentence>& sentences) {
  const std::size_t kind = present_.reason.kind();
  std::optional<nanoseconds>& told = told_[kind];
  const bool goes_on = told_fade_ == kind || told == present_.time;
  if (goes_on || (told && now - *told < kQuiet)) return;
  told = present_.time;
  if (present_.reason.is_fading()) told_fade_ = kind;
  sentences.push_back({present_.time, to_text(present_.reason)});
}

}  // namespace glissade::apps
