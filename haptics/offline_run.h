#pragma once

/// The whole system on a simulated clock and in one thread: gloves, haptic kernel and simulation take turns, once per
/// tick. The same inputs give the same bits. Also the repetition of a recorded run: to the bit.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glissade/devices/haptic_state.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/haptics/haptic_kernel.h>
#include <glissade/haptics/recording.h>

namespace glissade::grasping {
class GraspSimulation;
}

namespace glissade::haptics {

class Answerer;
class AnswersAhead;

struct OfflineRunOptions {
  std::chrono::nanoseconds period = kTickPeriod;
  /// Called before each tick, with its number, from 1 on: for grasps and releases.
  std::function<void(std::int64_t tick, HoldRequests& requests)> before_tick{};
  LoopObserver* observer = nullptr;  ///< null: none
};

/// Runs `ticks` ticks and passes the state of each tick to `sink`. A tick uses the contact set that answers the ghost
/// poses of the previous tick. Hands, parts and couplings are as in `HapticServer`. Throws std::invalid_argument for a
/// null glove, an empty sink or a period out of the bounds of `validate_tick_period`, and as the constructor of
/// `HapticKernel` does.
void run_offline(const std::vector<HandInLoop<devices::SimulatedGlove>>& hands, grasping::GraspSimulation& simulation,
                 std::int64_t ticks, const std::function<void(const devices::HapticState&)>& sink,
                 const OfflineRunOptions& options = {});

/// Repeats a recorded run: ticks and answers consume what they consumed then, and must produce the same bytes. The
/// simulation works in a thread of its own, ahead of the ticks: it needs nothing but the recorded ghosts. Not
/// thread-safe.
class Replay {
 public:
  /// A loop as the recorded one. Scene, rules, devices and parts of `hands`, period and `head` must be those of the
  /// recording; the fingers of hands are those of the simulation. The simulation must outlive this object, and must not
  /// be used by others. Throws as the constructor of `HapticKernel` does.
  Replay(grasping::GraspSimulation& simulation, std::vector<KernelHand> hands, std::chrono::nanoseconds period,
         RecordingHead head);
  ~Replay();
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  /// Takes the next event of the recording. Repeats the tick of an event of HAPTIC_TICK, and the answer of one of
  /// CONTACT_SET; compares the others on channels of a recording with what the last tick produced. Ignores other
  /// channels. Returns false if the recording cannot be repeated up to here: `difference` says why. The simulation
  /// computes the answers in another thread. So `take` may return true for an event that differs from the recording. A
  /// later call of `take` or `settle` then returns false. Rethrows exceptions of the simulation.
  bool take(devices::LogEvent event);

  /// Repeats all that was taken. Returns false, as `take` does, if something differs.
  bool settle();

  /// To be called after the last event: settles. Returns false, as `take` does, also if the recording ends within a
  /// tick or has none.
  bool finish();

  /// Ticks and answers that were repeated so far: all before the difference, once `settle` was called.
  std::int64_t ticks() const noexcept { return ticks_; }
  std::int64_t answers() const noexcept { return answers_; }
  std::chrono::nanoseconds duration() const noexcept { return last_ - first_; }  ///< recorded time

  /// A sentence that names the tick or the contact set, and what differs; empty while there is no difference.
  const std::string& difference() const noexcept { return difference_; }

 private:
  /// An event that is not repeated yet.
  struct Waiting {
    devices::LogEvent event;
    std::string fault;               // of a contact set: why the simulation cannot be asked for it; empty if it was
    std::optional<bool> is_right{};  // the checksum of a contact set, once it is known
  };

  std::string ask_ahead(const devices::LogEvent& event);
  bool repeat_waiting();
  bool repeat(const Waiting& waiting);
  bool has_right_checksum(const Waiting& first);
  bool repeat_tick(const devices::LogEvent& event);
  bool repeat_answer(const devices::LogEvent& event);
  bool compare_with_last_tick(const devices::LogEvent& event);
  bool differs(const std::string& what);

  HapticKernel kernel_;
  std::int32_t part_count_;
  RecordedEvents events_;
  TickRecord record_;
  std::map<std::int64_t, std::unique_ptr<AnswerRecord>> sets_;  // that ticks may still use, by number
  std::deque<devices::LogEvent> expected_;                      // the other events of the last tick
  std::deque<Waiting> waiting_;
  std::int64_t ticks_ = 0;
  std::int64_t answers_ = 0;
  std::chrono::nanoseconds first_{0};
  std::chrono::nanoseconds last_{0};
  std::string difference_;
  std::unique_ptr<Answerer> answerer_;
  std::unique_ptr<AnswersAhead> ahead_;
  std::int64_t asked_ = 0;  // answers
};

}  // namespace glissade::haptics
