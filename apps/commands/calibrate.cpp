#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/command.h>
#include <glissade/apps/run/lcm_option.h>
#include <glissade/apps/run/status_line.h>
#include <glissade/apps/run/stop_signal.h>
#include <glissade/apps/text.h>
#include <glissade/apps/usage.h>
#include <glissade/bridges/guided_calibration.h>
#include <glissade/devices/lcm_glove.h>
#include <glissade/files/file_checks.h>
#include <glissade/realtime/clock.h>

namespace glissade::apps {

namespace {

constexpr const char* kCalibrateFooter =
    "The glove must be running, without --calibration and without a server. The command asks for seven poses: flat\n"
    "hand, fist, the thumb at the tip of each finger, spread fingers. For each pose, the wearer has the time\n"
    "--pause-s to take the pose, and then holds the pose still for the time --hold-s. If the hand moves, the command\n"
    "asks again. At the end, the command fits each sensor, prints the remaining errors, and writes the file for\n"
    "--calibration of 'glissade bridge' and 'glissade glove'. If the data are bad, the command says why, and writes\n"
    "nothing. See docs/devices.md in the sources.\n"
    "\n"
    "Examples, with a simulated glove that shows the poses, 2 s each:\n"
    "  glissade glove --poses 2 & glissade calibrate --user anna --out anna.yaml --pause-s 1.6 --hold-s 0.4\n"
    "The same without a joint whose sensor is broken:\n"
    "  glissade glove --poses 2 & glissade calibrate --user anna --out anna_2.yaml --without index_mcp --pause-s 1.6 "
    "--hold-s 0.4";

struct CalibrateOptions {
  std::string out;
  std::string user;
  bool overwrites = false;
  LcmAddress lcm;
  std::int64_t device = devices::kDefaultDevice;
  double pause_s = 5.0;
  double hold_s = 2.0;
  std::vector<std::string> without;
  std::vector<double> flat_at_m;
};

bridges::GuidedCalibrationOptions guided_options(const CalibrateOptions& options) {
  if (!(options.pause_s >= 0.0 && options.pause_s <= 60.0))
    throw std::invalid_argument("--pause-s: must lie between 0 and 60");
  if (!(options.hold_s >= 0.2 && options.hold_s <= 60.0))
    throw std::invalid_argument("--hold-s: must lie between 0.2 and 60");
  bridges::GuidedCalibrationOptions guided;
  guided.pause = std::chrono::duration<double>(options.pause_s);
  guided.hold = std::chrono::duration<double>(options.hold_s);
  guided.without = options.without;
  if (!options.flat_at_m.empty()) {
    const std::vector<double>& p = options.flat_at_m;
    guided.X_WH_flat = Eigen::Isometry3d(Eigen::Translation3d(p[0], p[1], p[2]));
  }
  return guided;
}

std::string user_of(const CalibrateOptions& options) {
  if (!options.user.empty()) return options.user;
  const char* const login = std::getenv("USER");
  return login != nullptr && *login != '\0' ? login : "wearer";
}

/// No value if the user ends the command before.
std::optional<devices::GloveInfo> found_glove(const std::shared_ptr<devices::LcmBus>& bus, std::int64_t device,
                                              StatusLine& line) {
  devices::GloveSearch search(bus);
  bool has_told = false;
  constexpr int kPatientTurns = 20;  // two seconds
  for (int turn = 0; !StopSignal::requested(); ++turn) {
    if (auto info = search.wait_for(device, std::chrono::milliseconds(100))) return info;
    if (turn < kPatientTurns || has_told) continue;
    has_told = true;
    line.say("glissade calibrate: waiting for glove " + std::to_string(device));
    for (const std::string& trouble : search.troubles())
      line.say("glissade calibrate: " + trouble);
  }
  return std::nullopt;
}

void print(const devices::Calibration& calibration) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  constexpr int kNameWidth = 24;
  constexpr int kWidth = 14;
  std::cout << std::left << std::setw(kNameWidth) << "joint" << std::right << std::setw(kWidth) << "gain"
            << std::setw(kWidth) << "offset (deg)" << std::setw(kWidth) << "errors (deg)" << '\n';
  for (std::size_t j = 0; j < calibration.joints.size(); ++j) {
    if (!calibration.joints[j]) continue;
    const devices::JointCalibration& joint = *calibration.joints[j];
    std::cout << std::left << std::setw(kNameWidth) << hands::kJointNames[j] << std::right << std::setw(kWidth)
              << fixed_text(joint.gain, 2) << std::setw(kWidth) << fixed_text(joint.offset * kDegrees, 1)
              << std::setw(kWidth) << fixed_text(joint.residual * kDegrees, 1) << '\n';
  }
}

int run(const CalibrateOptions& options) {
  const bridges::GuidedCalibrationOptions guided = guided_options(options);
  check_recording(options.out, options.overwrites);
  const std::shared_ptr<devices::LcmBus> bus = open_bus(options.lcm);
  const StopSignal stop_signal;
  StatusLine line;
  const std::optional<devices::GloveInfo> info = found_glove(bus, options.device, line);
  if (!info) return 1;
  if (info->side == hands::HandSide::kUnknown || info->descriptor.name.empty())
    throw std::runtime_error("glove " + std::to_string(options.device) +
                             " does not announce its name or its side, so nobody could tell whose calibration it is");
  devices::LcmGlove glove(bus, info->descriptor, {.device = info->device, .glove_session = info->session});
  realtime::SteadyClock clock;
  const bridges::CalibrationVoice voice{
      .say = [&](const std::string& sentence) { line.say("glissade calibrate: " + sentence); },
      .show = [&](const std::string& text) { line.show(text); }};
  auto result = bridges::guide_calibration(
      glove, *info, guided, clock, [] { return !StopSignal::requested(); }, voice);
  line.show({});
  if (!result) return 1;
  result->calibration.user = user_of(options);
  for (const std::string& remark : result->remarks)
    voice.say(remark);
  print(result->calibration);
  std::ofstream file = open_output(options.out);
  file << devices::text_of(result->calibration) << std::flush;
  if (!file) throw std::runtime_error(options.out + ": not everything could be written");
  std::cout << "glissade calibrate: start the glove's bridge again with --calibration " << options.out << '\n';
  return 0;
}

}  // namespace

void add_calibrate_command(CLI::App& app, Command& chosen) {
  const auto options = std::make_shared<CalibrateOptions>();
  CLI::App* command =
      app.add_subcommand("calibrate", "Guide a wearer through poses, and calibrate the glove's sensors");
  command->footer(kCalibrateFooter);
  command->add_option("--out", options->out, "File for the calibration (YAML)")->required();
  command->add_flag("--overwrite", options->overwrites, "Replace an existing file with the calibration");
  command->add_option("--user", options->user, "Name of the wearer; default: the name of the login");
  add_device_option(*command, options->device);
  add_lcm_options(*command, options->lcm);
  command->add_option("--pause-s", options->pause_s, "Time before each pose, in seconds")->capture_default_str();
  command->add_option("--hold-s", options->hold_s, "Time for which each pose is held, in seconds")
      ->capture_default_str();
  command->add_option("--without", options->without, "Joints that stay as the glove reports them")
      ->check(one_of({hands::kJointNames.begin(), hands::kJointNames.end()}));
  command
      ->add_option(
          "--flat-at-m", options->flat_at_m,
          "Position X Y Z of the hand root in the world in the pose 'flat', with fingers along x and palm down. "
          "The command then also finds where the tracker is worn")
      ->expected(3);
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
