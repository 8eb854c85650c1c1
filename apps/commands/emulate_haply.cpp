#include <chrono>
#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/emulate.h>
#include <glissade/apps/commands/emulated_wearer.h>
#include <glissade/apps/files/hand_script.h>
#include <glissade/apps/run/stop_signal.h>
#include <glissade/apps/text.h>
#include <glissade/bridges/haply.h>
#include <glissade/bridges/haply_emulator.h>
#include <glissade/devices/glove_model.h>

namespace glissade::apps {

namespace {

constexpr const char* kHaplyEmulatorFooter =
    "Prints the address of the service on standard output. The service has an Inverse3 with a VerseGrip. The hand\n"
    "begins the script two seconds after the first message of a bridge. The script has the format of 'glissade\n"
    "glove': poses in the frame of the device, and whether the hand is closed, i.e. presses a button. Without\n"
    "--script, the hand rests.\n"
    "Faults: 'garbage' replaces one answer in a hundred, 'cut' shortens one answer in a hundred, 'slow' delays\n"
    "answers by 50 ms, 'unplug' disconnects the device at random, and 'restart' restarts the service at random.\n"
    "\n"
    "Examples:\n"
    "  glissade emulate haply --port 0 --seconds 2\n"
    "  glissade emulate haply --port 10103 --fault garbage unplug --seconds 4 & glissade bridge haply --service "
    "localhost:10103 --seconds 4";

struct HaplyEmulation {
  EmulateOptions emulate;
  int port = bridges::kHaplyPort;
  std::string script;
  bool is_before_3_5 = false;
  bool has_no_handle = false;
  bridges::HaplyFilters filters;
};

bridges::HaplyEmulatorOptions emulator_options(const HaplyEmulation& options) {
  bridges::HaplyEmulatorOptions emulator;
  emulator.port = static_cast<unsigned short>(options.port);
  emulator.is_before_3_5 = options.is_before_3_5;
  emulator.has_handle = !options.has_no_handle;
  emulator.filters = options.filters;
  constexpr double kShare = 0.01;
  if (options.emulate.has_fault("garbage")) emulator.faults.garbage = kShare;
  if (options.emulate.has_fault("cut")) emulator.faults.cut = kShare;
  if (options.emulate.has_fault("slow")) emulator.faults.delay = std::chrono::milliseconds(50);
  emulator.seed = options.emulate.seed;
  if (options.script.empty()) return emulator;
  emulator.wait = kScriptWait;
  const HandScript script = read_hand_script(options.script);
  emulator.hand =
      devices::SimulatedGlove(script.X_WH, script.with_grip({}), devices::read_glove_model(bridges::kInverse3Preset));
  return emulator;
}

std::string status_of(const bridges::EmulatedHaply& device) {
  const Eigen::Vector3d& p = device.p_DC;
  return "tip at " + fixed_text(p.x(), 3) + " " + fixed_text(p.y(), 3) + " " + fixed_text(p.z(), 3) + " m, force " +
         fixed_text(device.f_C_D.norm(), 2) + " N" + (device.is_pressed ? ", button pressed" : "");
}

int run(const HaplyEmulation& options) {
  const StopSignal stop_signal;
  bridges::HaplyEmulator emulator(emulator_options(options));
  std::cout << emulator.service() << std::endl;  // for a program that waits for it
  const LoosePart service{"restart", "the service is gone", "the service is back",
                          [&](bool is_there) { is_there ? emulator.start_service() : emulator.stop_service(); }};
  run_emulator(options.emulate,
               {.loose = {plug_of(emulator), service}, .status = [&] { return status_of(emulator.state()); }});
  const bridges::EmulatedHaply device = emulator.state();
  std::cout << "glissade emulate: " << device.messages << " messages, " << device.other_messages
            << " that the service does not understand; " << fixed_text(device.f_C_D.norm(), 2) << " N at the end\n";
  return 0;
}

}  // namespace

void add_emulate_haply(CLI::App& emulate, Command& chosen) {
  const auto options = std::make_shared<HaplyEmulation>();
  CLI::App* command = emulate.add_subcommand("haply", "Haply's Inverse Service with an Inverse3 and a VerseGrip");
  command->footer(kHaplyEmulatorFooter);
  command->add_option("--port", options->port, "TCP port of this machine; 0: any that is free")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command->add_option("--script", options->script, "Trajectory of the tip (CSV)");
  command->add_flag("--before-3-5", options->is_before_3_5, "Emulate a service before version 3.5");
  command->add_flag("--no-handle", options->has_no_handle, "Emulate a device without a VerseGrip");
  command
      ->add_option("--force-gate", options->filters.force_gate,
                   "Share of an oscillating force that the service removes")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_option("--damping", options->filters.damping_N_s_per_m, "Damping that the service adds, in N s/m")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  command
      ->add_option("--force-scale", options->filters.force_scale, "Factor by which the service multiplies all forces")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  add_emulate_options(*command, options->emulate, {"garbage", "cut", "slow", "unplug", "restart"});
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
