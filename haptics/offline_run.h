#pragma once

/// Runs the whole system on a simulated clock and in one thread: gloves, haptic kernel and simulation take turns, once
/// per tick. The same inputs give bit-identical outputs. `Replay` repeats a recorded run bit by bit.

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

#include <glissade/base/export.h>
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
  /// Called before each tick, to add grasps and releases. `tick` counts from 1.
  std::function<void(std::int64_t tick, HoldRequests& requests)> before_tick{};
  LoopObserver* observer = nullptr;  ///< null: none
};

/// Runs `ticks` ticks and passes the state of each tick to `sink`. A tick uses the contact set that answers the ghost
/// poses of the previous tick. Hands, parts and couplings are as in `HapticServer`. Throws std::invalid_argument for a
/// null glove, an empty sink or a period out of the bounds of `validate_tick_period`. Also throws what the constructor
/// of `HapticKernel` throws.
GLISSADE_EXPORT void run_offline(const std::vector<HandInLoop<devices::SimulatedGlove>>& hands,
                                 grasping::GraspSimulation& simulation, std::int64_t ticks,
                                 const std::function<void(const devices::HapticState&)>& sink,
                                 const OfflineRunOptions& options = {});

/// Repeats a recorded run. Ticks and answers consume the recorded inputs, and must produce the recorded bytes. The
/// simulation needs only the recorded ghosts, so the simulation works ahead of the ticks in a separate thread. Not
/// thread-safe.
class GLISSADE_EXPORT Replay {
 public:
  /// The scene, the rules, the devices and parts of `hands`, the period and `head` must be the same as in the
  /// recording. The fingers of `hands` must be those of the simulation. The simulation must outlive this object, and no
  /// one else may use it. Throws what the constructor of `HapticKernel` throws.
  Replay(grasping::GraspSimulation& simulation, std::vector<KernelHand> hands, std::chrono::nanoseconds period,
         RecordingHead head);
  ~Replay();
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  /// Takes the next event of the recording. Repeats the tick of a HAPTIC_TICK event and the answer of a CONTACT_SET
  /// event. Compares events on the other channels of a recording with the results of the last tick. Ignores all other
  /// channels. Returns false if the run differs from the recording up to here. `difference` then says where and how.
  /// Because the simulation computes the answers in another thread, `take` may return true for an event that differs. A
  /// later call of `take` or `settle` then returns false. Rethrows exceptions of the simulation.
  bool take(devices::LogEvent event);

  /// Repeats all events taken so far. Returns false if something differs.
  bool settle();

  /// Call this function after the last event. Does what `settle` does. Also returns false if the recording ends within
  /// a tick or has no tick.
  bool finish();

  /// Numbers of ticks and answers repeated so far. After `settle`, they include everything before the first difference.
  std::int64_t ticks() const noexcept { return ticks_; }
  std::int64_t answers() const noexcept { return answers_; }
  std::chrono::nanoseconds duration() const noexcept { return last_ - first_; }  ///< recorded time

  /// A sentence that names the tick or the contact set and the difference; empty while there is no difference.
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
