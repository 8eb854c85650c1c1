// The point of a part at which the hand acts.

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include <glissade/contact/multi_part_sliding.h>
#include <glissade/contact/sliding.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/displacement.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/reference/grid_check.h>

#include "held_part.h"
#include "poses.h"
#include "sanitizers.h"
#include "scene/scene_access.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::at;

/// A rod of 0.2 m along z; its lower end is at z = -0.1 in its frame.
std::shared_ptr<const geometry::TriangleMesh> rod() {
  return std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.02, 0.02, 0.2}, 12));
}

/// The turn (radians) of a rod that stands beside a low wall, after the hand has pushed it 5 mm into the wall's top.
double turn_at_the_wall(const std::shared_ptr<const SlidingPart>& part_V) {
  // The wall's face is at x = 0.05, its top at the height of the rod's lower end.
  const Obstacle wall = test_support::obstacle_of(geometry::make_box({0.1, 0.4, 0.02}, 12), at(0.1, 0.0, -0.1));
  Sliding sliding({wall}, part_V, at(0.03), {.metaphor = Metaphor::kForceFeedback});
  test_support::lead(sliding, at(0.045), 100);
  EXPECT_GE(test_support::hold_until_rest(sliding), 0);
  EXPECT_GT(sliding.result().pushing, 0);
  return Eigen::AngleAxisd(sliding.result().X_WV.linear()).angle();
}

TEST(CompliancePoint, APushAtTheTipDoesNotTurnThePart) {
  EXPECT_LT(turn_at_the_wall(std::make_shared<SlidingPart>(rod(), Vector3d(0.0, 0.0, -0.1))), 1e-3);
  EXPECT_GT(turn_at_the_wall(std::make_shared<SlidingPart>(rod())), 1e-2) << "a push at the middle tips it";
}

TEST(CompliancePoint, GraspPointAppliesUntilRelease) {
  const Obstacle wall = test_support::obstacle_of(geometry::make_box({0.1, 0.4, 0.02}, 12), at(0.1, 0.0, -0.1));
  const auto part_V = std::make_shared<SlidingPart>(rod());
  MultiPartSliding sliding({wall}, {{part_V, at(0.03)}});
  const Vector3d tip(0.0, 0.0, -0.1);
  const auto turn_of_push = [&] {
    for (int i = 1; i <= 2000; ++i)
      sliding.advance(std::vector{at(0.03 + 0.015 * std::min(1.0, i / 100.0))});
    EXPECT_GT(sliding.result(0).pushing, 0);
    return Eigen::AngleAxisd(sliding.result(0).X_WV.linear()).angle();
  };
  sliding.release(0);
  sliding.grasp(0, at(0.03), tip);
  EXPECT_EQ(sliding.p_Vref(0), tip);
  EXPECT_GE(scene_of(sliding).lever(0), 0.2) << "the other end is so far from it: no proof may think it nearer";
  EXPECT_LT(turn_of_push(), 1e-3);
  sliding.release(0);
  EXPECT_EQ(sliding.p_Vref(0), part_V->p_Vref());
  sliding.grasp(0, at(0.03));
  EXPECT_GT(turn_of_push(), 1e-2) << "a push at the middle tips it";
}

/// The wrench of the coupling on the part about the world's origin.
Wrench coupling_of(const MultiPartSliding& sliding) {
  const Wrench about_reference = spring_wrench(sliding.stiffness(0), sliding.lag(0));
  return about_point(about_reference, sliding.result(0).X_WV * sliding.p_Vref(0), Vector3d::Zero());
}

