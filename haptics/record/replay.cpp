#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>

#include <glissade/haptics/offline_run.h>

#include "loop/answer.h"
#include "loop/kernel_hands.h"
#include "loop/run_tick.h"
#include "record/answers_ahead.h"
#include "record/record_messages.h"

namespace glissade::haptics {

namespace {

/// Answers that the simulation may be ahead: as many as make up for answers that take long.
constexpr std::size_t kMostAhead = 32;

/// What comes in place of the number after `previous`.
std::string follows(const std::string& kind, std::int64_t previous) {
  if (previous > 0) return " follows " + kind + " " + std::to_string(previous);
  return " is the first " + kind + " in the recording: only a run from its beginning on can be repeated";
}

std::string unreadable_after(std::int64_t answers) {
  return "the contact set after " + std::to_string(answers) +
         " cannot be read: its bytes were changed, or another version wrote them";
}

/// The time of an event in a log.
std::chrono::microseconds logged(std::chrono::nanoseconds time) {
  return devices::to_event(time, {}, {}).time;
}

}  // namespace

Replay::Replay(grasping::GraspSimulation& simulation, std::vector<KernelHand> hands, std::chrono::nanoseconds period,
               RecordingHead head)
    : kernel_(kernel_parts(simulation.parts()), with_fingers(hands, simulation), period),
      part_count_(static_cast<std::int32_t>(simulation.part_count())),
      events_(std::move(head)),
      answerer_(std::make_unique<Answerer>(simulation)) {
  record_.hand_count = static_cast<std::int32_t>(hands.size());
  sets_[0] = std::make_unique<AnswerRecord>();
  sets_[0]->set = answerer_->at_start();
  ahead_ = std::make_unique<AnswersAhead>(
      [this, period](const Ghosts& ghosts, ContactSet& set) { answerer_->answer(ghosts, period, set); });
}

Replay::~Replay() = default;

bool Replay::take(devices::LogEvent event) {
  if (!difference_.empty()) return false;
  std::string fault = event.channel == kContactSetChannel ? ask_ahead(event) : "";
  waiting_.push_back({.event = std::move(event), .fault = std::move(fault)});
  if (!waiting_.back().fault.empty()) return settle();
  // To wait for many answers at once costs fewer changes between threads.
  if (ahead_->outstanding() >= kMostAhead) ahead_->wait_for(kMostAhead / 2);
  return repeat_waiting();
}

bool Replay::settle() {
  ahead_->wait_for(ahead_->outstanding());
  return repeat_waiting();
}

bool Replay::finish() {
  if (!settle()) return false;
  if (ticks_ == 0) return differs("there is no tick in the recording");
  if (expected_.empty()) return true;
  return differs("the recording ends within tick " + std::to_string(ticks_) + ": an event is missing on " +
                 expected_.front().channel);
}

/// Asks the simulation for a recorded answer, or returns why that cannot be done. It does no harm to ask before the
/// checksum is known.
std::string Replay::ask_ahead(const devices::LogEvent& event) {
  const std::optional<ConsumedByAnswer> consumed = decode_answer(event.message);
  if (!consumed) return unreadable_after(asked_);
  const std::string name = "contact set " + std::to_string(consumed->sequence);
  if (consumed->sequence != asked_ + 1) return name + follows("contact set", asked_);
  if (consumed->part_count != part_count_) return name + " has another number of parts";
  ++asked_;
  ahead_->ask(consumed->ghosts);
  return {};
}

/// Repeats the events that wait, up to the first answer that the simulation still works on.
bool Replay::repeat_waiting() {
  while (!waiting_.empty() && difference_.empty()) {
    const Waiting& next = waiting_.front();
    const bool is_asked = next.event.channel == kContactSetChannel && next.fault.empty();
    if (is_asked && !ahead_->has_next()) return true;
    repeat(next);
    waiting_.pop_front();
  }
  return difference_.empty();
}

bool Replay::repeat(const Waiting& waiting) {
  if (waiting.event.channel == kContactSetChannel && !has_right_checksum(waiting))
    return differs(unreadable_after(answers_));
  if (!waiting.fault.empty()) return differs(waiting.fault);
  if (waiting.event.channel == kHapticTickChannel) return repeat_tick(waiting.event);
  if (waiting.event.channel == kContactSetChannel) return repeat_answer(waiting.event);
  return compare_with_last_tick(waiting.event);
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
  for (auto old = sets_.begin(); old != set; old = sets_.erase(old))  // no tick goes back to an older set
    ahead_->give_back(std::move(old->second));

  consumed->last_duration = record_.duration;
  record_ = std::move(*consumed);
  run_tick(kernel_, record_, set->second->set);
  if (event.time != logged(record_.time) || !is_message_of(record_, event.message))
    return differs(name + " has another outcome");
  for (devices::LogEvent& other : events_.others_of(record_))
    expected_.push_back(std::move(other));
  if (ticks_++ == 0) first_ = record_.time;
  last_ = record_.time;
  return true;
}

bool Replay::repeat_answer(const devices::LogEvent& event) {
  std::unique_ptr<AnswerRecord> repeated = ahead_->take();
  ++answers_;
  if (event.time != logged(repeated->ghosts.time) || !is_message_of(*repeated, event.message))
    return differs("contact set " + std::to_string(answers_) + " differs");
  sets_[answers_] = std::move(repeated);
  return true;
}

/// Computes the checksums of several contact sets that wait, where the first one is not known yet.
bool Replay::has_right_checksum(const Waiting& first) {
  if (!first.is_right) {
    std::array<Waiting*, kMessagesAtOnce> sets{};
    std::array<std::span<const std::uint8_t>, kMessagesAtOnce> messages;
    std::size_t count = 0;
    for (auto next = waiting_.begin(); next != waiting_.end() && count < sets.size(); ++next) {
      if (next->event.channel != kContactSetChannel || next->is_right) continue;
      messages[count] = next->event.message;
      sets[count++] = &*next;
    }
    const std::array<bool, kMessagesAtOnce> are_right = have_right_checksums(messages);
    for (std::size_t i = 0; i < count; ++i)
      sets[i]->is_right = are_right[i];
  }
  return *first.is_right;
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
