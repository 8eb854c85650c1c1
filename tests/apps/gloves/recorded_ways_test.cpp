#include "recorded_ways.h"

#include <array>
#include <numbers>

#include <gtest/gtest.h>

#include "poses.h"

namespace glissade::test_support {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

const Vector3d kCube(0.02, 0.02, 0.02);

Isometry3d at(double x, double y) {
  return pose({x, y, 0.0});
}

WayFigures figures_of(const std::vector<BoxOfScene>& walls, const std::vector<BoxOfScene>& parts,
                      const std::vector<Isometry3d>& to) {
  RecordedWays ways(walls, parts);
  std::vector<Isometry3d> from;
  for (const BoxOfScene& part : parts)
    from.push_back(part.X_WB);
  ways.take(from);
  ways.take(to);
  return ways.finish();
}

TEST(RecordedWays, AWayThroughAnotherCubeIsNotStraight) {
  const WayFigures figures = figures_of({{kCube, at(1.0, 0.0)}}, {{kCube, at(0.0, 0.0)}, {kCube, at(0.05, 0.0)}},
                                        {at(0.1, 0.0), at(0.05, 0.0)});
  EXPECT_EQ(figures.ways, 1);
  EXPECT_EQ(figures.detours + figures.blocked, 1);
}

// In a corridor with a bend, without room to the sides, the second cube can only wait until the first one is away.
TEST(RecordedWays, DetourIsFoundByMovingOneCubeAfterAnother) {
  constexpr double kWall = 0.04001;  // from a cube to the middle of a cube that is a wall
  const std::vector<BoxOfScene> walls{{kCube, at(kWall, 0.0)},    {kCube, at(kWall, kWall)},
                                      {kCube, at(0.0, -kWall)},   {kCube, at(-kWall, -kWall)},
                                      {kCube, at(-kWall, kWall)}, {kCube, at(-2.1 * kWall, 0.0)}};
  const WayFigures figures = figures_of(walls, {{kCube, at(0.0, 0.0)}, {kCube, at(-1.01 * kWall, 0.0)}},
                                        {at(0.0, 1.01 * kWall), at(0.0, 0.0)});
  EXPECT_EQ(figures.ways, 1);
  EXPECT_EQ(figures.detours, 1);
}

Isometry3d pose_of(const std::array<double, 12>& rows) {
  Isometry3d X = Isometry3d::Identity();
  X.matrix().topRows<3>() = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(rows.data());
  return X;
}

// Of a recording: the third cube turns at the second one, which lies at a wall.
TEST(RecordedWays, DetourIsFoundByTurningACube) {
  const std::array from{
      pose_of({0.81697223726235169, -0.57492670463557205, 0.044895966850369062, 0.05977495154224078,
               0.57664318072137888, 0.81360169114589487, -0.074397112121849934, 0.020161271835428117,
               0.006245451951528036, 0.086669328262204165, 0.99621755749861163, 0.050235477241847473}),
      pose_of({-1, 2.3686139333342708e-09, -6.5297448078389137e-09, 0.069996536021688815, 4.2397875370783258e-09,
               -0.5364854012964182, -0.84390960072499543, -0.022220575602009053, -5.5020088023484482e-09,
               -0.84390960072499543, 0.5364854012964182, 0.014962186592998509}),
      pose_of({0.091136567762968745, -0.70275102788624666, -0.70557431842521723, 0.022358584284312148,
               -0.99392776601751553, -0.020321827329430109, -0.10814166298621453, 0.0013146210601757624,
               0.061658105353772807, 0.71114556606845047, -0.70033582080696588, -0.016034676760697902}),
      pose_of({0.99999999069610523, -0.00012894886646740237, -4.4496957041834503e-05, -7.8195262549360273e-06,
               0.00012895268222476723, 0.9999999880081275, 8.5761009173573191e-05, 1.4514018311234975e-07,
               4.4485897723312637e-05, -8.5766746377623164e-05, 0.99999999533253503, -0.06500515061120575})};
  const std::array to{
      pose_of({0.81697223726235169, -0.57492670463557205, 0.044895966850369062, 0.05977495154224078,
               0.57664318072137888, 0.81360169114589487, -0.074397112121849934, 0.020161271835428117,
               0.006245451951528036, 0.086669328262204165, 0.99621755749861163, 0.050235477241847473}),
      pose_of({-1, 2.3686139333342708e-09, -6.5297448078389137e-09, 0.069996536021688815, 4.2397875370783258e-09,
               -0.5364854012964182, -0.84390960072499543, -0.022220575602009053, -5.5020088023484482e-09,
               -0.84390960072499543, 0.5364854012964182, 0.014962186592998509}),
      pose_of({0.089904761591348636, -0.70237609500376363, -0.70610548433677178, 0.022194380844114903,
               -0.99406849330324376, -0.019720887805558585, -0.10695287376213791, 0.0011533863732957239,
               0.061196114786985945, 0.71153278754490645, -0.69998294820913598, -0.015883866152548252}),
      pose_of({0.99999999068418532, -0.0001290453873198295, -4.4485023161303901e-05, -7.7968226094699769e-06,
               0.00012904920570803928, 0.99999998798862511, 8.5843183895059212e-05, 1.6874647963364781e-07,
               4.4473944960063106e-05, -8.584892385226488e-05, 0.99999999532601525, -0.065005128489444411})};
  const WayFigures figures =
      figures_of({{Vector3d(0.09, 0.09, 0.0), pose(0.09 * Vector3d::UnitX(), turn(std::numbers::pi, {1.0, 0.0, 1.0}))}},
                 {{kCube, from[0]}, {kCube, from[1]}, {kCube, from[2]}, {kCube, from[3]}}, {to.begin(), to.end()});
  EXPECT_EQ(figures.detours, 1);
}

}  // namespace
}  // namespace glissade::test_support
