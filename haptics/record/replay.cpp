#include <utility>

#include <glissade/haptics/offline_run.h>

#include "loop/answer.h"
#include "loop/run_tick.h"
#include "record/record_messages.h"

namespace glissade::haptics {

namespace {

/// What comes in place of the number after `previous`.
std::string follows(const std::string& kind, std::int64_t previous) {
  if (previous > 0) return " follows " + kind + " " + std::to_string(previous);
  return " is the first " + kind + " in the recording: only a run from its beginning on can be repeated";
}

}  // namespace

Replay::Replay(LoopSimulation& simulation, const std::vector<KernelHand>& hands, std::chrono::nanoseconds period,
               RecordingHead head)
    : kernel_(kernel_parts(simulation.parts()), hands, period),
      period_(period),
      answerer_(std::make_unique<Answerer>(simulation)),
      events_(std::move(head)) {
  record_.hand_count = static_cast<std::int32_t>(hands.size());
  sets_[0] = answerer_->at_start();
}

Replay::~Replay() = default;

bool Replay::take(const devices::LogEvent& event) {
  if (!difference_.empty()) return false;
  if (event.channel == kHapticTickChannel) return repeat_tick(event);
  if (event.channel == kContactSetChannel) return repeat_answer(event);
  return compare_with_last_tick(event);
}

bool Replay::finish() {
  if (!difference_.empty()) return false;
  if (ticks_ == 0) return differs("there is no tick in the recording");
  if (expected_.empty()) return true;
  return differs("the recording ends within tick " + std::to_string(ticks_) + ": an event is missing on " +
                 expected_.front().channel);
}

bool Replay::repeat_tick(const devices::LogEvent& event) {
  std::optional<TickRecord> consumed = decode_tick(event.message);
  const std::string name =
      consumed ? "tick " + std::to_string(consumed->number) : "the tick after " + std::to_string(ticks_);
  if (!consumed) return differs(name + " cannot be read: its bytes were changed, or another version wrote them");
  if (!expected_.empty()) return differs("an event is missing on " + expected_.front().channel + " before " + name);
  if (consumed->number != ticks_ + 1) return differs(name + follows("tick", ticks_));
  if (consumed->hand_count != record_.hand_count) return differs(name + " has another number of hands");
  const auto set = sets_.find(consumed->set_sequence);
  if (set == sets_.end())
    return differs(name + " uses contact set " + std::to_string(consumed->set_sequence) +
                   ", which is not in the recording before it");
  sets_.erase(sets_.begin(), set);  // no tick goes back to an older set

  consumed->last_duration = record_.duration;
  record_ = std::move(*consumed);
  run_tick(kernel_, record_, set->second);
  const std::vector<devices::LogEvent> repeated = events_.of(record_);
  if (repeated.front() != event) return differs(name + " has another outcome");
  expected_.assign(repeated.begin() + 1, repeated.end());
  if (ticks_++ == 0) first_ = record_.time;
  last_ = record_.time;
  return true;
}

bool Replay::repeat_answer(const devices::LogEvent& event) {
  const std::optional<AnswerRecord> consumed = decode_answer(event.message);
  if (!consumed) {
    return differs("the contact set after " + std::to_string(answers_) +
                   " cannot be read: its bytes were changed, or another version wrote them");
  }
  const std::string name = "contact set " + std::to_string(consumed->set.sequence);
  if (consumed->set.sequence != answers_ + 1) return differs(name + follows("contact set", answers_));
  if (consumed->set.part_count != sets_.begin()->second.part_count)
    return differs(name + " has another number of parts");
  const AnswerRecord repeated{consumed->ghosts, answerer_->answer(consumed->ghosts, period_)};
  ++answers_;
  if (RecordedEvents::of(repeated) != event) return differs(name + " differs");
  sets_[answers_] = repeated.set;
  return true;
}

bool Replay::compare_with_last_tick(const devices::LogEvent& event) {
  if (expected_.empty() || event.channel != expected_.front().channel) return true;
  const bool is_same = event == expected_.front();
  expected_.pop_front();
  return is_same || differs("the event on " + event.channel + " after tick " + std::to_string(ticks_) + " differs");
}

bool Replay::differs(const std::string& what) {
  difference_ = what;
  return false;
}

}  // namespace glissade::haptics
