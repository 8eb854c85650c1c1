// Several parts at once: two hands that press parts together, a part that moves on its own and pushes another, and what
// each of them feels.

#include <array>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/multi_part_sliding.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/reference/brute_force.h>

#include "held_part.h"
#include "poses.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::cube;
using test_support::pose;
using test_support::wall;

Vector3d force_of_spring(const MultiPartSliding& sliding, std::size_t part) {
  const SlidingResult& result = sliding.result(part);
  const geometry::Displacement error =
      geometry::displacement_between(result.X_WV, result.X_WT, sliding.part(part).p_Vref());
  return -spring_wrench(sliding.stiffness(part), error).f;
}

bool collide(const MultiPartSliding& sliding) {
  return reference::brute_force_intersects(sliding.part(0).tree.mesh(), sliding.part(1).tree.mesh(),
                                           sliding.result(0).X_WV.inverse() * sliding.result(1).X_WV);
}

/// Leads both ghosts straight along x; checks after each call that the parts are apart.
void lead(MultiPartSliding& sliding, double x_first, double x_second, int calls) {
  const double from_first = sliding.result(0).X_WG.translation().x();
  const double from_second = sliding.result(1).X_WG.translation().x();
  for (int i = 1; i <= calls; ++i) {
    const double t = static_cast<double>(i) / calls;
    const std::array X_WG{pose({from_first + t * (x_first - from_first), 0.0, 0.0}),
                          pose({from_second + t * (x_second - from_second), 0.0, 0.0})};
    sliding.advance(X_WG);
    ASSERT_FALSE(collide(sliding)) << "call " << i;
  }
}

TEST(TwoParts, PressedTogetherMeetWhereTheirSpringsBalance) {
  // Faces meet at x = 0; the ghosts overlap by 3 mm, the first is held three times as stiffly.
  const std::vector<HeldPart> parts{
      {.part_V = cube(0.04), .X_WV_start = pose({-0.025, 0.0, 0.0}), .stiffness = CouplingStiffness{3000.0, 3.0}},
      {.part_V = cube(0.04), .X_WV_start = pose({0.025, 0.0, 0.0}), .stiffness = CouplingStiffness{1000.0, 1.0}}};
  MultiPartSliding sliding({wall(1.0)}, parts);
  lead(sliding, -0.02 + 1.5e-3, 0.02 - 1.5e-3, 50);
  lead(sliding, -0.02 + 1.5e-3, 0.02 - 1.5e-3, 20);
  const Vector3d first = force_of_spring(sliding, 0);
  const Vector3d second = force_of_spring(sliding, 1);
  EXPECT_NEAR(first.x(), 3e-3 / (1.0 / 3000.0 + 1.0 / 1000.0), 0.02) << "springs in series, but for the margin";
  EXPECT_LT((first + second).norm(), 1e-6) << "action is reaction";
  EXPECT_GT(sliding.result(0).pushing, 0);
  EXPECT_EQ(sliding.result(0).pushing, sliding.result(1).pushing);
}

TEST(TwoParts, EachSeesTheContactsFromItsOwnSide) {
  const std::vector<HeldPart> parts{{.part_V = cube(0.04), .X_WV_start = pose({-0.025, 0.0, 0.0})},
                                    {.part_V = cube(0.02), .X_WV_start = pose({0.015, 0.0, 0.0})}};
  MultiPartSliding sliding({wall(1.0)}, parts);
  lead(sliding, -0.018, 0.008, 50);
  for (const std::size_t part : {0U, 1U}) {
    Vector3d sum = Vector3d::Zero();
    for (const Contact& contact : sliding.result(part).contacts) {
      sum += contact.force * contact.n_W;
      EXPECT_EQ(contact.part, static_cast<std::int32_t>(part));
      EXPECT_EQ(contact.obstacle, part == 0 ? 2 : 1) << "bodies: the wall, and then the parts";
      EXPECT_NEAR(contact.p_W.x(), sliding.result(part).X_WV.translation().x() + (part == 0 ? 0.02 : -0.01), 1e-9);
    }
    EXPECT_LT((sum + force_of_spring(sliding, part)).norm(), 1e-6 * sum.norm());
  }
}

