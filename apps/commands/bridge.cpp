#include <CLI/CLI.hpp>

#include <glissade/apps/commands/bridge.h>

namespace glissade::apps {

namespace {

constexpr const char* kBridgeFooter =
    "A bridge joins a device to the link between gloves and haptic servers: the server ('glissade run') sees a glove\n"
    "as any other. The bridge opens the port again when the device was unplugged. It lets go of the hand when it "
    "ends\n"
    "or is killed.\n"
    "\n"
    "Examples:\n"
    "  glissade bridge opengloves --list\n"
    "  glissade emulate opengloves --link glove_port --seconds 4 & glissade bridge opengloves --port glove_port "
    "--seconds 4";

}  // namespace

void add_bridge_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("bridge", "Join a device of one's own to the haptic server");
  command->require_subcommand(1);
  command->footer(kBridgeFooter);
  add_bridge_dynamixel(*command, chosen);
  add_bridge_opengloves(*command, chosen);
  add_bridge_haply(*command, chosen);
}

}  // namespace glissade::apps
