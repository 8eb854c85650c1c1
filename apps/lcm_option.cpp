#include <stdexcept>

#include <glissade/apps/lcm_option.h>

namespace glissade::apps {

void check_reaches_other_processes(const std::string& lcm_url) {
  if (!lcm_url.starts_with("memq:")) return;
  throw std::invalid_argument("--lcm: '" + lcm_url +
                              "' lives inside one process, so server and glove cannot meet there; take a udpm:// one");
}

}  // namespace glissade::apps
