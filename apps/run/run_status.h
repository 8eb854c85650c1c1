#pragma once

/// One line about a run while it goes on.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glissade/devices/haptic_state.h>

namespace glissade::apps {

/// What a run looks like now.
struct RunStatus {
  double passed_s = 0.0;             ///< since the first tick
  double duration_s = 0.0;           ///< of the whole run; 0: no limit
  std::optional<double> rate_hz;     ///< of the haptic loop; none before it is known
  std::int64_t late_ticks = 0;       ///< so far
  devices::HapticState state;        ///< after the newest tick
  std::vector<std::int64_t> gloves;  ///< the number of each hand's glove
};

/// Such as "12.3 s  1000 Hz, 0 late, contacts 1.2 ms old  glove 1: 3.4 N, motor sliding". The names are
/// those of the parts.
std::string to_text(const RunStatus& status, const std::vector<std::string>& part_names);

}  // namespace glissade::apps
