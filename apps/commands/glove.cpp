#include <chrono>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/command.h>
#include <glissade/apps/commands/glove_link_options.h>
#include <glissade/apps/commands/pose_script.h>
#include <glissade/apps/files/hand_script.h>
#include <glissade/apps/run/glove_watch.h>
#include <glissade/apps/run/lcm_option.h>
#include <glissade/apps/run/machine_check.h>
#include <glissade/apps/run/status_line.h>
#include <glissade/apps/run/stop_signal.h>
#include <glissade/apps/scene/embedded_scene.h>
#include <glissade/apps/text.h>
#include <glissade/apps/usage.h>
#include <glissade/devices/glove_model.h>
#include <glissade/devices/simulated_glove_service.h>
#include <glissade/files/csv.h>
#include <glissade/files/file_checks.h>
#include <glissade/realtime/periodic_thread.h>
#include <glissade/realtime/spsc_ring.h>

namespace glissade::apps {

namespace {

constexpr const char* kGloveDescription = "Simulate a force-feedback glove in a process of its own";

constexpr const char* kGloveFooter =
    "Script: columns t_s,x_m,y_m,z_m,qw,qx,qy,qz. Each row is a time and the pose X_WH of the hand root, the frame\n"
    "whose pose the glove reports. Times increase. An optional ninth column, grip, says whether the hand is closed\n"
    "(1) or open (0) from this row on. A hand that opens lets go of its part. A hand that closes takes the nearest\n"
    "part. For a server that lets fingers grasp ('glissade run --fingers'), replace grip by 22 columns,\n"
    "thumb_roll_rad to wrist_abduction_rad: the angles to which the wearer moves the joints. Without --script, the\n"
    "hand follows the script of the car door demonstration or, with --fingers, that of the door module.\n"
    "The hand waits at the first pose until a haptic server ('glissade run') sends a command. The hand yields to\n"
    "forces. If the server or the visible parts are slow, the simulated wearer waits for at most three seconds. The\n"
    "process ends at the end of the script, or with Ctrl-C. When the force fades, the command prints the reason to\n"
    "standard error. If another glove sends under the same number, the command reports this there, too. For the\n"
    "columns of --record, see docs/file_formats.md in the sources.\n"
    "Without --preset, the hand is on an ideal arm, and its fingers have no mass. A preset is a model of a device: "
    "its\n"
    "mechanics, sensors, servo loop and link. docs/glove_models.md in the sources has the keys of a model's file.\n"
    "\n"
    "Examples, with the files of 'glissade example' and a server:\n"
    "  glissade run square_peg.yaml --seconds 4 & glissade glove --script square_peg_script.csv\n"
    "  glissade run square_peg.yaml --seconds 4 & glissade glove --script square_peg_script.csv --record felt.csv\n"
    "  glissade run square_peg.yaml --seconds 4 & glissade glove --script square_peg_script.csv --preset omega_3\n"
    "  glissade glove --presets";

struct GloveOptions {
  std::string side = "right";
  LcmAddress lcm;
  std::string script;
  std::string preset;
  bool lists_presets = false;
  bool fingers = false;
  double seconds_per_pose = 0.0;  ///< 0: the wearer does not show poses
  GloveLinkOptions link;
  std::int64_t device = devices::kDefaultDevice;
  std::string record;
  bool overwrites = false;
  double frozen_ms = 0.0;
};

/// The record of the glove's periods, from its thread to a file.
class GloveRecord {
 public:
  explicit GloveRecord(const std::string& path)
      : ring_(kRing),
        csv_(path, {"t_s", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz", "fx_N", "fy_N", "fz_N", "tx_Nm", "ty_Nm",
                    "tz_Nm", "age_s", "reason"}) {}

  /// In the thread of the glove.
  void push(const devices::GloveState& state, const devices::SafeCommand& command) { ring_.push({state, command}); }

