#include <CLI/CLI.hpp>

#include <glissade/apps/commands/bridge.h>

namespace glissade::apps {

namespace {

constexpr const char* kBridgeFooter =
    "A bridge connects a device to the link between gloves and haptic servers. For the server ('glissade run'), the\n"
    "device is a glove like any other. If the device is unplugged, the bridge opens the port again when the device is\n"
    "back. If the bridge ends or is killed, the device lets go of the hand.\n"
    "\n"
    "Examples:\n"
    "  glissade bridge opengloves --list\n"
    "  glissade emulate opengloves --link glove_port --seconds 4 & glissade bridge opengloves --port glove_port "
    "--seconds 4";

}  // namespace

void add_bridge_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("bridge", "Connect a real device to the haptic server");
  command->require_subcommand(1);
  command->footer(kBridgeFooter);
  add_bridge_dynamixel(*command, chosen);
  add_bridge_opengloves(*command, chosen);
  add_bridge_haply(*command, chosen);
}

}  // namespace glissade::apps
