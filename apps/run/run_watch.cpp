#include <algorithm>
#include <utility>

#include <glissade/apps/durations.h>
#include <glissade/apps/run/run_status.h>
#include <glissade/apps/run/run_watch.h>
#include <glissade/apps/text.h>

namespace glissade::apps {

namespace {

using std::chrono::nanoseconds;

/// A glove that is silent for so long is lost: others may take its place.
constexpr nanoseconds kLost = std::chrono::milliseconds(500);
/// A hand that takes and lets go faster than this is told of as it is in the end.
constexpr nanoseconds kBetweenHolds = std::chrono::milliseconds(500);

}  // namespace

RunWatch::RunWatch(std::vector<std::string> part_names, const std::vector<Hand>& hands, double duration_s)
    : part_names_(std::move(part_names)), duration_s_(duration_s) {
  for (const Hand& hand : hands) {
    reasons_.push_back(std::make_unique<ReasonTeller>());
    told_.push_back({hand.glove, hand.part ? static_cast<std::int32_t>(*hand.part) : -1});
  }
}

void RunWatch::note(const devices::HapticState& state) noexcept {
  if (!std::exchange(has_noted_, true)) noted_.start = state.time;
  ForceReason late;
  for (std::size_t h = 0; h < reasons_.size(); ++h) {
    ForceReason reason = force_reason(state, h);
    // Old contacts concern all hands, and are told once.
    if (reason.cause == ForceReason::Cause::kOldContacts) late = std::exchange(reason, {});
    reasons_[h]->note(state.time, reason);
    if (state.hands[h].part != noted_.state.hands[h].part) noted_.held_since[h] = state.time;
  }
  simulation_.note(state.time, late);
  noted_.state = state;
  newest_.publish(noted_);
}

RunWatch::News RunWatch::news(std::int64_t late_ticks) {
  has_news_ = newest_.update() || has_news_;
  if (!has_news_) return {};
  std::vector<TimedSentence> sentences;
  tell_reasons(sentences);
  for (std::size_t h = 0; h < told_.size(); ++h) {
    tell_hold(h, sentences);
    tell_loss(h, sentences);
  }
  News news;
  news.events = in_order(std::move(sentences));
  news.status = status(late_ticks);
  return news;
}

std::vector<std::string> RunWatch::in_order(std::vector<TimedSentence> sentences) {
  const auto is_earlier = [](const TimedSentence& a, const TimedSentence& b) { return a.time < b.time; };
  const auto text_of = [&](nanoseconds time) { return fixed_text(in_seconds(time - newest_.value().start), 3) + " s"; };
  std::stable_sort(sentences.begin(), sentences.end(), is_earlier);
  // Reasons may be of ticks after the newest state.
  nanoseconds now = std::max(newest_.value().state.time, last_told_);
  if (!sentences.empty()) now = std::max(now, sentences.back().time);
  for (TimedSentence& sentence : sentences) {
    if (sentence.time >= last_told_) continue;
    sentence.text += " (at " + text_of(sentence.time) + ")";
    sentence.time = now;
  }
  std::stable_sort(sentences.begin(), sentences.end(), is_earlier);
  std::vector<std::string> lines;
  for (const TimedSentence& sentence : sentences)
    lines.push_back(text_of(sentence.time) + ": " + sentence.text);
  if (!sentences.empty()) last_told_ = sentences.back().time;
  return lines;
}

std::string RunWatch::name_of(const Told& hand) const {
  return told_.size() == 1 ? "the glove" : "glove " + std::to_string(hand.glove);
}

void RunWatch::tell_reasons(std::vector<TimedSentence>& sentences) {
  for (const TimedSentence& sentence : simulation_.news())
    sentences.push_back(sentence);
  for (std::size_t h = 0; h < told_.size(); ++h) {
    for (const TimedSentence& sentence : reasons_[h]->news()) {
      const std::string name = told_.size() == 1 ? "" : name_of(told_[h]) + ": ";
      sentences.push_back({sentence.time, name + sentence.text});
    }
  }
}

void RunWatch::tell_hold(std::size_t number, std::vector<TimedSentence>& sentences) {
  Told& told = told_[number];
  const std::int32_t part = newest_.value().state.hands[number].part;
  const nanoseconds time = newest_.value().state.time;
  if (part < 0 && !told.has_held) return;  // it has not taken the part that it was given
  told.has_held = true;
  if (part == told.part || time - told.held_at < kBetweenHolds) return;
  const auto quoted = [&](std::int32_t p) { return in_quotes(part_names_[static_cast<std::size_t>(p)]); };
  const std::string what = part < 0 ? " lets go of " + quoted(told.part) : " takes " + quoted(part);
  sentences.push_back({newest_.value().held_since[number], name_of(told) + what});
  told.part = part;
  told.held_at = time;
}

void RunWatch::tell_loss(std::size_t number, std::vector<TimedSentence>& sentences) {
  Told& told = told_[number];
  const devices::HapticState& state = newest_.value().state;
  const devices::HapticHandState& hand = state.hands[number];
  const bool is_silent = hand.reasons.is_state_old && hand.state_age > kLost;
  if (is_silent && !std::exchange(told.is_lost, true)) {
    told.lost_at = state.time;
    sentences.push_back({state.time, name_of(told) + " is lost: its newest state was measured 0.5 s ago"});
  }
  if (!hand.reasons.is_state_old && std::exchange(told.is_lost, false)) {
    const double lost_s = in_seconds(state.time - told.lost_at + kLost);
    sentences.push_back({state.time, name_of(told) + " is back after " + fixed_text(lost_s, 1) + " s"});
  }
}

std::string RunWatch::status(std::int64_t late_ticks) {
  const Newest& newest = newest_.value();
  RunStatus status{.passed_s = in_seconds(newest.state.time - newest.start),
                   .duration_s = duration_s_,
                   .late_ticks = late_ticks,
                   .state = newest.state};
  for (const Told& hand : told_)
    status.gloves.push_back(hand.glove);
  const double passed_s = in_seconds(newest.state.time - last_time_);
  if (last_sequence_ > 0) {
    const auto ticks = static_cast<double>(newest.state.sequence - last_sequence_);
    status.rate_hz = passed_s > 0.0 ? ticks / passed_s : 0.0;
  }
  last_sequence_ = newest.state.sequence;
  last_time_ = newest.state.time;
  return to_text(status, part_names_);
}

}  // namespace glissade::apps
