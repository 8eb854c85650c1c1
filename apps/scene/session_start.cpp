#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

#include <glissade/apps/durations.h>
#include <glissade/apps/scene/session_start.h>
#include <glissade/apps/scene/start_overlap.h>
#include <glissade/apps/text.h>
#include <glissade/contact/spring.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/simulation/scene.h>

namespace glissade::apps {

namespace {

void soften(contact::HeldPart& part, const devices::DeviceDescriptor& device, std::chrono::nanoseconds period) {
  part.stiffness = haptics::coupling_for(device, part.stiffness.value(), period).stiffness;
}

/// The sentence about a part that is held beside its reference point, if contacts are then less than half as stiff.
std::optional<std::string> softer_beside(const devices::DeviceDescriptor& device,
                                         const contact::CouplingStiffness& wanted, double stiffness,
                                         std::chrono::nanoseconds period) {
  constexpr double kLever_m = 0.1;
  const double beside = haptics::coupling_within_limits(device, wanted, period, std::chrono::nanoseconds(0), kLever_m)
                            .stiffness.translational;
  if (beside >= 0.5 * stiffness) return std::nullopt;
  return "device " + in_quotes(device.name) + ": a hand 0.1 m beside the reference point of its part has " +
         rounded_text(beside) + " N/m instead of " + rounded_text(stiffness) +
         ": limited by the rotational stiffness that it renders passively";
}

/// The sentence about a link that delays by a period, if contacts are then less than half as stiff. Force and torque
/// shrink alike.
std::optional<std::string> softer_by_link(const devices::DeviceDescriptor& device,
                                          const contact::CouplingStiffness& wanted, std::chrono::nanoseconds period) {
  const double delay_s = std::max(in_seconds(period), 1.0 / device.update_rate);
  const auto delay = std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(delay_s));
  const contact::CouplingStiffness full = haptics::coupling_for(device, wanted, period).stiffness;
  const contact::CouplingStiffness left = haptics::coupling_within_limits(device, full, period, delay).stiffness;
  const double share = std::min(left.translational / full.translational, left.rotational / full.rotational);
  if (share >= 0.5) return std::nullopt;
  return "device " + in_quotes(device.name) + ": if the round trip of its link takes " + fixed_text(1e3 * delay_s, 1) +
         " ms, contacts have " + rounded_text(share * full.translational) + " N/m instead of " +
         rounded_text(full.translational) + ": the largest that is passive with the damping that it tells";
}

bool has_joints(const devices::DeviceDescriptor& device) {
  for (std::size_t j = 0; j < hands::kJoints; ++j)
    if (device.joint_lower[j] != device.joint_upper[j]) return true;
  return false;
}

}  // namespace

std::vector<std::string> limits_of_devices(const std::vector<Grip>& grips, const SlidingChoice& choice,
                                           std::chrono::nanoseconds period, bool has_links) {
  std::vector<std::string> sentences;
  const contact::CouplingStiffness wanted = stiffness_of(choice, 1.0);
  const auto add = [&sentences](const std::string& sentence) {
    if (std::find(sentences.begin(), sentences.end(), sentence) == sentences.end()) sentences.push_back(sentence);
  };
  for (const Grip& grip : grips) {
    if (grip.fingers && !has_joints(grip.device))
      add("device " + in_quotes(grip.device.name) +
          ": it tells of no joint (joint_lower, joint_upper), so its hand can hardly close and grasp");
    if (grip.device.max_force == 0.0) continue;  // the hand feels no force of contacts
    const double stiffness = haptics::coupling_for(grip.device, wanted, period).stiffness.translational;
    constexpr double kNearly = 1.0 - 1e-3;
    if (const std::optional<std::string> sentence = softer_beside(grip.device, wanted, stiffness, period))
      add(*sentence);
    if (const auto sentence = has_links ? softer_by_link(grip.device, wanted, period) : std::nullopt) add(*sentence);
    if (stiffness >= kNearly * wanted.translational) continue;
    const std::string reason =
        stiffness >= kNearly * grip.device.max_stiffness
            ? "its largest stiffness"
            : "the largest that is passive with the damping, friction, resolution and delay that it tells";
    add("device " + in_quotes(grip.device.name) + ": contacts have " + rounded_text(stiffness) + " N/m instead of " +
        rounded_text(wanted.translational) + ": " + reason);
  }
  return sentences;
}

std::vector<std::shared_ptr<const grasping::HandModel>> hand_models(const grasping::GraspSimulation& simulation,
                                                                    std::size_t count) {
  std::vector<std::shared_ptr<const grasping::HandModel>> models(count);
  for (std::size_t h = 0; h < simulation.hand_count(); ++h)
    models[h] = simulation.model(h);
  return models;
}

grasping::GraspSimulation start_simulation(const HapticScene& scene, const std::vector<Grip>& grips,
                                           const SlidingChoice& choice, const contact::SlidingRules& rules,
                                           std::chrono::nanoseconds period) {
  std::vector<contact::HeldPart> parts = held_parts(scene, choice);
  const bool has_fingers = std::any_of(grips.begin(), grips.end(), [](const Grip& grip) { return grip.fingers; });
  std::vector<grasping::HandShape> hands;
  for (const Grip& grip : grips) {
    if (grip.fingers.has_value() != has_fingers) throw std::invalid_argument("either all hands have fingers, or none");
    if (has_fingers) hands.push_back(*grip.fingers);
    for (std::size_t p = 0; p < scene.parts.size(); ++p)
      soften(parts[p], grip.device, period);
  }
  const grasping::GraspRules chosen{.sliding = with_choice(rules, choice)};
  try {
    return {scene.obstacles, parts, simulation::hand_models(hands), chosen};
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(scene.source + ": " + error.what() + overlap_advice(scene, !choice.depenetrate));
  }
}

}  // namespace glissade::apps
