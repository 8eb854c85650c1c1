#include <chrono>

#include <glissade/apps/run/force_reason.h>
#include <glissade/apps/run/run_status.h>
#include <glissade/apps/text.h>

namespace glissade::apps {

namespace {

std::string hand_text(const devices::HapticState& state, std::size_t number, std::int64_t glove,
                      const std::vector<std::string>& part_names) {
  const devices::HapticHandState& hand = state.hands[number];
  const double force = hand.force_W.norm();
  const std::string reason = to_text(force_reason(state, number));
  std::string text = "glove " + std::to_string(glove) + ": ";
  if (force != 0.0 || (hand.part >= 0 && reason.empty())) text += fixed_text(force, 1) + " N, ";
  if (hand.part < 0) {
    text += "holds nothing";
  } else {
    text += one_line(part_names[static_cast<std::size_t>(hand.part)]);
    const devices::PartState part = state.parts[static_cast<std::size_t>(hand.part)].state;
    if (part != devices::PartState::kUnknown) text += " " + std::string(name_of(part));
  }
  return reason.empty() ? text : text + ", " + reason;
}

}  // namespace

std::string to_text(const RunStatus& status, const std::vector<std::string>& part_names) {
  // The figures of the loop first: a narrow terminal cuts off what comes last.
  std::string text = fixed_text(status.passed_s, 1);
  if (status.duration_s > 0.0) text += "/" + fixed_text(status.duration_s, 1);
  text += " s  ";
  if (status.rate_hz) text += fixed_text(*status.rate_hz, 0) + " Hz, ";
  const double age_ms = std::chrono::duration<double, std::milli>(status.state.contact_set_age).count();
  text += std::to_string(status.late_ticks) + " late, contacts " + fixed_text(age_ms, 1) + " ms old";
  for (std::size_t h = 0; h < status.gloves.size(); ++h)
    text += "  " + hand_text(status.state, h, status.gloves[h], part_names);
  return text;
}

}  // namespace glissade::apps
