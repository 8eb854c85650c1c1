#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/command.h>
#include <glissade/apps/run/status_line.h>
#include <glissade/apps/run/stop_signal.h>
#include <glissade/apps/text.h>
#include <glissade/apps/usage.h>
#include <glissade/bridges/opengloves_emulator.h>

namespace glissade::apps {

namespace {

constexpr const char* kEmulateFooter =
    "An emulator is a device without hardware, with the wire of the real one. To a bridge there is no difference.\n"
    "\n"
    "Examples:\n"
    "  glissade emulate opengloves --seconds 2\n"
    "  glissade emulate opengloves --link glove_port --seconds 4 & glissade bridge opengloves --port glove_port "
    "--seconds 4";

constexpr const char* kOpenGlovesFooter =
    "Prints its port on standard output. A wearer closes and opens all fingers, each a little later than the one\n"
    "before, within the limits of the servos. Faults: 'garbage' before one state in ten, 'half-lines' in one state in\n"
    "ten, 'echo' of all that arrives, 'slow' servos (0.3 s late), 'unplug' for a second out of five.\n"
    "\n"
    "Examples:\n"
    "  glissade emulate opengloves --seconds 2\n"
    "  glissade emulate opengloves --link glove_port --fault garbage unplug --seconds 4 & glissade bridge opengloves "
    "--port glove_port --seconds 4";

struct EmulateOptions {
  std::string encoding = "alpha";
  std::string link;
  int tcp_port = 0;
  double rate_Hz = 90.0;
  int full_scale = 4095;
  std::vector<std::string> faults;
  double seconds = 0.0;
};

bridges::EmulatorOptions emulator_options(const EmulateOptions& options) {
  bridges::EmulatorOptions emulator;
  emulator.encoding =
      options.encoding == "alpha" ? bridges::OpenGlovesEncoding::kAlpha : bridges::OpenGlovesEncoding::kLegacy;
  emulator.rate_Hz = options.rate_Hz;
  emulator.full_scale = options.full_scale;
  emulator.link = options.link;
  emulator.is_tcp = options.tcp_port > 0;
  emulator.tcp_port = static_cast<unsigned short>(options.tcp_port);
  constexpr double kShare = 0.1;
  for (const std::string& fault : options.faults) {
    if (fault == "garbage") emulator.faults.garbage = kShare;
    if (fault == "half-lines") emulator.faults.half_lines = kShare;
    if (fault == "echo") emulator.faults.echo = true;
    if (fault == "slow") emulator.faults.delay = std::chrono::milliseconds(300);
  }
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

int run(const EmulateOptions& options) {
  const StopSignal stop_signal;
  bridges::OpenGlovesEmulator emulator(emulator_options(options));
  std::cout << emulator.port() << std::endl;  // for a program that waits for it
  StatusLine line;
  const bool unplugs = std::find(options.faults.begin(), options.faults.end(), "unplug") != options.faults.end();
  constexpr int kTicks_per_s = 10;
  bool is_plugged = true;
  for (int tick = 0; !StopSignal::requested(); ++tick) {
    if (options.seconds > 0.0 && tick >= kTicks_per_s * options.seconds) break;
    const bool is_to_be_plugged = !unplugs || tick / kTicks_per_s % 5 != 4;
    if (is_to_be_plugged != is_plugged) {
      is_to_be_plugged ? emulator.plug() : emulator.unplug();
      line.say(is_to_be_plugged ? "glissade emulate: plugged in at " + emulator.port() : "glissade emulate: unplugged");
      is_plugged = is_to_be_plugged;
    }
    line.show(status_of(emulator.state()));
    std::this_thread::sleep_for(std::chrono::milliseconds(1000 / kTicks_per_s));
  }
  line.show({});
  const bridges::EmulatedGlove glove = emulator.state();
  std::cout << "glissade emulate: " << glove.limit_lines << " lines with limits, " << glove.stopping_lines
            << " of them stop a finger\n";
  return 0;
}

}  // namespace

void add_emulate_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("emulate", "Be a device without hardware, to try a bridge");
  command->require_subcommand(1);
  command->footer(kEmulateFooter);
  const auto options = std::make_shared<EmulateOptions>();
  CLI::App* glove = command->add_subcommand("opengloves", "A glove with the firmware of LucidGloves");
  glove->footer(kOpenGlovesFooter);
  CLI::Option* link =
      glove->add_option("--link", options->link, "Path of a link to the port, which stays the same after unplugging");
  glove->add_option("--tcp", options->tcp_port, "TCP port of this machine in place of a serial port")
      ->check(CLI::Range(1, 65535))
      ->excludes(link);
  glove->add_option("--encoding", options->encoding, "Encoding of the lines")
      ->check(one_of({"alpha", "legacy"}))
      ->capture_default_str();
  glove->add_option("--rate-hz", options->rate_Hz, "States per second, at most; 1 to 1000")->capture_default_str();
  glove->add_option("--full-scale", options->full_scale, "Number of a closed finger")->capture_default_str();
  glove->add_option("--fault", options->faults, "What is wrong with the wire, see below")
      ->check(one_of({"garbage", "half-lines", "echo", "slow", "unplug"}));
  glove->add_option("--seconds", options->seconds, "Time after which the glove ends; 0: with Ctrl-C")
      ->capture_default_str();
  glove->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
