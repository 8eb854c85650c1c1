#include <stdexcept>

#include <CLI/CLI.hpp>

#include <glissade/apps/scene/sliding_option.h>
#include <glissade/apps/text.h>
#include <glissade/apps/usage.h>
#include <glissade/contact/spring.h>

namespace glissade::apps {

void add_sliding_options(CLI::App& command, SlidingChoice& choice) {
  command.add_option("--metaphor", choice.metaphor, "Metaphor, the rule by which the hand moves the part, see below")
      ->capture_default_str();
  command
      .add_option("--stiffness", choice.stiffness_N_per_m,
                  "Stiffness of the spring between hand and part in N/m, 10 to 100000; default: 1000")
      ->check(positive());
  command
      .add_option("--friction", choice.friction,
                  "Coefficient of Coulomb friction, or two coefficients: sliding and at rest")
      ->expected(1, 2)
      ->check(not_negative());
  command.add_flag("--spiral-search", choice.spiral_search, "Search in a spiral when the part is stuck, see below");
  command.add_flag("--depenetrate", choice.depenetrate,
                   "Accept a part that starts in obstacles, and move it out, see below");
}

contact::Metaphor metaphor_of(const SlidingChoice& choice) {
  const auto metaphor = contact::metaphor_from_name(choice.metaphor);
  if (metaphor) return *metaphor;
  throw std::invalid_argument(
      "--metaphor: " + in_quotes(choice.metaphor) + " is unknown" +
      did_you_mean(choice.metaphor, {contact::kMetaphorNames.begin(), contact::kMetaphorNames.end()}) + "; known are " +
      joined(contact::kMetaphorNames));
}

contact::CouplingStiffness stiffness_of(const SlidingChoice& choice, double radius) {
  return contact::stiffness_of_part(radius, choice.stiffness_N_per_m.value_or(contact::kUsualStiffness_N_per_m));
}

contact::SlidingRules with_choice(contact::SlidingRules rules, const SlidingChoice& choice) {
  constexpr double kSoftest_N_per_m = 10.0;
  constexpr double kStiffest_N_per_m = 1e5;
  const double stiffness = choice.stiffness_N_per_m.value_or(kSoftest_N_per_m);
  if (!(stiffness >= kSoftest_N_per_m && stiffness <= kStiffest_N_per_m)) {
    throw std::invalid_argument("--stiffness: must lie between 10 and 100000 N/m, not " + format_number(stiffness));
  }
  rules.friction.sliding = choice.friction.empty() ? 0.0 : choice.friction.front();
  rules.friction.at_rest = choice.friction.empty() ? 0.0 : choice.friction.back();
  if (rules.friction.at_rest < rules.friction.sliding) {
    throw std::invalid_argument(
        "--friction: the second coefficient, at rest, must not be less than the first, sliding");
  }
  rules.spiral_search = choice.spiral_search;
  if (choice.depenetrate) rules.overlap = contact::OverlapRule::kDepenetrate;
  return rules;
}

std::string words_of(const SlidingChoice& choice) {
  const contact::SlidingRules rules = with_choice({}, choice);
  const contact::Friction& friction = rules.friction;
  std::string words = friction.is_on() ? "friction " + format_number(friction.sliding) : "no friction";
  if (friction.at_rest != friction.sliding) words += ", at rest " + format_number(friction.at_rest);
  if (rules.spiral_search) words += "; spiral search";
  if (rules.overlap == contact::OverlapRule::kDepenetrate) words += "; depenetrate";
  if (choice.stiffness_N_per_m) words += "; " + format_number(*choice.stiffness_N_per_m) + " N/m";
  return words;
}

}  // namespace glissade::apps