TEST(CompliancePoint, GraspAtAnotherPointKeepsTheWrench) {
  const Obstacle wall = test_support::obstacle_of(geometry::make_box({0.1, 0.4, 0.02}, 12), at(0.1, 0.0, -0.1));
  MultiPartSliding sliding({wall}, {{std::make_shared<SlidingPart>(rod()), at(0.03)}});
  sliding.release(0);
  sliding.grasp(0, at(0.03));
  for (int i = 1; i <= 2000; ++i)
    sliding.advance(std::vector{at(0.03 + 0.015 * std::min(1.0, i / 100.0))});
  const Wrench before = coupling_of(sliding);
  const Isometry3d X_WV = sliding.result(0).X_WV;
  ASSERT_GT(before.f.norm(), 1.0);
  sliding.grasp(0, at(0.045), Vector3d(0.0, 0.0, 0.08));  // another hand joins
  const Wrench after = coupling_of(sliding);
  EXPECT_LT((after.f - before.f).norm(), 1e-9);
  EXPECT_LT((after.t - before.t).norm(), 1e-9);
  sliding.advance(std::vector{at(0.045)});
  EXPECT_LT((sliding.result(0).X_WV.translation() - X_WV.translation()).norm(), 0.2e-3) << "contacts hold it there";
}

// A point far from the part makes small rotations large motions: the proof of the way has to know that.
TEST(CompliancePoint, DistantGraspPointCausesNoCollision) {
  const auto mesh = rod();
  const auto wall = std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.1, 0.4, 0.4}, 12));
  const reference::GridCheck check({{wall, at(0.07)}});
  MultiPartSliding sliding({{std::make_shared<ContactBody>(wall), at(0.07)}}, {{std::make_shared<SlidingPart>(mesh)}},
                           {.max_cycles = 1});  // so a call goes along one way
  constexpr std::uint64_t kSeed = 11;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] { return Vector3d(uniform(random), uniform(random), uniform(random)); };
  bool touches = false;
  for (int hold = 0; hold < 100; ++hold) {
    sliding.release(0);
    sliding.grasp(0, sliding.result(0).X_WV, 0.5 * vector());
    const Isometry3d X_WG_end = at(0.05 + 0.03 * uniform(random)) * geometry::rotation_by(vector());
    const geometry::Displacement way =
        geometry::displacement_between(sliding.result(0).X_WG, X_WG_end, Vector3d::Zero());
    const Isometry3d X_WG_start = sliding.result(0).X_WG;
    for (int i = 1; i <= 200; ++i) {
      const Isometry3d X_WV = sliding.result(0).X_WV;
      sliding.advance(std::vector{geometry::displaced(X_WG_start, Vector3d::Zero(), way.scaled(i / 200.0))});
      touches = touches || sliding.result(0).pushing > 0;
      ASSERT_FALSE(check.collides(*mesh, sliding.result(0).X_WV)) << "seed " << kSeed << ", hold " << hold << ", " << i;
      const geometry::Displacement step =
          geometry::displacement_between(X_WV, sliding.result(0).X_WV, sliding.p_Vref(0));
      ASSERT_FALSE(check.collides(*mesh, geometry::displaced(X_WV, sliding.p_Vref(0), step.scaled(0.5))));
    }
  }
  EXPECT_TRUE(touches) << sliding.result(0).X_WV.matrix() << '\n' << sliding.result(0).X_WG.matrix();
}

TEST(CompliancePoint, TheRadiusIsTheDistanceOfTheFarthestVertex) {
  const SlidingPart part(rod(), {0.0, 0.0, -0.1});
  EXPECT_NEAR(part.radius(), Vector3d(0.01, 0.01, 0.2).norm(), 1e-15);
  EXPECT_EQ(part.p_Vref(), Vector3d(0.0, 0.0, -0.1));
  EXPECT_EQ(SlidingPart(rod()).p_Vref(), Vector3d(0.0, 0.0, 0.0));
}

TEST(CompliancePoint, MustLieNearThePart) {
  EXPECT_THROW(SlidingPart(rod(), {0.0, 0.0, 1.1}), std::invalid_argument);
  EXPECT_THROW(SlidingPart(rod(), {0.0, std::numeric_limits<double>::quiet_NaN(), 0.0}), std::invalid_argument);
}