TEST(TwoParts, ThatDoNotTouchMoveAsIfAlone) {
  const std::vector<HeldPart> parts{{.part_V = cube(0.04), .X_WV_start = pose({-0.05, 0.0, 0.0})},
                                    {.part_V = cube(0.04), .X_WV_start = pose({0.05, 0.0, 0.0})}};
  MultiPartSliding sliding({wall(1.0)}, parts);
  // The first catches up with a ghost far away; the second follows its own at once.
  for (int i = 1; i <= 10; ++i) {
    const std::array X_WG{pose({-0.15, 0.0, 0.0}), pose({0.05 + 1e-3 * i, 0.0, 0.0})};
    sliding.advance(X_WG);
    EXPECT_EQ(sliding.result(1).state, SlidingState::kFree);
  }
  EXPECT_EQ(sliding.result(0).state, SlidingState::kCatchingUp);
}

TEST(TwoParts, UncertifiablePartDoesNotBlockTheOther) {
  // The first is squeezed into a slot narrower than any proof; the second is far away from everything.
  const double gap = 1e-13;
  const std::vector<HeldPart> parts{{.part_V = cube(0.04), .X_WV_start = pose({0.0, 0.0, 0.0})},
                                    {.part_V = cube(0.04), .X_WV_start = pose({-0.3, 0.0, 0.0})}};
  MultiPartSliding sliding({wall(0.02 + gap), wall(-0.02 - gap)}, parts);
  lead(sliding, 0.01, -0.32, 20);
  EXPECT_NEAR(sliding.result(1).X_WV.translation().x(), -0.32, 1e-9);
}

TEST(TwoParts, FrictionIsIndependentOfAPartWithoutContact) {
  // The first is pressed on the wall by 1 N and drawn by 0.5 N, less than 0.8 holds; the other hand moves in the air.
  const std::vector<HeldPart> parts{{.part_V = cube(0.04), .X_WV_start = pose({-0.0201, 0.0, 0.0})},
                                    {.part_V = cube(0.04), .X_WV_start = pose({-0.3, 0.0, 0.0})}};
  MultiPartSliding sliding({wall(0.0)}, parts, {.friction = {.at_rest = 0.8, .sliding = 0.2}});
  const auto advance = [&](const Vector3d& first, double second) {
    const std::array X_WG{pose(first), pose({second, 0.0, 0.0})};
    sliding.advance(X_WG);
  };
  for (int i = 0; i < 30; ++i)
    advance({-0.019, 0.0, 0.0}, -0.3);
  for (int i = 0; i < 50; ++i)
    advance({-0.019, 0.5e-3 * i / 50, 0.0}, -0.3 - 1e-3 * i);
  EXPECT_NEAR(sliding.result(0).X_WV.translation().y(), 0.0, 1e-8);
}

/// A part that moves on its own: held by a script, a thousand times as stiffly as a hand holds.
HeldPart ram(double x) {
  return {.part_V = cube(0.04),
          .X_WV_start = pose({x, 0.0, 0.0}),
          .metaphor = Metaphor::kRubberBandSpring,
          .stiffness = CouplingStiffness{1e6, 1e3},
          .name = "the ram"};
}

TEST(MovingObstacle, PushesTheHeldPartOutOfItsWay) {
  MultiPartSliding sliding({wall(1.0)}, {ram(-0.03), {.part_V = cube(0.02), .X_WV_start = pose({0.005, 0.0, 0.0})}});
  lead(sliding, -0.02, 0.005, 100);  // at 0.1 m/s, 5 mm into the part
  EXPECT_NEAR(sliding.result(0).X_WV.translation().x(), -0.02, 2e-5) << "the ram goes where it wants";
  EXPECT_NEAR(sliding.result(1).X_WV.translation().x(), 0.01, 3e-5) << "the part gives way";
  EXPECT_NEAR(force_of_spring(sliding, 1).x(), -5.0, 0.05) << "and the hand feels it";
}

