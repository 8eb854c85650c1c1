#include <cerrno>
#include <charconv>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>

#include <glissade/apps/run/lcm_option.h>
#include <glissade/apps/run/machine_check.h>
#include <glissade/apps/text.h>
#include <glissade/files/file_checks.h>

namespace glissade::apps {

CLI::Validator glove_number() {
  // CLI::Range would take a number that is too large for the largest.
  const auto check = [](const std::string& text) -> std::string {
    std::int64_t number = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc{} && stop == text.data() + text.size() && number >= 1) return {};
    return in_quotes(text) + " is not the number of a glove, from 1 to " +
           std::to_string(std::numeric_limits<std::int64_t>::max());
  };
  return {[check](std::string& text) { return check(text); }, "GLOVE"};
}

void add_device_option(CLI::App& command, std::int64_t& device) {
  command.add_option("--device", device, "Number of the glove; each glove at an LCM address needs a different number")
      ->check(glove_number())
      ->capture_default_str();
}

void add_lcm_options(CLI::App& command, LcmAddress& address) {
  command.add_option("--lcm", address.url, "LCM address that glove and haptic server share")->capture_default_str();
  command.add_option(
      "--key-file", address.key_file,
      "File with a key, as printed by 'openssl rand -hex 32': messages without a code made with this key "
      "are dropped. Glove and haptic server need the same key");
}

std::shared_ptr<devices::LcmBus> connect_to_lcm(const std::string& url, const std::optional<devices::LcmKey>& key) {
  try {
    return std::make_shared<devices::LcmBus>(url, key);
  } catch (const std::invalid_argument& error) {
    const std::string reason = error.what();
    if (reason.find(std::generic_category().message(ENETUNREACH)) == std::string::npos) throw;
    throw std::invalid_argument(
        reason + " There is no route for multicast; this makes one that stays on this machine: " + kMulticastMend);
  }
}

std::shared_ptr<devices::LcmBus> open_bus(const LcmAddress& address) {
  if (address.url.starts_with("memq:")) {
    throw std::invalid_argument("--lcm: '" + address.url +
                                "' connects threads of one process only; server and glove need a udpm:// address");
  }
  std::optional<devices::LcmKey> key;
  if (!address.key_file.empty()) {
    check_input(address.key_file);
    key = devices::read_lcm_key(address.key_file);
  }
  return connect_to_lcm(address.url, key);
}

}  // namespace glissade::apps