/// A square peg of 8 × 8 × 50 mm without a chamfer and a plate with a hole for it, 79 µm wider.
class SquarePeg : public ::testing::Test {
 protected:
  static constexpr int kTrials = test_support::kSanitized ? 10 : 100;
  static constexpr double kPeg = 8e-3;
  static constexpr double kLength = 50e-3;
  static constexpr double kHole = kPeg + 79e-6;

  static geometry::TriangleMesh plate() {
    constexpr double kSize = 40e-3;
    constexpr double kBeside = 0.5 * (kSize - kHole);
    constexpr double kDepth = 9e-3;
    geometry::TriangleMesh mesh;
    for (const double side : {-1.0, 1.0}) {
      const double middle = side * 0.5 * (kHole + kBeside);
      append(mesh, geometry::make_box({kBeside, kSize, kDepth}, 12), Vector3d(middle, 0.0, -0.5 * kDepth));
      append(mesh, geometry::make_box({kHole, kBeside, kDepth}, 12), Vector3d(0.0, middle, -0.5 * kDepth));
    }
    return mesh;
  }

  /// How many of `trials` pegs get in. A hand presses the peg by 8 mm on the plate, up to 2 mm beside the hole, drags
  /// it over the hole to the other side, and back to the hole.
  static int got_in(int trials, const std::optional<Vector3d>& compliance_point, bool spiral_search) {
    const auto mesh = std::make_shared<geometry::TriangleMesh>(geometry::make_box({kPeg, kPeg, kLength}, 12));
    const auto peg =
        compliance_point ? std::make_shared<SlidingPart>(mesh, *compliance_point) : std::make_shared<SlidingPart>(mesh);
    const Obstacle holed = test_support::obstacle_of(plate());
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    int count = 0;
    for (int trial = 0; trial < trials; ++trial) {
      const Vector3d offset(2e-3 * uniform(random), 2e-3 * uniform(random), 0.0);
      const auto tip_at = [&](double share, double z) {
        return at(share * offset.x(), share * offset.y(), z + 0.5 * kLength);
      };
      Sliding sliding({holed}, peg, tip_at(1.0, 1e-3), {.rules = {.spiral_search = spiral_search}});
      test_support::lead(sliding, tip_at(1.0, -8e-3), 200);
      test_support::lead(sliding, tip_at(-1.0, -8e-3), 1000);
      test_support::lead(sliding, tip_at(0.0, -8e-3), 500);
      for (int i = 0; i < 2500 && spiral_search; ++i)  // the hand rests, and the search begins
        sliding.advance(tip_at(0.0, -8e-3));
      count += sliding.result().X_WV.translation().z() - 0.5 * kLength < -7e-3 ? 1 : 0;
    }
    return count;
  }

 private:
  static void append(geometry::TriangleMesh& mesh, const geometry::TriangleMesh& more, const Vector3d& p) {
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    for (const Vector3d& vertex : more.vertices)
      mesh.vertices.push_back(vertex + p);
    for (const auto& triangle : more.triangles)
      mesh.triangles.push_back({triangle[0] + first, triangle[1] + first, triangle[2] + first});
  }
};

TEST_F(SquarePeg, DropsInByItselfIfTheHandActsAtItsTip) {
  EXPECT_EQ(got_in(kTrials, Vector3d(0.0, 0.0, -0.5 * kLength), false), kTrials);
}

TEST_F(SquarePeg, TipsAndSometimesJamsIfTheHandActsAtItsMiddle) {
  if (test_support::kSanitized) GTEST_SKIP() << "too few of the first pegs jam";
  EXPECT_LT(got_in(kTrials, std::nullopt, false), kTrials);
}

// A hundred searches, which take half a minute: GLISSADE_PEGS=100.
TEST_F(SquarePeg, SpiralSearchInsertsMostPegsIfTheHandActsAtTheMiddle) {
  const char* const wish = std::getenv("GLISSADE_PEGS");
  const int trials = wish != nullptr ? std::max(1, std::atoi(wish)) : 10;
  EXPECT_GE(10 * got_in(trials, std::nullopt, true), 9 * trials);
}

}  // namespace
}  // namespace glissade::contact
