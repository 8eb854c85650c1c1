#include <algorithm>
#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/emulate.h>
#include <glissade/apps/commands/emulated_wearer.h>
#include <glissade/apps/run/stop_signal.h>
#include <glissade/apps/text.h>
#include <glissade/apps/usage.h>
#include <glissade/bridges/opengloves_emulator.h>

namespace glissade::apps {

namespace {

constexpr const char* kOpenGlovesFooter =
    "Prints the port of the glove on standard output. A simulated wearer moves the fingers within the limits of the\n"
    "servos. The wearer closes and opens all fingers, each a little later than the one before, or follows --script.\n"
    "The script has the format of 'glissade glove' with joint angles, and begins after two seconds. With --tracker, a\n"
    "tracker sends the poses of the same script 90 times a second on HAND_POSE, for 'glissade bridge' with\n"
    "--pose-from.\n"
    "Faults: 'garbage' puts random bytes before one state in ten, 'cut' shortens one state in ten, 'wrong-bits'\n"
    "changes a bit in one state in ten, 'echo' sends back all that arrives, 'slow' delays each state by 0.1 s, and\n"
    "'unplug' removes the port at random.\n"
    "\n"
    "Examples:\n"
    "  glissade emulate opengloves --seconds 2\n"
    "  glissade emulate opengloves --link glove_port --fault garbage unplug --seconds 4 & glissade bridge opengloves "
    "--port glove_port --seconds 4\n"
    "\n"
    "With the files of 'glissade example':\n"
    "  glissade emulate opengloves --link glove_port --script door_module_script.csv --tracker --seconds 6 & glissade "
    "bridge opengloves --port glove_port --pose-from lcm --seconds 6";

struct OpenGlovesEmulation {
  EmulateOptions emulate;
  WearerOptions wearer;
  std::string encoding = "alpha";
  std::string link;
  int tcp_port = 0;
  double rate_Hz = 90.0;
  int full_scale = 4095;
};

bridges::OpenGlovesEmulatorOptions emulator_options(const OpenGlovesEmulation& options) {
  constexpr double kShare = 0.1;
  bridges::OpenGlovesEmulatorOptions emulator;
  emulator.encoding =
      options.encoding == "alpha" ? bridges::OpenGlovesEncoding::kAlpha : bridges::OpenGlovesEncoding::kLegacy;
  emulator.rate_Hz = options.rate_Hz;
  emulator.full_scale = options.full_scale;
  emulator.link = options.link;
  emulator.is_tcp = options.tcp_port > 0;
  emulator.tcp_port = static_cast<unsigned short>(options.tcp_port);
  emulator.faults = line_faults(options.emulate, kShare, std::chrono::milliseconds(100));
  emulator.seed = options.emulate.seed;
  emulator.wearer = wearer_of(options.wearer);
  return emulator;
}

std::string status_of(const bridges::EmulatedGlove& glove) {
  std::string text = "curls";
  for (const double curl : glove.curls)
    text += " " + fixed_text(curl, 2);
  text += ", limits";
  for (const int limit : glove.limits)
    text += " " + std::to_string(limit);
  return text;
}

int run(const OpenGlovesEmulation& options) {
  const StopSignal stop_signal;
  bridges::OpenGlovesEmulator emulator(emulator_options(options));
  std::cout << emulator.port() << std::endl;  // for a program that waits for it
  run_emulator(options.emulate, {.loose = {plug_of(emulator)}, .status = [&] { return status_of(emulator.state()); }});
  const bridges::EmulatedGlove glove = emulator.state();
  const auto stops = std::count_if(glove.limits.begin(), glove.limits.end(), [](int limit) { return limit > 0; });
  std::cout << "glissade emulate: " << glove.limit_lines << " lines with limits, " << glove.stopping_lines
            << " of them stop a finger; " << stops << " strings stop a finger at the end\n";
  return 0;
}

}  // namespace

void add_emulate_opengloves(CLI::App& emulate, Command& chosen) {
  const auto options = std::make_shared<OpenGlovesEmulation>();
  CLI::App* glove = emulate.add_subcommand("opengloves", "A glove with the firmware of LucidGloves");
  glove->footer(kOpenGlovesFooter);
  CLI::Option* link =
      glove->add_option("--link", options->link, "Path of a link to the port; the link stays after unplugging");
  glove->add_option("--tcp", options->tcp_port, "TCP port of this machine, instead of a serial port")
      ->check(CLI::Range(1, 65535))
      ->excludes(link);
  glove->add_option("--encoding", options->encoding, "Encoding of the lines")
      ->check(one_of({"alpha", "legacy"}))
      ->capture_default_str();
  glove->add_option("--rate-hz", options->rate_Hz, "States per second, at most; 1 to 1000")->capture_default_str();
  glove->add_option("--full-scale", options->full_scale, "Number that a closed finger gives")->capture_default_str();
  add_wearer_options(*glove, options->wearer);
  add_emulate_options(*glove, options->emulate);
  glove->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
