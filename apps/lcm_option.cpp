#include <stdexcept>

#include <glissade/apps/lcm_option.h>

namespace glissade::apps {

void check_reaches_other_processes(const std::string& lcm_url) {
  if (!lcm_url.starts_with("memq:")) return;
  throw std::invalid_argument("--lcm: '" + lcm_url +
                              "' connects threads of one process only; server and glove need a udpm:// address");
}

}  // namespace glissade::apps
