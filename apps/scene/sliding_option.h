#pragma once

/// The options --metaphor, --stiffness, --friction, --spiral-search and --depenetrate of the commands that move parts.

#include <optional>
#include <string>
#include <vector>

#include <glissade/contact/sliding_rules.h>
#include <glissade/contact/spring.h>
#include <glissade/haptics/coupling.h>

namespace CLI {
class App;
}

namespace glissade::apps {

struct SlidingChoice {
  std::string metaphor = "force-feedback";
  std::optional<double> stiffness_N_per_m;  ///< of the coupling against translation; none: the usual one
  std::vector<double> friction;             ///< none, one for both, or sliding and at rest
  bool spiral_search = false;
  bool depenetrate = false;

  bool has_rules() const { return !friction.empty() || spiral_search || depenetrate; }
};

/// What the end of `--help` says about these options.
inline constexpr const char* kSlidingChoiceHelp =
    "\n\n"
    "Metaphors: the metaphor is the rule by which the hand moves the part. The ghost is the pose that the part would\n"
    "have if nothing were in the way. The metaphor determines the target of the part. In the first and the third\n"
    "metaphor, the target is the ghost.\n"
    "  force-feedback      rigid grasp; the device holds the hand back, and the part catches up at a limited speed\n"
    "  rubber-band         a rubber band ties the part's compliance point, by default the centre of its bounding box,\n"
    "                      to the ghost; contacts alone turn the part, and the hand feels no torque\n"
    "  rubber-band-spring  a rubber band and a spiral spring tie the part to the ghost; the part catches up at once\n"
    "  incremental         the part repeats each motion of the ghost; motion that contacts prevent is lost\n"
    "\n"
    "Stiffness: if the part cannot follow, the hand feels a spring of the stiffness --stiffness, 10 to 100000 N/m\n"
    "(default: 1000 N/m). The stiffness against rotation is this value times the square of the part's radius. With a\n"
    "device, the spring is never stiffer than the device can render without shaking. If this makes the spring softer,\n"
    "the command says so.\n"
    "\n"
    "Rules:\n"
    "  --spiral-search     If a part stands still for 0.1 s away from its target, its aim goes round the target in a\n"
    "                      spiral, as a hand searches for a hole. The spiral grows to 1.6 mm in two seconds.\n"
    "                      With --friction, press lightly: the spiral pulls with 1.6 N at most.\n"
    "  --depenetrate       A part that starts in obstacles, deeper than its margin, moves out at 0.2 m/s at most. Its\n"
    "                      path is short and straight, and leads no deeper into any obstacle. If there is no such\n"
    "                      path, the hand can draw the part out, but never deeper in or through a wall.";

void add_sliding_options(CLI::App& command, SlidingChoice& choice);

/// The wanted coupling of a part of this radius (metres).
contact::CouplingStiffness stiffness_of(const SlidingChoice& choice, double radius);
/// Throws std::invalid_argument, naming the option.
contact::Metaphor metaphor_of(const SlidingChoice& choice);
/// `rules` with the choice of the user. Throws std::invalid_argument, naming the option.
contact::SlidingRules with_choice(contact::SlidingRules rules, const SlidingChoice& choice);
/// What a page says of a choice: "friction 0.2, at rest 0.3; spiral search; 500 N/m", or "no friction".
std::string words_of(const SlidingChoice& choice);

}  // namespace glissade::apps
