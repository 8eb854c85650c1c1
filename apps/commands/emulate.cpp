#include <algorithm>
#include <random>
#include <stdexcept>
#include <thread>
#include <utility>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/emulate.h>
#include <glissade/apps/run/status_line.h>
#include <glissade/apps/run/stop_signal.h>
#include <glissade/apps/usage.h>

namespace glissade::apps {

namespace {

constexpr const char* kEmulateFooter =
    "An emulator is a program that speaks the protocol of a device, so you can try a bridge without hardware. A\n"
    "bridge cannot tell it from the device. The fingers, motors and strings of the gloves 'dynamixel' and "
    "'opengloves'\n"
    "have the dynamics of the presets of the same names, see 'glissade glove --presets'. The hand of 'haply', and the\n"
    "fingers and palm of a glove, can follow a script.\n"
    "\n"
    "Examples:\n"
    "  glissade emulate opengloves --seconds 2\n"
    "  glissade emulate opengloves --link glove_port --seconds 4 & glissade bridge opengloves --port glove_port "
    "--seconds 4";

/// A part that is there for some seconds and gone for up to two, at random.
class Failing {
 public:
  Failing(const LoosePart& part, std::uint64_t seed) : part_(part), random_(seed) {}

  /// `time_s` counts from the start, and rises.
  void advance(double time_s, StatusLine& line) {
    if (time_s < next_s_) return;
    is_there_ = !is_there_;
    next_s_ = time_s + (is_there_ ? between(1.0, 6.0) : between(0.1, 2.0));
    part_.set(is_there_);
    line.say(std::string("glissade emulate: ") + (is_there_ ? part_.back : part_.gone));
  }

 private:
  double between(double least, double most) { return std::uniform_real_distribution<>(least, most)(random_); }

  LoosePart part_;
  std::mt19937_64 random_;
  bool is_there_ = true;
  double next_s_ = 3.0;
};

}  // namespace

bool EmulateOptions::has_fault(std::string_view name) const {
  return std::find(faults.begin(), faults.end(), name) != faults.end();
}

void add_emulate_options(CLI::App& command, EmulateOptions& options, const std::vector<std::string>& faults) {
  command.add_option("--fault", options.faults, "Faults of the connection, see below")->check(one_of(faults));
  command.add_option("--seed", options.seed, "Seed of the faults")->capture_default_str();
  command.add_option("--seconds", options.seconds, "Duration in seconds; 0: until Ctrl-C")->capture_default_str();
}

bridges::LineFaults line_faults(const EmulateOptions& options, double share, std::chrono::nanoseconds slowness) {
  bridges::LineFaults faults;
  if (options.has_fault("garbage")) faults.garbage = share;
  if (options.has_fault("cut")) faults.cut = share;
  if (options.has_fault("wrong-bits")) faults.flipped_bit = share;
  if (options.has_fault("slow")) faults.slowness = slowness;
  faults.has_echo = options.has_fault("echo");
  return faults;
}

void run_emulator(const EmulateOptions& options, const RunningEmulator& emulator) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  StatusLine line;
  std::vector<Failing> failing;
  for (const LoosePart& part : emulator.loose) {
    if (options.has_fault(part.fault)) failing.emplace_back(part, options.seed + failing.size());
  }
  while (!StopSignal::requested()) {
    const double time_s = std::chrono::duration<double>(Clock::now() - start).count();
    if (options.seconds > 0.0 && time_s > options.seconds) break;
    for (Failing& part : failing)
      part.advance(time_s, line);
    line.show(emulator.status());
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  line.show({});
}

void add_emulate_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("emulate", "Emulate a device, to try a bridge without hardware");
  command->require_subcommand(1);
  command->footer(kEmulateFooter);
  add_emulate_dynamixel(*command, chosen);
  add_emulate_haply(*command, chosen);
  add_emulate_opengloves(*command, chosen);
}

}  // namespace glissade::apps
