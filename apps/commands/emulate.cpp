#include <algorithm>
#include <random>
#include <thread>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/emulate.h>
#include <glissade/apps/run/status_line.h>
#include <glissade/apps/run/stop_signal.h>
#include <glissade/apps/usage.h>

namespace glissade::apps {

namespace {

constexpr const char* kEmulateFooter =
    "An emulator is a device without hardware, with the wire of the real one. To a bridge there is no difference. The\n"
    "fingers, motors and strings of the gloves 'dynamixel' and 'opengloves' have the dynamics of the presets of the\n"
    "same names, see 'glissade glove --presets'. The hand of 'haply' and 'tracker' follows a script.\n"
    "\n"
    "Examples:\n"
    "  glissade emulate opengloves --seconds 2\n"
    "  glissade emulate opengloves --link glove_port --seconds 4 & glissade bridge opengloves --port glove_port "
    "--seconds 4";

bool has_fault(const EmulateOptions& options, const char* name) {
  return std::find(options.faults.begin(), options.faults.end(), name) != options.faults.end();
}

/// A plug that is in for some seconds and out for up to two, at random.
class LoosePlug {
 public:
  explicit LoosePlug(std::uint64_t seed) : random_(seed) {}

  /// Whether the plug is in, so many seconds after the start. The times must rise.
  bool is_in(double time_s) {
    if (time_s >= next_s_) {
      is_in_ = !is_in_;
      next_s_ = time_s + (is_in_ ? between(1.0, 6.0) : between(0.1, 2.0));
    }
    return is_in_;
  }

 private:
  double between(double least, double most) { return std::uniform_real_distribution<>(least, most)(random_); }

  std::mt19937_64 random_;
  bool is_in_ = true;
  double next_s_ = 3.0;
};

}  // namespace

void add_emulate_options(CLI::App& command, EmulateOptions& options) {
  command.add_option("--fault", options.faults, "What is wrong with the wire, see below")
      ->check(one_of({"garbage", "cut", "wrong-bits", "echo", "slow", "unplug"}));
  command.add_option("--seed", options.seed, "Seed of the faults")->capture_default_str();
  command.add_option("--seconds", options.seconds, "Time after which the device ends; 0: with Ctrl-C")
      ->capture_default_str();
}

bridges::LineFaults line_faults(const EmulateOptions& options, double share, std::chrono::nanoseconds slowness) {
  bridges::LineFaults faults;
  if (has_fault(options, "garbage")) faults.garbage = share;
  if (has_fault(options, "cut")) faults.cut = share;
  if (has_fault(options, "wrong-bits")) faults.flipped_bit = share;
  if (has_fault(options, "slow")) faults.slowness = slowness;
  faults.has_echo = has_fault(options, "echo");
  return faults;
}

void run_emulator(const EmulateOptions& options, const RunningEmulator& emulator) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  StatusLine line;
  const bool is_loose = has_fault(options, "unplug");
  LoosePlug plug(options.seed);
  bool is_in = true;
  while (!StopSignal::requested()) {
    const double time_s = std::chrono::duration<double>(Clock::now() - start).count();
    if (options.seconds > 0.0 && time_s > options.seconds) break;
    const bool is_to_be_in = !is_loose || plug.is_in(time_s);
    if (is_to_be_in != is_in) {
      emulator.set_plugged(is_to_be_in);
      line.say(is_to_be_in ? "glissade emulate: plugged in" : "glissade emulate: unplugged");
      is_in = is_to_be_in;
    }
    line.show(emulator.status());
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  line.show({});
}

void add_emulate_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("emulate", "Be a device without hardware, to try a bridge");
  command->require_subcommand(1);
  command->footer(kEmulateFooter);
  add_emulate_dynamixel(*command, chosen);
  add_emulate_haply(*command, chosen);
  add_emulate_opengloves(*command, chosen);
  add_emulate_tracker(*command, chosen);
}

}  // namespace glissade::apps
