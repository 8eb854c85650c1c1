#pragma once

/// The options --lcm, --key-file and --device of the commands that talk to another process.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <glissade/devices/lcm_bus.h>

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace glissade::apps {

/// The options --lcm and --key-file.
struct LcmAddress {
  std::string url = "udpm://239.255.76.67:7667?ttl=0";
  std::string key_file;
};
void add_lcm_options(CLI::App& command, LcmAddress& address);
/// A connection to LCM. Throws as `LcmBus` does; if this machine has no route for multicast, the message has the
/// command that makes one.
std::shared_ptr<devices::LcmBus> connect_to_lcm(const std::string& url,
                                                const std::optional<devices::LcmKey>& key = std::nullopt);
/// A bus that reaches other processes. Throws std::invalid_argument, naming option or file, as `LcmBus` and
/// `read_lcm_key` do.
std::shared_ptr<devices::LcmBus> open_bus(const LcmAddress& address);

/// Accepts the number of a glove, from 1 to the largest of 64 bits.
CLI::Validator glove_number();
/// Adds --device, the number of a glove.
void add_device_option(CLI::App& command, std::int64_t& device);

}  // namespace glissade::apps
