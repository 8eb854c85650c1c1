#include <limits>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include <glissade/apps/lcm_option.h>

namespace glissade::apps {

void add_device_option(CLI::App& command, std::int64_t& device) {
  command.add_option("--device", device, "Number of the glove; each glove at an LCM address needs one of its own")
      ->check(CLI::Range(std::int64_t{1}, std::numeric_limits<std::int64_t>::max()))
      ->capture_default_str();
}

void check_reaches_other_processes(const std::string& lcm_url) {
  if (!lcm_url.starts_with("memq:")) return;
  throw std::invalid_argument("--lcm: '" + lcm_url +
                              "' connects threads of one process only; server and glove need a udpm:// address");
}

}  // namespace glissade::apps
