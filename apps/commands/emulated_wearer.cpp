#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/emulated_wearer.h>
#include <glissade/apps/files/hand_script.h>
#include <glissade/devices/hand_pose.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/realtime/clock.h>

namespace glissade::apps {

namespace {

using std::chrono::nanoseconds;

/// Sends the poses of a script.
class Tracker {
 public:
  Tracker(std::shared_ptr<devices::LcmBus> bus, std::int64_t device, geometry::PoseTrajectory X_WT)
      : publisher_(std::move(bus), device), X_WT_(std::move(X_WT)) {}

  /// Sends the pose at this time of the script if it is due at `time` after the start.
  void advance(nanoseconds time, nanoseconds script_time) {
    constexpr nanoseconds kPeriod = std::chrono::nanoseconds(std::chrono::seconds(1)) / 90;
    if (time < pose_.sequence * kPeriod) return;
    const geometry::FrameVelocity velocity = X_WT_.velocity_at(script_time);
    pose_.time = start_ + time;  // after a stall, poses that come together are of different times
    pose_.X_WT = X_WT_.pose_at(script_time);
    pose_.has_velocity = true;
    pose_.v_WT = velocity.v_WB;
    pose_.w_WT = velocity.w_WB;
    publisher_.publish(pose_);
    ++pose_.sequence;
  }

 private:
  devices::HandPosePublisher publisher_;
  geometry::PoseTrajectory X_WT_;
  nanoseconds start_ = realtime::SteadyClock().now();
  devices::TrackedPose pose_;
};

}  // namespace

void add_wearer_options(CLI::App& command, WearerOptions& options) {
  CLI::Option* script = command.add_option("--script", options.script,
                                           "Trajectory with joint angles (CSV), by which the wearer moves the fingers");
  CLI::Option* tracker =
      command
          .add_flag("--tracker", options.is_tracked, "Also send the poses of the script, as a tracker of the hand does")
          ->needs(script);
  add_device_option(command, options.device);
  add_lcm_options(command, options.lcm);
  for (const char* name : {"--device", "--lcm", "--key-file"})
    command.get_option(name)->needs(tracker);
}

bridges::EmulatedWearer wearer_of(const WearerOptions& options) {
  if (options.script.empty()) return bridges::busy_wearer;
  return scripted_wearer(options.script, options.is_tracked ? open_bus(options.lcm) : nullptr, options.device);
}

bridges::EmulatedWearer scripted_wearer(const std::string& script, std::shared_ptr<devices::LcmBus> tracker_bus,
                                        std::int64_t device) {
  HandScript hand = read_hand_script(script);
  if (hand.fingers.empty()) throw std::invalid_argument(script + ": the columns of the 22 joint angles are missing");
  std::shared_ptr<Tracker> tracker;
  if (tracker_bus) tracker = std::make_shared<Tracker>(std::move(tracker_bus), device, std::move(hand.X_WH));
  return [fingers = std::move(hand.fingers), tracker = std::move(tracker)](nanoseconds time) {
    const nanoseconds script_time = fingers.front().time + time - kScriptWait;
    if (tracker) tracker->advance(time, script_time);
    return devices::angles_at(fingers, script_time);
  };
}

}  // namespace glissade::apps
