#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <yaml-cpp/yaml.h>

#include <glissade/devices/calibration.h>
#include <glissade/files/text.h>
#include <glissade/files/text_file.h>
#include <glissade/files/yaml_reader.h>

namespace glissade::devices {
namespace {

using files::YamlReader;

constexpr std::size_t kLargestFile = 1 << 20;
constexpr double kLargestAngle_rad = 10.0;  // beyond every joint, in units of any sensor with an allowed gain
constexpr double kLargestOffset_m = 1.0;    // a tracker is worn on the hand or the forearm

class CalibrationFile {
 public:
  CalibrationFile(const std::string& text, const std::string& source) : reader_(source), root_(reader_.parse(text)) {}

  Calibration read() {
    check_keys(root_, "the file", {"user", "device", "side", "joints", "tracker"});
    calibration_.user = reader_.text(reader_.required(root_, "the file", "user"), "user");
    calibration_.device = reader_.text(reader_.required(root_, "the file", "device"), "device");
    calibration_.side = side_of(reader_.required(root_, "the file", "side"));
    if (const YAML::Node joints = root_["joints"]) read_joints(joints);
    if (const YAML::Node tracker = root_["tracker"]) read_tracker(tracker);
    return calibration_;
  }

 private:
  void check_keys(const YAML::Node& map, const std::string& what, const std::vector<std::string_view>& known) const {
    reader_.check_keys(map, what, known);
  }

  hands::HandSide side_of(const YAML::Node& node) const {
    const std::string side = reader_.text(node, "side");
    if (side == "left") return hands::HandSide::kLeft;
    if (side == "right") return hands::HandSide::kRight;
    reader_.fail(node, "side: must be left or right, not " + files::in_quotes(side));
  }

  void read_joints(const YAML::Node& joints) {
    check_keys(joints, "joints", {hands::kJointNames.begin(), hands::kJointNames.end()});
    for (std::size_t j = 0; j < hands::kJointNames.size(); ++j) {
      const std::string name(hands::kJointNames[j]);
      if (const YAML::Node joint = joints[name]) calibration_.joints[j] = joint_of(joint, name);
    }
  }

  JointCalibration joint_of(const YAML::Node& node, const std::string& name) const {
    check_keys(node, name, {"gain", "offset_rad", "reported_least_rad", "reported_most_rad", "residual_rad"});
    const auto number = [&](const std::string& key, double least, double most) {
      return number_in(reader_.required(node, name, key), key, least, most);
    };
    JointCalibration joint{.gain = number("gain", kLeastGain, kGreatestGain),
                           .offset = number("offset_rad", -kLargestAngle_rad, kLargestAngle_rad),
                           .reported_least = number("reported_least_rad", -kLargestAngle_rad, kLargestAngle_rad),
                           .reported_most = number("reported_most_rad", -kLargestAngle_rad, kLargestAngle_rad),
                           .residual = number("residual_rad", 0.0, kLargestAngle_rad)};
    if (joint.reported_most < joint.reported_least)
      reader_.fail(node, name + ": reported_most_rad must not be less than reported_least_rad");
    return joint;
  }

  double number_in(const YAML::Node& node, const std::string& key, double least, double most) const {
    const double value = reader_.number(node, key);
    if (value < least || value > most)
      reader_.fail(node, key + ": must be from " + files::format_number(least) + " to " + files::format_number(most) +
                             ", not " + files::format_number(value));
    return value;
  }

  void read_tracker(const YAML::Node& tracker) {
    check_keys(tracker, "tracker", {"position_m", "orientation_wxyz"});
    const YAML::Node position_node = reader_.required(tracker, "tracker", "position_m");
    const Eigen::Vector3d position = reader_.numbers(position_node, "position_m", 3);
    if (!(position.norm() <= kLargestOffset_m))
      reader_.fail(position_node, "position_m: must be at most " + files::format_number(kLargestOffset_m) + " m long");
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
    if (const YAML::Node node = tracker["orientation_wxyz"]) {
      const Eigen::VectorXd wxyz = reader_.numbers(node, "orientation_wxyz", 4);
      if (!(std::abs(wxyz.norm() - 1.0) < 1e-3)) reader_.fail(node, "orientation_wxyz: must have a norm of 1");
      orientation = Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized();
    }
    calibration_.X_TH = Eigen::Translation3d(position) * orientation;
  }

  YamlReader reader_;
  YAML::Node root_;
  Calibration calibration_;
};

void add_number(YAML::Emitter& out, const char* key, double number) {
  out << YAML::Key << key << YAML::Value << files::exact_number(number + 0.0);  // 0 without a sign
}

void add_tracker(YAML::Emitter& out, const Eigen::Isometry3d& X_TH) {
  const Eigen::Quaterniond q(X_TH.linear());
  out << YAML::Key << "tracker" << YAML::Value << YAML::BeginMap;
  out << YAML::Key << "position_m" << YAML::Value << YAML::Flow << YAML::BeginSeq;
  for (const double coordinate : X_TH.translation())
    out << files::exact_number(coordinate);
  out << YAML::EndSeq << YAML::Key << "orientation_wxyz" << YAML::Value << YAML::Flow << YAML::BeginSeq;
  for (const double part : {q.w(), q.x(), q.y(), q.z()})
    out << files::exact_number(part);
  out << YAML::EndSeq << YAML::EndMap;
}

}  // namespace

Calibration parse_calibration(const std::string& text, const std::string& source) {
  return CalibrationFile(text, source).read();
}

Calibration read_calibration(const std::string& path) {
  return parse_calibration(files::read_text_file(path, kLargestFile), path);
}

std::string text_of(const Calibration& calibration) {
  YAML::Emitter out;
  out << YAML::BeginMap;
  out << YAML::Key << "user" << YAML::Value << YAML::DoubleQuoted << calibration.user;
  out << YAML::Key << "device" << YAML::Value << YAML::DoubleQuoted << calibration.device;
  out << YAML::Key << "side" << YAML::Value << (calibration.side == hands::HandSide::kLeft ? "left" : "right");
  out << YAML::Key << "joints" << YAML::Value << YAML::BeginMap;
  for (std::size_t j = 0; j < calibration.joints.size(); ++j) {
    if (!calibration.joints[j]) continue;
    const JointCalibration& joint = *calibration.joints[j];
    out << YAML::Key << std::string(hands::kJointNames[j]) << YAML::Value << YAML::Flow << YAML::BeginMap;
    add_number(out, "gain", joint.gain);
    add_number(out, "offset_rad", joint.offset);
    add_number(out, "reported_least_rad", joint.reported_least);
    add_number(out, "reported_most_rad", joint.reported_most);
    add_number(out, "residual_rad", joint.residual);
    out << YAML::EndMap;
  }
  out << YAML::EndMap;
  if (!calibration.X_TH.matrix().isIdentity(0.0)) add_tracker(out, calibration.X_TH);
  out << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

}  // namespace glissade::devices
