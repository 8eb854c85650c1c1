#include <stdexcept>

#include <glissade/apps/session_start.h>

namespace glissade::apps {

haptics::MultiPartSliding start_sliding(const HapticScene& scene, const std::vector<Grip>& grips,
                                        const SlidingChoice& choice, const haptics::SlidingRules& rules,
                                        std::chrono::nanoseconds period) {
  std::vector<haptics::HeldPart> parts = held_parts(scene, metaphor_of(choice));
  for (const Grip& grip : grips) {
    if (!grip.part) continue;
    haptics::HeldPart& part = parts[*grip.part];
    const haptics::CouplingStiffness wanted =
        part.stiffness.value_or(haptics::default_stiffness(part.part_V->radius()));
    part.stiffness = coupling_for(grip.device, wanted, period).stiffness;
  }
  try {
    return {scene.obstacles, parts, with_choice(rules, choice)};
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(scene.source + ": " + error.what());
  }
}

}  // namespace glissade::apps
