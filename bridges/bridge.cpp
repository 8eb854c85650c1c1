#include <optional>
#include <thread>
#include <utility>

#include <glissade/bridges/bridge.h>
#include <glissade/bridges/drift_watch.h>
#include <glissade/realtime/clock.h>

#include "hand_pose/pose_notice.h"

namespace glissade::bridges {
namespace {

/// What is to be said of the tracker and of the sensors of the fingers.
class Watch {
 public:
  Watch(const devices::LcmGloveHostOptions& link, const devices::HandPoseSource* tracker,
        const std::function<void(const std::string&)>& say)
      : tracker_(tracker), say_(say) {
    if (link.calibration) drift_.emplace(*link.calibration);
    if (link.hand_pose) poses_.emplace(*link.hand_pose);
  }

  void note_state(const devices::GloveState& reported) {
    if (drift_) tell(drift_->note(reported));
  }
  void note_period() {
    if (poses_) tell(poses_->note(tracker_->newest(), tracker_->statistics(), clock_.now()));
  }

 private:
  void tell(const std::optional<std::string>& sentence) const {
    if (sentence) say_(*sentence);
  }

  const devices::HandPoseSource* tracker_;
  const std::function<void(const std::string&)>& say_;
  realtime::SteadyClock clock_;
  std::optional<DriftWatch> drift_;
  std::optional<PoseNotice> poses_;
};

/// Exchanges states and commands until the wire fails, which it throws, or the bridge is to end. Calls `greet` at the
/// first state.
void exchange(Wire& wire, devices::LcmGloveHost& host, devices::GloveState& state, BridgeStatistics& statistics,
              Watch& watch, const std::function<bool()>& goes_on, const std::function<void()>& greet) {
  bool is_first = true;
  while (goes_on()) {
    if (wire.read(state)) {
      if (std::exchange(is_first, false)) greet();
      ++state.sequence;
      ++statistics.states;
      host.publish(state);
      watch.note_state(state);
    }
    watch.note_period();
    // Also without a new measurement: the envelope lets the force fade as the last one grows old.
    wire.write(host.newest_command(state));
  }
}

}  // namespace

BridgeStatistics run_bridge(Wire& wire, const std::shared_ptr<devices::LcmBus>& bus, const BridgeOptions& options,
                            const std::function<bool()>& goes_on, const std::function<void(const std::string&)>& say) {
  devices::LcmGloveHost host(bus, wire.descriptor(), options.link);
  Watch watch(options.link, host.hand_pose(), say);
  devices::GloveState state;
  state.X_WH = options.X_WH;
  BridgeStatistics statistics;
  std::uint64_t failures = 0;  // since the last state
  const auto greet = [&] {
    say(statistics.states > 0 ? "the device is back" : "the device is connected");
    failures = 0;
  };
  while (goes_on()) {
    try {
      wire.open();
      exchange(wire, host, state, statistics, watch, goes_on, greet);
    } catch (const WireError& error) {
      constexpr std::uint64_t kSaidAgain = 20;
      if (failures % kSaidAgain == 0) say(error.what());
      ++failures;
      ++statistics.errors;
      wire.release();
      const auto again = std::chrono::steady_clock::now() + options.reopen_after;
      while (goes_on() && std::chrono::steady_clock::now() < again) {
        // The command fades meanwhile: none from before the failure may act on a device that is back.
        host.newest_command(state);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    }
  }
  wire.release();
  return statistics;
}

}  // namespace glissade::bridges
