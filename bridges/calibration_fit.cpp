#include <algorithm>
#include <cmath>
#include <limits>

#include <glissade/bridges/calibration_fit.h>

#include "calibration/degrees.h"
#include "calibration/line_fit.h"

namespace glissade::bridges {
namespace {

using devices::GloveState;
using devices::JointCalibration;

constexpr std::size_t kFewestStates = 15;  // five for each third
/// A wearer can hold a finger stiller than this, and a finger on its way turns farther within a second.
constexpr double kStill_rad = radians(4.0);
/// Poses nearer to each other do not tell the gain of a sensor.
constexpr double kLeastTurn_rad = radians(10.0);
/// Errors in multiples of the tolerance of a pose: the wearer may have misunderstood it; nobody shows it so
/// differently.
constexpr double kRemarkable = 3.0;
constexpr double kGross = 4.5;

std::string name_of(std::size_t joint) {
  return std::string(hands::kJointNames[joint]);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

template <typename Number>
double median_of(std::span<const GloveState> states, const Number& number) {
  std::vector<double> values;
  for (const GloveState& state : states)
    values.push_back(number(state));
  return median(std::move(values));
}

/// Each number by itself, so that one wild state does not count.
Eigen::Isometry3d median_pose(std::span<const GloveState> states) {
  const Eigen::Matrix3d& R_first = states.front().X_WH.linear();
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  Eigen::Vector3d turn;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    X.translation()[axis] = median_of(states, [&](const GloveState& state) { return state.X_WH.translation()[axis]; });
    turn[axis] = median_of(states, [&](const GloveState& state) {
      const Eigen::AngleAxisd from_first(state.X_WH.linear() * R_first.transpose());
      return from_first.angle() * from_first.axis()[axis];
    });
  }
  const double angle = turn.norm();
  if (angle > 0.0) X.linear() = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  X.linear() = X.linear() * R_first;
  return X;
}

void check_still(std::span<const GloveState> states, std::size_t joint, double resolution) {
  const std::size_t third = states.size() / 3;
  const auto angle = [joint](const GloveState& state) { return state.joint_angles[joint]; };
  const double first = median_of(states.first(third), angle);
  const double second = median_of(states.subspan(third, third), angle);
  const double last = median_of(states.last(third), angle);
  const double moved = std::max({first, second, last}) - std::min({first, second, last});
  if (moved <= std::max(kStill_rad, 2.0 * resolution)) return;
  throw CalibrationError("the hand was not still: " + name_of(joint) + " turned by " + degrees_text(moved));
}

/// What the poses say of one joint.
struct JointData {
  std::vector<LinePoint> points;                           ///< reported angles and those of the poses
  std::vector<std::size_t> poses;                          ///< of each point
  double least = std::numeric_limits<double>::infinity();  ///< of all reported angles, in all poses
  double most = -std::numeric_limits<double>::infinity();
  double reported_least = std::numeric_limits<double>::infinity();  ///< of the medians
  double reported_most = -std::numeric_limits<double>::infinity();
};

JointData data_of(const std::array<HeldPose, kCalibrationPoses>& poses, std::size_t joint) {
  JointData data;
  for (std::size_t p = 0; p < kCalibrationPoses; ++p) {
    data.least = std::min(data.least, poses[p].least[joint]);
    data.most = std::max(data.most, poses[p].most[joint]);
    const double reported = poses[p].angles[joint];
    data.reported_least = std::min(data.reported_least, reported);
    data.reported_most = std::max(data.reported_most, reported);
    const CalibrationPose& pose = calibration_poses()[p];
    if (!pose.angles[joint]) continue;
    data.points.push_back({.x = reported, .y = *pose.angles[joint], .tolerance = pose.tolerance});
    data.poses.push_back(p);
  }
  return data;
}

double span_of(const std::vector<LinePoint>& points, double LinePoint::*coordinate) {
  const auto [least, most] = std::minmax_element(
      points.begin(), points.end(), [&](const auto& a, const auto& b) { return a.*coordinate < b.*coordinate; });
  return *most.*coordinate - *least.*coordinate;
}

double median_offset(const std::vector<LinePoint>& points) {
  std::vector<double> offsets;
  for (const LinePoint& point : points)
    offsets.push_back(point.y - point.x);
  return median(std::move(offsets));
}

/// Gain and offset. Adds remarks; throws CalibrationError.
Line line_of(const JointData& data, std::size_t joint, std::vector<std::string>& remarks) {
  const double wanted = span_of(data.points, &LinePoint::y);
  if (wanted < kLeastTurn_rad) return {.slope = 1.0, .offset = median_offset(data.points)};
  const double turned = span_of(data.points, &LinePoint::x);
  if (turned * devices::kGreatestGain < wanted)
    throw CalibrationError(name_of(joint) + " turned by only " + degrees_text(turned) +
                           " between the poses, of about " + degrees_text(wanted) +
                           ": is its sensor connected, and is it not stopped?");
  const std::optional<Line> line = robust_line(data.points, devices::kLeastGain, devices::kGreatestGain);
  if (!line)
    throw CalibrationError("the angles of " + name_of(joint) +
                           " do not follow the poses: is its sensor turned round, or was a pose left out?");
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const double error = std::abs(line->error(data.points[i]));
    const std::string what = "in the pose '" + std::string(calibration_poses()[data.poses[i]].name) + "', " +
                             name_of(joint) + " is " + degrees_text(error) + " from what the other poses tell";
    if (error > kGross * data.points[i].tolerance) throw CalibrationError(what);
    if (error > kRemarkable * data.points[i].tolerance) remarks.push_back(what + ", and does not count");
  }
  return *line;
}

/// Files need no more digits than any sensor has.
double to_six_decimals(double angle) {
  return std::round(1e6 * angle) / 1e6;
}

double residual_of(const std::vector<LinePoint>& points, const Line& line) {
  double sum = 0.0;
  for (const LinePoint& point : points)
    sum += line.error(point) * line.error(point);
  return std::sqrt(sum / static_cast<double>(points.size()));
}

}  // namespace

