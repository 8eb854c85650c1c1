#include <algorithm>

#include <glissade/haptics/sliding_rules.h>

namespace glissade::haptics {

std::optional<Metaphor> metaphor_from_name(std::string_view name) {
  const auto* const found = std::find(kMetaphorNames.begin(), kMetaphorNames.end(), name);
  if (found == kMetaphorNames.end()) return std::nullopt;
  return static_cast<Metaphor>(found - kMetaphorNames.begin());
}

}  // namespace glissade::haptics
