#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include <glissade/bridges/dynamixel_hand.h>
#include <glissade/files/did_you_mean.h>
#include <glissade/files/text.h>
#include <glissade/files/text_file.h>
#include <glissade/files/yaml_reader.h>

#include "dynamixel/presets.h"

namespace glissade::bridges {
namespace {

using files::YamlReader;

std::chrono::nanoseconds from_seconds(double seconds) {
  constexpr double kLongest_s = 1000.0;  // a count of nanoseconds; validate knows the range
  return std::chrono::nanoseconds(std::llround(std::clamp(seconds, -kLongest_s, kLongest_s) * 1e9));
}

/// Reads one file. Every error names the line of the entry that is wrong.
class HandFile {
 public:
  HandFile(const std::string& text, const std::string& source) : reader_(source), root_(reader_.parse(text)) {}

  DynamixelHand read() {
    constexpr std::string_view kKeys[] = {"name",
                                          "model",
                                          "baud_rate",
                                          "servos",
                                          "measured",
                                          "board_port",
                                          "period_s",
                                          "patience_s",
                                          "watchdog_s",
                                          "max_stiffness_Nm_per_rad",
                                          "position_d_gain",
                                          "has_fast_read",
                                          "current_per_gain_A"};
    reader_.check_keys(root_, "the file", kKeys);
    hand_.name = reader_.text(reader_.required(root_, "the file", "name"), "name");
    hand_.model = reader_.text(reader_.required(root_, "the file", "model"), "model");
    read_numbers();
    if (const YAML::Node port = root_["board_port"]) hand_.board_port = reader_.text(port, "board_port");
    if (const YAML::Node fast = root_["has_fast_read"]) hand_.has_fast_read = reader_.boolean(fast, "has_fast_read");
    for (const YAML::Node& entry : list("servos"))
      read_servo(entry);
    if (root_["measured"]) {
      for (const YAML::Node& entry : list("measured"))
        read_measured(entry);
    }
    check(root_, hand_);
    return hand_;
  }

 private:
  YAML::Node list(const std::string& key) const {
    const YAML::Node entries = reader_.required(root_, "the file", key);
    if (!entries.IsSequence()) reader_.fail(entries, key + ": must be a list");
    return entries;
  }

  void read_numbers() {
    const auto time = [this](const std::string& key, std::chrono::nanoseconds& value) {
      if (const YAML::Node node = root_[key]) value = from_seconds(reader_.number(node, key));
    };
    number(root_, "baud_rate", hand_.baud_rate);
    time("period_s", hand_.period);
    time("patience_s", hand_.patience);
    time("watchdog_s", hand_.watchdog);
    number(root_, "max_stiffness_Nm_per_rad", hand_.max_stiffness);
    number(root_, "current_per_gain_A", hand_.current_per_gain);
    if (root_["position_d_gain"]) hand_.position_d_gain = whole(root_, "the file", "position_d_gain");
  }

  void read_servo(const YAML::Node& entry) {
    constexpr std::string_view kKeys[] = {"id",       "joint",         "ratio",
                                          "zero_rad", "max_current_A", "torque_per_current_Nm_per_A"};
    reader_.check_keys(entry, "a servo", kKeys);
    DynamixelServo servo{.id = whole(entry, "a servo", "id"), .joint = joint(entry, "a servo")};
    number(entry, "ratio", servo.ratio);
    number(entry, "zero_rad", servo.zero);
    number(entry, "max_current_A", servo.max_current);
    number(entry, "torque_per_current_Nm_per_A", servo.torque_per_current);
    hand_.servos.push_back(servo);
    DynamixelHand alone = hand_;
    alone.servos = {servo};
    check(entry, alone);
  }

  void read_measured(const YAML::Node& entry) {
    constexpr std::string_view kKeys[] = {"channel", "joint", "ratio", "zero_rad"};
    reader_.check_keys(entry, "a measured joint", kKeys);
    MeasuredJoint measured{.channel = whole(entry, "a measured joint", "channel"),
                           .joint = joint(entry, "a measured joint")};
    number(entry, "ratio", measured.ratio);
    number(entry, "zero_rad", measured.zero);
    hand_.measured.push_back(measured);
    check(entry, hand_);
  }

  void check(const YAML::Node& node, const DynamixelHand& hand) const {
    try {
      validate(hand);
    } catch (const std::invalid_argument& error) {
      reader_.fail(node, error.what());
    }
  }

  void number(const YAML::Node& map, const std::string& key, double& value) const {
    if (const YAML::Node node = map[key]) value = reader_.number(node, key);
  }

  int whole(const YAML::Node& map, const std::string& what, const std::string& key) const {
    const YAML::Node node = reader_.required(map, what, key);
    const double value = reader_.number(node, key);
    constexpr double kLargest = 1e6;
    if (value != std::floor(value) || std::abs(value) > kLargest) reader_.fail(node, key + ": must be a whole number");
    return static_cast<int>(value);
  }

  int joint(const YAML::Node& map, const std::string& what) const {
    const YAML::Node node = reader_.required(map, what, "joint");
    const std::string name = reader_.text(node, "joint");
    const auto* const found = std::find(hands::kJointNames.begin(), hands::kJointNames.end(), name);
    if (found == hands::kJointNames.end()) {
      const std::vector<std::string> known(hands::kJointNames.begin(), hands::kJointNames.end());
      reader_.fail(node, "joint: " + files::in_quotes(name) + " is no joint" + files::did_you_mean(name, known));
    }
    return static_cast<int>(found - hands::kJointNames.begin());
  }

  YamlReader reader_;
  YAML::Node root_;
  DynamixelHand hand_;
};

}  // namespace

DynamixelHand parse_dynamixel_hand(const std::string& text, const std::string& source) {
  return HandFile(text, source).read();
}

DynamixelHand read_dynamixel_hand(const std::string& preset_or_path) {
  for (const dynamixel::PresetHand& preset : dynamixel::preset_hands()) {
    if (preset.name == preset_or_path)
      return parse_dynamixel_hand(std::string(preset.text), std::string(preset.name) + ".yaml");
  }
  if (!std::filesystem::exists(preset_or_path)) {
    const std::vector<std::string> known = dynamixel_presets();
    throw std::invalid_argument(files::in_quotes(preset_or_path) + " is neither a file nor a preset" +
                                files::did_you_mean(preset_or_path, known) + " (presets: " + files::joined(known) +
                                ")");
  }
  return parse_dynamixel_hand(files::read_text_file(preset_or_path), preset_or_path);
}

std::vector<std::string> dynamixel_presets() {
  std::vector<std::string> names;
  for (const dynamixel::PresetHand& preset : dynamixel::preset_hands())
    names.emplace_back(preset.name);
  return names;
}

}  // namespace glissade::bridges
