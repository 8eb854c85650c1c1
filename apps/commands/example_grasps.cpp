#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>

#include <Eigen/Geometry>

#include <glissade/apps/commands/example_grasps.h>
#include <glissade/apps/text.h>
#include <glissade/devices/glove_device.h>
#include <glissade/files/csv_columns.h>
#include <glissade/shapes/shape_catalog.h>

namespace glissade::apps {

namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using hands::JointValues;

constexpr double kDegree = std::numbers::pi / 180.0;

/// A thing, how it stands, and where a hand grips it.
struct Thing {
  const char* shape;               ///< in the catalogue, also its name
  std::array<double, 2> turn_deg;  ///< about x, then about z
  bool is_from_above;              ///< the palm comes down; otherwise it comes in the direction of y, with the thumb up
  double grip_mm;                  ///< along the z axis of the shape
  double radius_mm;                ///< half of what the fingers go round
  double depth_mm;                 ///< half its size before the palm
};

constexpr std::array<Thing, 10> kThings{{{"ball", {0, 0}, true, 0, 33, 33},
                                         {"bottle", {0, 0}, false, 80, 35, 35},
                                         {"carton", {90, 0}, false, 0, 31, 20},
                                         {"egg", {0, 0}, true, 0, 21, 28},
                                         {"hammer", {180, 0}, false, 30, 14, 9},
                                         {"jar_lid", {0, 0}, true, 6, 30, 6},
                                         {"mug", {0, 150}, false, 48, 41, 41},
                                         {"pen", {0, 0}, false, 80, 4.5, 4.5},
                                         {"screwdriver", {0, 0}, false, 50, 15, 15},
                                         {"wine_glass", {0, 0}, false, 135, 37, 37}}};

/// The angles of thumb (roll, MCP, IP, abduction) and of each finger (MCP, PIP, DIP) in degrees; all others are zero.
JointValues bent(const std::array<double, 4>& thumb, const std::array<double, 3>& finger) {
  JointValues angles{};
  const auto set = [&](std::string_view joint, double degrees) {
    const auto place = std::find(hands::kJointNames.begin(), hands::kJointNames.end(), joint);
    angles[static_cast<std::size_t>(place - hands::kJointNames.begin())] = degrees * kDegree;
  };
  constexpr std::array<std::string_view, 4> kThumb{"thumb_roll", "thumb_mcp", "thumb_ip", "thumb_index_abduction"};
  for (std::size_t i = 0; i < kThumb.size(); ++i)
    set(kThumb[i], thumb[i]);
  for (const char* name : {"index", "middle", "ring", "little"}) {
    set(std::string(name) + "_mcp", finger[0]);
    set(std::string(name) + "_pip", finger[1]);
    set(std::string(name) + "_dip", finger[2]);
  }
  return angles;
}

JointValues open_hand() {
  return bent({60, -10, -15, 60}, {-15, 0, -5});
}

/// Round something of this radius, some millimetres within it: a fist at 10 mm, a wide grip from 35 mm on.
JointValues closed_hand(double radius_mm) {
  const double width = std::clamp((radius_mm - 10.0) / 25.0, 0.0, 1.0);
  const auto between = [&](double fist, double wide) { return std::lerp(fist, wide, width); };
  return bent({60, between(50, 32), between(40, 30), 20}, {between(75, 50), between(105, 67), between(65, 48)});
}

/// Where the thing stands on the table, which has its top at z = 0 and its middle at the grip.
Isometry3d pose_of(const Thing& thing) {
  constexpr double kGap_m = 0.2e-3;
  Isometry3d X_WB = Isometry3d::Identity();
  X_WB.linear() = (Eigen::AngleAxisd(thing.turn_deg[1] * kDegree, Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(thing.turn_deg[0] * kDegree, Vector3d::UnitX()))
                      .toRotationMatrix();
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector3d& p_B : shapes::make_shape(thing.shape, {}).vertices)
    lowest = std::min(lowest, (X_WB * p_B).z());
  X_WB.translation().z() = kGap_m - lowest;
  return X_WB;
}

/// Numbers with five digits after the point and a comma before each.
template <typename Numbers>
std::string row_of(const Numbers& numbers) {
  std::string row;
  for (const double number : numbers)
    row += "," + format_number(std::round(1e5 * number) / 1e5);
  return row;
}

std::array<double, 4> wxyz(const Isometry3d& X) {
  const Eigen::Quaterniond q(X.linear());
  return {q.w(), q.x(), q.y(), q.z()};
}

std::string row_of(double t_s, const Isometry3d& X_WR, const JointValues& angles) {
  return format_number(t_s) + row_of(X_WR.translation()) + row_of(wxyz(X_WR)) + row_of(angles) + "\n";
}

std::string trajectory_of(const Thing& thing, const Isometry3d& X_WB) {
  constexpr double kBeforePalm_mm = 15.0;  // of the root's axis, to which the palm leaves a few millimetres
  Matrix3d from_side;
  from_side << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  Isometry3d X_WR = Isometry3d::Identity();
  if (!thing.is_from_above) X_WR.linear() = from_side;
  const Vector3d p_R = 1e-3 * Vector3d(60.0 + 1.05 * thing.radius_mm, 0.0, -(thing.depth_mm + kBeforePalm_mm));
  X_WR.translation() = X_WB * Vector3d(0.0, 0.0, 1e-3 * thing.grip_mm) - X_WR.linear() * p_R;
  Isometry3d X_WR_before = X_WR;
  X_WR_before.translation() += 0.15 * X_WR.linear().col(2);
  Isometry3d X_WR_lifted = X_WR;
  X_WR_lifted.translation().z() += 0.1;
  const JointValues closed = closed_hand(thing.radius_mm);
  return header_of(hand_trajectory_columns()) + "\n" + row_of(0.0, X_WR_before, open_hand()) +
         row_of(0.5, X_WR, open_hand()) + row_of(0.9, X_WR, closed) + row_of(1.0, X_WR, closed) +
         row_of(1.5, X_WR_lifted, closed) + row_of(1.8, X_WR_lifted, closed);
}

std::string scene_with(const Thing& thing, const Isometry3d& X_WB) {
  const std::string name = thing.shape;
  const std::string position = row_of(X_WB.translation()).substr(1);
  const std::string orientation = row_of(wxyz(X_WB)).substr(1);
  return "# A hand grasps a thing and lifts it.\n#\n#   glissade grasp grasp_" + name +
         ".yaml --hand-trajectory grasp_" + name +
         "_hand.csv --out hand.csv\n"
         "objects:\n"
         "  - name: table\n"
         "    shape: {type: box, size_x_m: 0.4, size_y_m: 0.4, size_z_m: 0.02, triangles: 12}\n"
         "    pose: {position_m: [0, 0, -0.01]}\n"
         "  - name: " +
         name + "\n    movable: true\n    shape: {type: " + name + "}\n    pose: {position_m: [" + position +
         "], orientation_wxyz: [" + orientation + "]}\n";
}

}  // namespace

std::vector<TextFile> example_grasps() {
  std::vector<TextFile> files;
  for (const Thing& thing : kThings) {
    const Isometry3d X_WB = pose_of(thing);
    const std::string name = "grasp_" + std::string(thing.shape);
    files.push_back({name + ".yaml", scene_with(thing, X_WB)});
    files.push_back({name + "_hand.csv", trajectory_of(thing, X_WB)});
  }
  return files;
}

}  // namespace glissade::apps
