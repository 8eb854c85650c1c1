// Files of calibrations. Whatever they hold, they give a calibration that is written and read back as the same, or a
// sentence says why not.

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include <glissade/devices/calibration.h>

#include "fuzz_target.h"

namespace glissade::fuzz {
namespace {

/// YAML replaces bytes that are not UTF-8.
bool is_plain(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c < '\x7f'; });
}

}  // namespace

bool try_input(std::string_view bytes) {
  devices::Calibration calibration;
  try {
    calibration = devices::parse_calibration(std::string(bytes), "input");
  } catch (const std::invalid_argument&) {
    return false;
  }
  const std::string text = devices::text_of(calibration);
  const devices::Calibration read = devices::parse_calibration(text, "copy");
  const bool is_same_user = read.user == calibration.user || !is_plain(calibration.user);
  const bool is_same_device = read.device == calibration.device || !is_plain(calibration.device);
  if (!is_same_user || !is_same_device || read.side != calibration.side)
    throw std::logic_error("the wearer came back as another");
  if (read.joints != calibration.joints) throw std::logic_error("a joint came back as another");
  if (!read.X_TH.isApprox(calibration.X_TH, 1e-12)) throw std::logic_error("the tracker came back elsewhere");
  return true;
}

std::vector<Seed> seeds() {
  devices::Calibration calibration{.user = "anna", .device = "glove", .side = hands::HandSide::kLeft};
  for (auto& joint : calibration.joints)
    joint = devices::JointCalibration{.gain = 1.25, .offset = -0.5, .reported_most = 1.0, .residual = 0.125};
  calibration.X_TH = Eigen::Translation3d(0.1, 0.0, -0.2) * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX());
  return {{"all_keys", devices::text_of(calibration)},
          {"by_hand", "user: anna\ndevice: a glove\nside: right\ntracker: {position_m: [0, 0, 0.1]}\n"}};
}

std::vector<std::string> dictionary() {
  return {"user: ",
          "device: ",
          "side: left",
          "joints: {",
          "thumb_roll: {",
          "gain: ",
          "offset_rad: ",
          "tracker: {",
          "position_m: [0, 0, 0]",
          "orientation_wxyz: [0, 1, 0, 0]",
          "nan",
          "1e999",
          "\"",
          "\\",
          "&a ",
          "*a",
          "!!binary ",
          "---\n",
          "{}",
          "-0"};
}

// Nothing in a calibration depends on the rest of it.
void repair(std::string&) {}

}  // namespace glissade::fuzz
