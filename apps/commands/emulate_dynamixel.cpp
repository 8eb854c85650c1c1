#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <numbers>
#include <string>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/dynamixel_option.h>
#include <glissade/apps/commands/emulate.h>
#include <glissade/apps/commands/emulated_wearer.h>
#include <glissade/apps/run/stop_signal.h>
#include <glissade/apps/text.h>
#include <glissade/bridges/dynamixel_emulator.h>

namespace glissade::apps {

namespace {

constexpr const char* kDynamixelFooter =
    "Prints the port of the bus on standard output. If the glove has a measuring board, a second line has the port of\n"
    "the board. A simulated wearer moves the fingers against the servos. The wearer closes and opens all fingers,\n"
    "each a little later than the one before, or follows --script. The script has the format of 'glissade glove' with\n"
    "joint angles, and begins after two seconds. With --tracker, a tracker sends the poses of the same script 90\n"
    "times a second on HAND_POSE, for 'glissade bridge' with --pose-from.\n"
    "Faults: 'garbage' puts random bytes before one packet in fifty, 'cut' shortens one packet in fifty, 'wrong-bits'\n"
    "changes a bit in one packet in fifty, 'echo' sends back all that arrives, 'slow' delays each answer by 3 ms, and\n"
    "'unplug' removes the ports at random.\n"
    "\n"
    "Examples:\n"
    "  glissade emulate dynamixel --preset doglove --seconds 2\n"
    "  glissade emulate dynamixel --preset doglove --link servos --board-link board --fault wrong-bits unplug "
    "--seconds 4 & glissade bridge dynamixel --preset doglove --port servos --board-port board --seconds 4";

struct DynamixelEmulation {
  EmulateOptions emulate;
  WearerOptions wearer;
  DynamixelOption hand;
  std::string link;
  std::string board_link;
};

std::string status_of(const bridges::DynamixelHand& hand, const std::vector<bridges::EmulatedServoState>& servos) {
  std::string text;
  for (std::size_t i = 0; i < servos.size(); ++i) {
    text += (i > 0 ? ", " : "") + std::string(hands::kJointNames[static_cast<std::size_t>(hand.servos[i].joint)]) +
            " " + fixed_text(servos[i].angle * 180.0 / std::numbers::pi, 0) + "° ";
    text += servos[i].has_torque ? fixed_text(servos[i].torque, 2) + " Nm" : "free";
  }
  return text;
}

int run(const DynamixelEmulation& options) {
  constexpr double kShare = 0.02;
  const bridges::DynamixelHand hand = read_hand(options.hand);
  const StopSignal stop_signal;
  bridges::DynamixelEmulator emulator(hand,
                                      {.link = options.link,
                                       .board_link = options.board_link,
                                       .faults = line_faults(options.emulate, kShare, std::chrono::milliseconds(3)),
                                       .seed = options.emulate.seed,
                                       .wearer = wearer_of(options.wearer)});
  std::cout << emulator.port() << std::endl;  // for a program that waits for it
  if (!emulator.board_port().empty()) std::cout << emulator.board_port() << std::endl;
  double greatest_Nm = 0.0;
  const auto status = [&] {
    const auto servos = emulator.servos();
    for (const bridges::EmulatedServoState& servo : servos)
      greatest_Nm = std::max(greatest_Nm, std::abs(servo.torque));
    return status_of(hand, servos);
  };
  run_emulator(options.emulate, {.loose = {plug_of(emulator)}, .status = status});
  const auto servos = emulator.servos();
  const auto held = std::count_if(servos.begin(), servos.end(), [](const auto& servo) { return servo.has_torque; });
  std::cout << "glissade emulate: greatest torque of a servo " << fixed_text(greatest_Nm, 2) << " Nm, " << held
            << " servos have torque at the end\n";
  return 0;
}

}  // namespace

void add_emulate_dynamixel(CLI::App& emulate, Command& chosen) {
  const auto options = std::make_shared<DynamixelEmulation>();
  CLI::App* glove = emulate.add_subcommand("dynamixel", "A glove of Dynamixel servos");
  glove->footer(kDynamixelFooter);
  add_dynamixel_option(*glove, options->hand);
  glove->add_option("--link", options->link, "Path of a link to the port of the bus; the link stays after unplugging");
  glove->add_option("--board-link", options->board_link, "The same for the measuring board");
  add_wearer_options(*glove, options->wearer);
  add_emulate_options(*glove, options->emulate);
  glove->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