TEST(MovingObstacle, WaitsWhereThePartCannotGiveWay) {
  MultiPartSliding sliding({wall(0.02)}, {ram(-0.03), {.part_V = cube(0.02), .X_WV_start = pose({0.005, 0.0, 0.0})}});
  lead(sliding, -0.005, 0.005, 200);
  EXPECT_LT(sliding.result(1).X_WV.translation().x(), 0.01) << "between ram and wall";
  EXPECT_LT(sliding.result(0).X_WV.translation().x(), -0.02 + 1e-9) << "20 mm of room are left for the part";
  EXPECT_NEAR(sliding.result(0).X_WV.translation().x(), -0.02, 3e-5);
}

TEST(ReleasedPart, StandsLikeAnObstacle) {
  MultiPartSliding sliding({wall(1.0)}, {{.part_V = cube(0.04), .X_WV_start = pose({-0.03, 0.0, 0.0})},
                                         {.part_V = cube(0.02), .X_WV_start = pose({0.005, 0.0, 0.0})}});
  sliding.release(1);
  const Isometry3d X_WV = sliding.result(1).X_WV;
  lead(sliding, -0.01, 0.5, 200);
  EXPECT_EQ(sliding.result(1).X_WV.matrix(), X_WV.matrix());
  EXPECT_EQ(sliding.result(1).state, SlidingState::kReleased);
  EXPECT_NEAR(sliding.result(0).X_WV.translation().x(), -0.025, 2e-5);
  sliding.grasp(1, X_WV);
  lead(sliding, -0.01, 0.005, 20);
  EXPECT_GT(sliding.result(1).X_WV.translation().x(), 0.005 + 1e-3) << "held again it gives way";
}

TEST(ReleasedPart, LeavesFrictionOfTheOtherAsItIs) {
  // The first rubs on the wall and keeps doing so when the second, pressed on the wall too, is let go.
  HeldPart second{.part_V = cube(0.04), .X_WV_start = pose({-0.0201, 0.1, 0.0})};
  MultiPartSliding sliding({wall(0.0)}, {{.part_V = cube(0.04), .X_WV_start = pose({-0.0201, 0.0, 0.0})}, second},
                           {.friction = {.at_rest = 0.3, .sliding = 0.3}});
  double before = 0.0;
  for (int i = 0; i < 200; ++i) {
    const std::array X_WG{pose({-0.019, -1e-4 * i, 0.0}), pose({-0.019, 0.1, 0.0})};
    if (i == 100) sliding.release(1);
    sliding.advance(X_WG);
    const double y = sliding.result(0).X_WV.translation().y();
    if (i > 50) {
      ASSERT_NEAR(y - before, -1e-4, 1e-6) << "call " << i;
    }
    before = y;
  }
}

TEST(MultiPartSliding, InvalidPoseLeavesItsPartInPlace) {
  const Isometry3d X_WV = pose({-0.3, 0.0, 0.0});
  MultiPartSliding sliding({wall(1.0)}, {{.part_V = cube(0.04)}, {.part_V = cube(0.04), .X_WV_start = X_WV}});
  const std::array X_WG{pose({0.01, 0.0, 0.0}), pose({std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0})};
  sliding.advance(X_WG);
  EXPECT_GT(sliding.result(0).X_WV.translation().x(), 0.0);
  EXPECT_EQ(sliding.result(1).X_WV.matrix(), X_WV.matrix());
}

TEST(MultiPartSliding, RefusesInvalidPartsAndOptions) {
  const HeldPart one{.part_V = cube(0.02)};
  EXPECT_THROW(MultiPartSliding({wall(1.0)}, {}), std::invalid_argument);
  EXPECT_THROW(MultiPartSliding({wall(1.0)}, {one, one}), std::invalid_argument) << "they overlap";
  HeldPart limp = one;
  limp.stiffness = CouplingStiffness{0.0, 1.0};
  EXPECT_THROW(MultiPartSliding({wall(1.0)}, {limp}), std::invalid_argument);
  EXPECT_THROW(MultiPartSliding({wall(1.0)}, {one}, {.friction = {0.2, 0.3}}), std::invalid_argument);
  EXPECT_THROW(MultiPartSliding({wall(1.0)}, {one}, {.margin = -1e-6}), std::invalid_argument);
}

}  // namespace
}  // namespace glissade::contact