HeldPose held_pose(std::span<const GloveState> states, const devices::DeviceDescriptor& descriptor) {
  if (states.size() < kFewestStates)
    throw CalibrationError("only " + std::to_string(states.size()) + " states of the glove arrived during the pose");
  HeldPose pose;
  for (std::size_t j = 0; j < pose.angles.size(); ++j) {
    check_still(states, j, descriptor.joint_resolution);
    const auto by_angle = [j](const GloveState& a, const GloveState& b) {
      return a.joint_angles[j] < b.joint_angles[j];
    };
    const auto [least, most] = std::minmax_element(states.begin(), states.end(), by_angle);
    pose.angles[j] = median_of(states, [j](const GloveState& state) { return state.joint_angles[j]; });
    pose.least[j] = least->joint_angles[j];
    pose.most[j] = most->joint_angles[j];
  }
  pose.X_WT = median_pose(states);
  return pose;
}

JointFits fit_joints(const std::array<HeldPose, kCalibrationPoses>& poses, const std::vector<std::string>& without) {
  JointFits fits;
  std::string refusals;
  for (std::size_t j = 0; j < fits.joints.size(); ++j) {
    const JointData data = data_of(poses, j);
    const bool is_measured = data.least < data.most;
    if (!is_measured || std::find(without.begin(), without.end(), name_of(j)) != without.end()) continue;
    try {
      const Line line = line_of(data, j, fits.remarks);
      fits.joints[j] = JointCalibration{.gain = to_six_decimals(line.slope),
                                        .offset = to_six_decimals(line.offset),
                                        .reported_least = to_six_decimals(data.reported_least),
                                        .reported_most = to_six_decimals(data.reported_most),
                                        .residual = to_six_decimals(residual_of(data.points, line))};
    } catch (const CalibrationError& error) {
      refusals += (refusals.empty() ? "" : "; ") + std::string(error.what());
    }
  }
  if (!refusals.empty()) throw CalibrationError(refusals);
  const bool is_empty = std::none_of(fits.joints.begin(), fits.joints.end(), [](const auto& fit) { return !!fit; });
  if (is_empty) throw CalibrationError("no joint has moved between the poses: does the glove measure the fingers?");
  return fits;
}

}  // namespace glissade::bridges
