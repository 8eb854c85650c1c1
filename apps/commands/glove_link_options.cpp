#include <charconv>
#include <stdexcept>
#include <string_view>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/glove_link_options.h>
#include <glissade/apps/text.h>
#include <glissade/files/file_checks.h>

namespace glissade::apps {

namespace {

/// The number in "lcm:NUMBER".
std::int64_t number_of(const std::string& pose_from, std::int64_t device) {
  constexpr std::string_view kKind = "lcm";
  const std::string_view text = pose_from;
  if (text == kKind) return device;
  std::int64_t number = 0;
  const bool has_number = text.starts_with("lcm:");
  const std::string_view digits = has_number ? text.substr(kKind.size() + 1) : std::string_view();
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size() || number < 1)
    throw std::invalid_argument("--pose-from: must be lcm or lcm:NUMBER, not " + in_quotes(pose_from));
  return number;
}

}  // namespace

void add_calibration_option(CLI::App& command, GloveLinkOptions& options) {
  command.add_option(
      "--calibration", options.calibration,
      "File of 'glissade calibrate' for this wearer, glove and side; applied to all states that are sent");
}

void add_pose_options(CLI::App& command, GloveLinkOptions& options) {
  CLI::Option* from =
      command.add_option("--pose-from", options.pose_from,
                         "Source of the hand's pose: 'lcm' for a tracker that sends HAND_POSE with the number of the "
                         "glove, lcm:NUMBER for a tracker with another number");
  command.add_option("--pose-rate-hz", options.pose_rate_Hz, "Poses per second that the tracker sends at least")
      ->capture_default_str()
      ->needs(from);
}

devices::LcmGloveHostOptions link_options(const GloveLinkOptions& options, std::int64_t device, hands::HandSide side) {
  devices::LcmGloveHostOptions link{.device = device, .side = side};
  if (!options.calibration.empty()) {
    check_input(options.calibration);
    link.calibration = devices::read_calibration(options.calibration);
  }
  if (options.pose_from.empty()) return link;
  if (!(options.pose_rate_Hz >= 20.0 && options.pose_rate_Hz <= 1e5))
    throw std::invalid_argument("--pose-rate-hz: must lie between 20 and 100000");
  link.hand_pose =
      devices::HandPoseOptions{.device = number_of(options.pose_from, device), .rate_Hz = options.pose_rate_Hz};
  return link;
}

}  // namespace glissade::apps
