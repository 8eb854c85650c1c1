#include "recorded_ways.h"

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
TEST(RecordedWays, CubesMayGoOneAfterAnother) {
  constexpr double kWall = 0.04001;  // from a cube to the middle of a cube that is a wall
  const std::vector<BoxOfScene> walls{{kCube, at(kWall, 0.0)},    {kCube, at(kWall, kWall)},
                                      {kCube, at(0.0, -kWall)},   {kCube, at(-kWall, -kWall)},
                                      {kCube, at(-kWall, kWall)}, {kCube, at(-2.1 * kWall, 0.0)}};
  const WayFigures figures = figures_of(walls, {{kCube, at(0.0, 0.0)}, {kCube, at(-1.01 * kWall, 0.0)}},
                                        {at(0.0, 1.01 * kWall), at(0.0, 0.0)});
  EXPECT_EQ(figures.ways, 1);
  EXPECT_EQ(figures.detours, 1);
}

}  // namespace
}  // namespace glissade::test_support
