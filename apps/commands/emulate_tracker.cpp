#include <chrono>
#include <cstdint>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/emulate.h>
#include <glissade/apps/files/hand_script.h>
#include <glissade/apps/run/lcm_option.h>
#include <glissade/apps/run/stop_signal.h>
#include <glissade/devices/hand_pose.h>
#include <glissade/devices/lcm_glove.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/periodic_thread.h>

namespace glissade::apps {

namespace {

constexpr const char* kTrackerFooter =
    "Sends the poses of a script on HAND_POSE, as the tracker of a hand would: for 'glissade bridge' with "
    "--pose-from.\n"
    "The script is that of 'glissade glove'; of its columns, the tracker uses time and pose. It begins after two\n"
    "seconds. At its end, the tracker stays at the last pose until --seconds or Ctrl-C.\n"
    "\n"
    "Examples, with the files of 'glissade example' and an emulated glove:\n"
    "  glissade emulate tracker --script ball_and_tray_hand.csv --seconds 2\n"
    "  glissade emulate opengloves --link glove_port --seconds 6 & glissade emulate tracker --script "
    "ball_and_tray_hand.csv --seconds 6 & glissade bridge opengloves --port glove_port --pose-from lcm --seconds 6";

struct TrackerOptions {
  std::string script;
  std::int64_t device = devices::kDefaultDevice;
  LcmAddress lcm;
  double rate_Hz = 90.0;
  double seconds = 0.0;
};

int run(const TrackerOptions& options) {
  if (!(options.rate_Hz >= 1.0 && options.rate_Hz <= 1000.0))
    throw std::invalid_argument("--rate-hz: must lie between 1 and 1000");
  const geometry::PoseTrajectory X_WT = read_hand_script(options.script).X_WH;
  const StopSignal stop_signal;
  devices::HandPosePublisher tracker(open_bus(options.lcm), options.device);
  realtime::schedule_this_thread(realtime::kLinkPriority);  // as a device, which is never late
  realtime::SteadyClock clock;
  const std::chrono::nanoseconds start = clock.now();
  devices::TrackedPose pose;
  while (!StopSignal::requested()) {
    pose.time = clock.now();
    const std::chrono::duration<double> passed = pose.time - start;
    if (options.seconds > 0.0 && passed.count() > options.seconds) break;
    const std::chrono::nanoseconds script_time = X_WT.first_time() + (pose.time - start) - kScriptWait;
    const geometry::FrameVelocity velocity = X_WT.velocity_at(script_time);
    pose.X_WT = X_WT.pose_at(script_time);
    pose.has_velocity = true;
    pose.v_WT = velocity.v_WB;
    pose.w_WT = velocity.w_WB;
    tracker.publish(pose);
    ++pose.sequence;
    const std::chrono::duration<double> next(static_cast<double>(pose.sequence) / options.rate_Hz);
    clock.sleep_until(start + std::chrono::duration_cast<std::chrono::nanoseconds>(next));
  }
  std::cout << "glissade emulate: " << pose.sequence << " poses\n";
  return 0;
}

}  // namespace

void add_emulate_tracker(CLI::App& emulate, Command& chosen) {
  const auto options = std::make_shared<TrackerOptions>();
  CLI::App* command = emulate.add_subcommand("tracker", "A tracker of the hand, which sends its poses over LCM");
  command->footer(kTrackerFooter);
  command->add_option("--script", options->script, "Trajectory of the tracker (CSV)")->required();
  add_device_option(*command, options->device);
  add_lcm_options(*command, options->lcm);
  command->add_option("--rate-hz", options->rate_Hz, "Poses per second; 1 to 1000")->capture_default_str();
  command->add_option("--seconds", options->seconds, "Time after which the tracker ends; 0: with Ctrl-C")
      ->capture_default_str();
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
