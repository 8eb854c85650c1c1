#include "adroit_recording.h"

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/hand_model.h>

#include "poses.h"

namespace glissade::test_support {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using grasping::kAdroitJoints;

constexpr std::array<std::string_view, 3> kArm{"ARRx", "ARRy", "ARRz"};
constexpr std::array<std::string_view, 3> kGraspSite{"palm_x_m", "palm_y_m", "palm_z_m"};

/// Each number of a row with the name of its column.
template <typename Row, typename Use>
void for_each_field(Row& row, const Use& use) {
  use(std::string_view("t_s"), row.t_s);
  for (int i = 0; i < 3; ++i)
    use(kArm[static_cast<std::size_t>(i)], row.arm[i]);
  for (std::size_t i = 0; i < kAdroitJoints; ++i)
    use(grasping::kAdroitJointNames[i], row.joints[i]);
  use(std::string_view("latch_rad"), row.latch);
  for (int i = 0; i < 3; ++i)
    use(kGraspSite[static_cast<std::size_t>(i)], row.p_WGrasp[i]);
}

constexpr double kPlay = 0.012;  // rad: so far the door stands open while its latch is not turned

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream text(line);
  for (std::string field; std::getline(text, field, ',');)
    fields.push_back(field);
  return fields;
}

Isometry3d turned(double angle, const Vector3d& axis) {
  return Isometry3d(AngleAxisd(angle, axis));
}

/// The pose of the forearm, up to its place; the task's angles.
Isometry3d forearm(const AdroitRow& row) {
  return turned(-1.57, Vector3d::UnitX()) * turned(3.14, Vector3d::UnitZ()) * turned(row.arm.x(), Vector3d::UnitX()) *
         turned(row.arm.y(), Vector3d::UnitY()) * turned(row.arm.z(), Vector3d::UnitZ());
}

}  // namespace

std::vector<AdroitRow> read_adroit_recording(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> columns = fields_of(line);
  std::vector<AdroitRow> rows;
  while (std::getline(file, line)) {
    const std::vector<std::string> fields = fields_of(line);
    AdroitRow row;
    for_each_field(row, [&](std::string_view name, double& value) {
      const auto at = static_cast<std::size_t>(std::ranges::find(columns, name) - columns.begin());
      if (at >= columns.size() || at >= fields.size()) throw std::runtime_error(path + ": no " + std::string(name));
      value = std::stod(fields[at]);
    });
    rows.push_back(row);
  }
  if (rows.empty()) throw std::runtime_error(path + ": no rows");
  return rows;
}

void write_adroit_recording(const std::string& path, const std::vector<AdroitRow>& rows) {
  std::ofstream file(path);
  std::string separator;
  for_each_field(rows.front(), [&](std::string_view name, double /*value*/) {
    file << separator << name;
    separator = ",";
  });
  for (const AdroitRow& row : rows) {
    separator = "\n";
    for_each_field(row, [&](std::string_view /*name*/, double value) {
      file << separator << std::fixed << std::setprecision(5) << value;
      separator = ",";
    });
  }
  file << "\n";
}

AdroitRow between(const AdroitRow& from, const AdroitRow& to, double t) {
  AdroitRow row;
  const auto mix = [t](auto a, auto b) { return (1.0 - t) * a + t * b; };
  row.t_s = mix(from.t_s, to.t_s);
  row.arm = mix(from.arm, to.arm);
  row.latch = mix(from.latch, to.latch);
  row.p_WGrasp = mix(from.p_WGrasp, to.p_WGrasp);
  for (std::size_t i = 0; i < kAdroitJoints; ++i)
    row.joints[i] = mix(from.joints[i], to.joints[i]);
  return row;
}

Isometry3d adroit_palm(const AdroitRow& row) {
  // The palm hangs on the wrist by both its joints, 34 mm apart; only their angles matter here.
  Isometry3d X_WPalm =
      forearm(row) * turned(row.joints[0], Vector3d::UnitY()) * turned(row.joints[1], Vector3d::UnitX());
  const Vector3d p_Palm_Grasp(0.007, -0.05, 0.07);
  X_WPalm.translation() = row.p_WGrasp - X_WPalm.linear() * p_Palm_Grasp;
  return X_WPalm;
}

grasping::HandPose human_hand_of(const grasping::HandModel& hand, const AdroitRow& row) {
  grasping::HandPose pose = grasping::from_adroit(hand, row.joints, forearm(row));
  const Vector3d p_Palm_Knuckle(0.011, 0.0, 0.099);
  const Vector3d knuckle_W = adroit_palm(row) * p_Palm_Knuckle;
  std::vector<Isometry3d> X_WL(hand.chain.links().size());
  hand.chain.poses(pose.X_WR, pose.values, X_WL);
  std::size_t middle = 0;
  while (hand.meaning[middle].finger != grasping::Finger::kMiddle)
    ++middle;
  pose.X_WR.pretranslate(knuckle_W - X_WL[middle].translation());
  return pose;
}

geometry::TriangleMesh adroit_handle() {
  constexpr double kPi = std::numbers::pi;
  const geometry::TriangleMesh lever = [] {
    std::vector<Eigen::Vector2d> profile;  // a capsule along z, from its lower end
    constexpr int kSteps = 8;
    for (int end = -1; end <= 1; end += 2) {
      for (int i = 0; i <= kSteps; ++i) {
        const double angle = 0.5 * kPi * (end < 0 ? i - kSteps : i) / kSteps;
        const bool is_end = i == (end < 0 ? 0 : kSteps);
        profile.emplace_back(is_end ? 0.0 : 0.02 * std::cos(angle), end * 0.1 + 0.02 * std::sin(angle));
      }
    }
    return geometry::make_revolution(profile, false, 32);
  }();
  const std::vector<Eigen::Vector2d> disc{{0.0, -0.15}, {0.05, -0.15}, {0.05, 0.15}, {0.0, 0.15}};
  const Isometry3d along_x = pose({0.1, -0.15, 0.0}, turn_from_to(Vector3d::UnitZ(), Vector3d::UnitX()));
  const Isometry3d along_y = pose({0.0, 0.0, 0.0}, turn_from_to(Vector3d::UnitZ(), Vector3d::UnitY()));
  return geometry::merge(std::vector{geometry::transformed(lever, along_x),
                                     geometry::transformed(geometry::make_revolution(disc, false, 48), along_y)});
}

Isometry3d handle_pose(const Vector3d& p_WDoor, double latch) {
  const Isometry3d X_DoorHinge = at(0.6);
  const Isometry3d X_HingeLatch = at(-0.46, 0.0, -0.025);
  return at(p_WDoor.x(), p_WDoor.y(), p_WDoor.z()) * X_DoorHinge * turned(kPlay, Vector3d::UnitZ()) * X_HingeLatch *
         turned(latch, Vector3d::UnitY());
}

}  // namespace glissade::test_support