  /// Writes what has been pushed since the last call.
  void write() {
    Period period;
    while (ring_.pop(period))
      write(period);
  }

  void close() {
    write();
    csv_.close();
    if (ring_.dropped() > 0) std::cerr << "glissade glove: " << ring_.dropped() << " periods are not recorded\n";
  }

 private:
  struct Period {
    devices::GloveState state;
    devices::SafeCommand command;
  };
  static constexpr std::size_t kRing = 4096;  // four seconds

  void write(const Period& period) {
    const auto seconds = [](std::chrono::nanoseconds time) { return std::chrono::duration<double>(time).count(); };
    const devices::SafeCommand& command = period.command;
    csv_.add(seconds(period.state.time)).add(period.state.X_WH);
    const devices::HandWrench held = half_space_wrench(command.values().half_spaces, period.state.X_WH);
    csv_.add(Eigen::Vector3d(command.values().f_H_W + held.f_H_W));
    csv_.add(Eigen::Vector3d(command.values().t_H_W + held.t_H_W));
    if (command.values().sequence > 0) {
      csv_.add(seconds(command.age())).add(to_text(command));
    } else {
      csv_.add("").add("");  // no server has sent a command: there is no age, and no force to reduce
    }
    csv_.end_row();
  }

  realtime::SpscRing<Period> ring_;
  CsvWriter csv_;
};

std::string told_of_another(std::int64_t device) {
  return "another glove sends as glove " + std::to_string(device) +
         ", and a server hears only one of the two: give one another --device";
}

void list_presets() {
  for (const std::string_view name : devices::glove_presets())
    std::cout << name << ": " << devices::read_glove_model(std::string(name)).summary << '\n';
}

HandScript script_of(const GloveOptions& options) {
  if (!options.script.empty()) return read_hand_script(options.script);
  if (options.seconds_per_pose > 0.0) return pose_script(options.seconds_per_pose);
  const Demonstration demonstration = options.fingers ? Demonstration::kDoorModule : Demonstration::kCarDoor;
  return parse_hand_script(embedded_scene_script(demonstration), embedded_script_name(demonstration));
}

devices::SimulatedGlove simulated_glove(const GloveOptions& options, const HandScript& script) {
  devices::SimulatedGloveParameters parameters = script.with_grip({});
  parameters.frozen = std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double, std::milli>(options.frozen_ms));
  if (options.preset.empty()) return devices::SimulatedGlove(script.X_WH, parameters);
  return devices::SimulatedGlove(script.X_WH, parameters, devices::read_glove_model(options.preset));
}

void check(const GloveOptions& options) {
  if (!(options.frozen_ms >= 0.0 && options.frozen_ms <= 1e6)) {
    throw std::invalid_argument("--frozen-ms: must lie between 0 and 1e6, not " + format_number(options.frozen_ms));
  }
  if (options.seconds_per_pose != 0.0 && !(options.seconds_per_pose >= 0.5 && options.seconds_per_pose <= 120.0))
    throw std::invalid_argument("--poses: must lie between 0.5 and 120 s");
}

void print_summary(const devices::SimulatedGloveService& glove) {
  const devices::LinkStatistics link = glove.link_statistics();
  const std::uint64_t refused = link.rejected() - link.other_receiver;  // those for other gloves are no fault
  std::cout << "glissade glove: " << glove.script_time() / std::chrono::milliseconds(1) << " ms of the script, "
            << link.accepted << " commands (" << link.lost << " lost, " << refused << " refused), greatest force "
            << fixed_text(glove.greatest_force(), 2) << " N\n";
  const devices::LinkLosses losses = glove.link_losses();
  if (losses.states + losses.commands > 0)
    std::cout << "glissade glove: the link of the model lost " << losses.states << " states and " << losses.commands
              << " commands\n";
}

int run(const GloveOptions& options) {
  if (options.lists_presets) {
    list_presets();
    return 0;
  }
  check(options);
  const bool shows_poses = options.seconds_per_pose > 0.0;
  const bool has_locked_memory = realtime::lock_memory();
  const HandScript script = script_of(options);
  devices::SimulatedGlove simulated = simulated_glove(options, script);
  const std::shared_ptr<devices::LcmBus> bus = open_bus(options.lcm);
  const std::chrono::nanoseconds duration = script.X_WH.duration();
  const StopSignal stop_signal;
  realtime::SteadyClock clock;
  std::optional<GloveRecord> record;
  if (!options.record.empty()) {
    check_recording(options.record, options.overwrites);
    record.emplace(options.record);
  }
  GloveWatch watch;
  const hands::HandSide side = options.side == "left" ? hands::HandSide::kLeft : hands::HandSide::kRight;
  const auto observe = [&](const devices::GloveState& state, const devices::SafeCommand& command) {
    if (record) record->push(state, command);
    // The main thread may be held up by a reader of the output.
    const bool goes_on = !StopSignal::requested();
    const bool has_server = command.values().sequence > 0;
    if (has_server && goes_on) watch.note(state.time, command);
    return goes_on;
  };
  devices::SimulatedGloveService glove(bus, std::move(simulated), clock,
                                       link_options(options.link, options.device, side), observe, !shows_poses);

  StatusLine line;
  constexpr bool kNeedsFifo = false;  // a simulated hand may be late
  const std::string missing = missing_rights(!kNeedsFifo, has_locked_memory);
  if (!missing.empty()) line.say("glissade glove: " + missing);
  line.say("glissade glove: the " + options.side +
           (shows_poses ? " hand shows the poses of 'glissade calibrate' at " : " hand waits for a server at ") +
           options.lcm.url);
  bool has_told_of_another = false;
  for (int i = 0; glove.script_time() < duration && !StopSignal::requested(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (glove.shares_number() && !std::exchange(has_told_of_another, true))
      line.say("glissade glove: " + told_of_another(options.device));
    if (record) record->write();
    for (const std::string& event : watch.events())
      line.say("glissade glove: " + event);
    constexpr int kStatusTurns = 5;
    if (i % kStatusTurns == 0) line.show(watch.status(glove.script_time(), duration));
  }
  line.show({});
  glove.stop();
  if (record) record->close();
  print_summary(glove);
  return 0;
}

}  // namespace

void add_glove_command(CLI::App& app, Command& chosen) {
  const auto options = std::make_shared<GloveOptions>();
  CLI::App* command = app.add_subcommand("glove", kGloveDescription);
  command->footer(kGloveFooter);
  command->add_option("--side", options->side, "Hand that wears the glove")
      ->check(one_of({"left", "right"}))
      ->capture_default_str();
  add_device_option(*command, options->device);
  add_lcm_options(*command, options->lcm);
  command->add_option("--script", options->script, "Trajectory of the hand root (CSV), see below");
  command->add_flag("--fingers", options->fingers, "Without --script: the hand of 'glissade demo --fingers'")
      ->excludes("--script");
  command
      ->add_option("--poses", options->seconds_per_pose,
                   "Show the poses of 'glissade calibrate', each for this number of seconds, without a server")
      ->excludes("--script")
      ->excludes("--fingers");
  add_calibration_option(*command, options->link);
  command
      ->add_option(
          "--frozen-ms", options->frozen_ms,
          "Longest time in milliseconds for which the tracker may repeat a pose bit by bit before the force fades; "
          "0: not checked")
      ->capture_default_str();
  command->add_option("--preset", options->preset,
                      "Device to simulate: a preset (see --presets) or a YAML file with a model");
  command->add_flag("--presets", options->lists_presets, "List the presets and end");
  CLI::Option* record =
      command->add_option("--record", options->record, "CSV file for the hand's pose and force in every period");
  command->add_flag("--overwrite", options->overwrites, kOverwriteHelp)->needs(record);
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
