// Parts that touch their neighbors at the start, as in assemblies of nominal size: they come out along the free
// direction and are blocked in the others. All poses and the ways between them are checked by independent code, with a
// part that is made smaller by what it overlaps at the start.

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/multi_part_sliding.h>
#include <glissade/contact/sliding.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/reference/grid_check.h>

#include "held_part.h"
#include "poses.h"
#include "random_numbers.h"
#include "sweeps/nominal_fits.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::nominal_fits;
using test_support::NominalFit;
using test_support::obstacle_of;
using test_support::part_of;
using test_support::pose;
using test_support::turn;

/// Of the margin: how much deeper than at the start a part may get.
constexpr double kDeeper = 0.1;
constexpr double kMarginOfFits = 3e-6;
constexpr double kHandStep = 0.5e-3;  // of the hand in a millisecond

/// A fit somewhere in space, whose part is in the hand. A call is one cycle, so its way is one step.
class FlushFit {
 public:
  FlushFit(const NominalFit& fit, const Isometry3d& X_WA, double overlap = 0.0, OverlapRule rule = OverlapRule::kRefuse,
           double friction = 0.0)
      : X_WA_(X_WA),
        smaller_(fit.part(kDeeper * kMarginOfFits)),
        sliding_(obstacles(fit, X_WA), part_of(fit.part(-overlap)), X_WA,
                 {.rules = {.max_cycles = 1,
                            .margin = kMarginOfFits,
                            .friction = {.at_rest = friction, .sliding = friction},
                            .overlap = rule}}),
        check_(placed(fit, X_WA)) {}

  const Isometry3d& X_WV() const { return sliding_.result().X_WV; }
  const SlidingResult& result() const { return sliding_.result(); }

  /// Newtons, of the contacts on the part.
  struct Forces {
    double pressed = 0.0;  ///< sum of the normal forces
    Vector3d sum_W = Vector3d::Zero();
    double friction = 0.0;  ///< sum of the friction forces, each by its size
  };
  Forces forces() const {
    Forces forces;
    for (const Contact& contact : result().contacts) {
      forces.pressed += contact.force;
      forces.friction += contact.friction_W.norm();
      forces.sum_W += contact.force * contact.n_W + contact.friction_W;
    }
    return forces;
  }
  /// Newtons, of the part on the hand.
  Vector3d spring_W() const { return spring_wrench(sliding_.stiffness(), sliding_.lag()).f; }
  /// Where the part is, seen from its place in the assembly.
  Vector3d moved_A() const { return X_WA_.inverse() * X_WV().translation(); }

  /// The hand goes there, by a translation and a rotation vector in the assembly, and stays for a while.
  void lead(const Vector3d& to_A, const Vector3d& turn_A = Vector3d::Zero(), int stays = 50) {
    const int ticks = std::max(20, static_cast<int>((to_A - ghost_A_).norm() / kHandStep));
    const Vector3d from_A = std::exchange(ghost_A_, to_A);
    for (int i = 1; i <= ticks; ++i)
      tick(from_A + (to_A - from_A) * i / ticks, turn_A * i / ticks);
    for (int i = 0; i < stays; ++i)
      tick(to_A, turn_A);
  }

  /// Of all poses so far, and of those in between.
  int collisions() const { return collisions_; }

 private:
  static std::vector<Obstacle> obstacles(const NominalFit& fit, const Isometry3d& X_WA) {
    std::vector<Obstacle> obstacles;
    for (const geometry::TriangleMesh& mesh : fit.others)
      obstacles.push_back(obstacle_of(mesh, X_WA));
    return obstacles;
  }
  static std::vector<reference::PlacedMesh> placed(const NominalFit& fit, const Isometry3d& X_WA) {
    std::vector<reference::PlacedMesh> meshes;
    for (const geometry::TriangleMesh& mesh : fit.others)
      meshes.push_back({std::make_shared<const geometry::TriangleMesh>(mesh), X_WA});
    return meshes;
  }

  void tick(const Vector3d& to_A, const Vector3d& turn_A) {
    constexpr int kBetween = 4;
    const Isometry3d before = X_WV();
    const double angle = turn_A.norm();
    sliding_.advance(X_WA_ * pose(to_A, angle == 0.0 ? Eigen::Quaterniond::Identity() : turn(angle, turn_A)));
    for (int i = 1; i <= kBetween; ++i) {
      const Isometry3d X = test_support::between(before, X_WV(), static_cast<double>(i) / kBetween);
      collisions_ += check_.collides(smaller_, X) ? 1 : 0;
    }
  }

  Isometry3d X_WA_;
  geometry::TriangleMesh smaller_;
  Sliding sliding_;
  reference::GridCheck check_;
  Vector3d ghost_A_ = Vector3d::Zero();
  int collisions_ = 0;
};

/// Where coordinates are round, and somewhere else.
std::vector<Isometry3d> somewhere(std::uint64_t seed) {
  test_support::RandomNumbers random(seed);
  Isometry3d X(random.rotation());
  X.translation() = random.point(0.5);
  return {Isometry3d::Identity(), X};
}

class FlushFits : public testing::TestWithParam<std::size_t> {
 protected:
  const NominalFit& fit() const { return nominal_fits()[GetParam()]; }
};

TEST_P(FlushFits, ComeOutAlongTheFreeDirection) {
  for (const double overlap : {0.0, 0.5 * kMarginOfFits, -1e-9}) {
    for (const Isometry3d& X_WA : somewhere(GetParam())) {
      FlushFit flush(fit(), X_WA, overlap);
      flush.lead(fit().way_out);
      EXPECT_LT((flush.moved_A() - fit().way_out).norm(), 1e-9) << fit().name << ", overlap " << overlap;
      EXPECT_EQ(flush.result().state, SlidingState::kFree);
      EXPECT_EQ(flush.collisions(), 0) << fit().name << ", overlap " << overlap;
    }
  }
}

TEST_P(FlushFits, ComeOutIfPulledAskew) {
  for (const Isometry3d& X_WA : somewhere(100 + GetParam())) {
    FlushFit flush(fit(), X_WA);
    const Vector3d askew = fit().way_out + 1e-3 * fit().blocked.front();
    flush.lead(askew, 0.01 * fit().way_out.normalized().cross(fit().blocked.front()));
    EXPECT_LT((flush.moved_A() - askew).norm(), 2e-3) << fit().name;
    EXPECT_EQ(flush.collisions(), 0) << fit().name;
  }
}

// A hand that also pulls aside tilts the part, and its ends are pressed the harder the less of it is left inside: the
// friction of the last tenths of a millimetre may hold it, as that of a drawer does.
TEST_P(FlushFits, ComeOutAgainstFrictionOrAreHeldByIt) {
  for (const double friction : {0.1, 0.4}) {
    FlushFit flush(fit(), somewhere(300 + GetParam()).back(), 0.0, OverlapRule::kRefuse, friction);
    const Vector3d askew = fit().way_out + 1e-3 * fit().blocked.front();
    flush.lead(askew);
    flush.lead(askew, Vector3d::Zero(), 200);
    const FlushFit::Forces forces = flush.forces();
    const Vector3d spring_W = flush.spring_W();
    EXPECT_LT((forces.sum_W - spring_W).norm(), 0.02 * spring_W.norm() + 1e-9) << fit().name << ", " << friction;
    EXPECT_LE(forces.friction, 1.001 * friction * forces.pressed) << fit().name;
    EXPECT_GT(flush.moved_A().norm(), 0.3 * askew.norm()) << fit().name << ", " << friction;
    if ((flush.moved_A() - askew).norm() > 2e-3) {
      EXPECT_GT(forces.friction, 0.8 * friction * forces.pressed) << fit().name << ": not pressed more than needed";
    }
    EXPECT_EQ(flush.collisions(), 0) << fit().name;
  }
}

TEST_P(FlushFits, AreBlockedInOtherDirections) {
  for (const Isometry3d& X_WA : somewhere(200 + GetParam())) {
    for (const Vector3d& blocked : fit().blocked) {
      FlushFit flush(fit(), X_WA);
      flush.lead(3e-3 * blocked);
      EXPECT_LT(flush.moved_A().dot(blocked), kDeeper * kMarginOfFits) << fit().name << ", " << blocked.transpose();
      EXPECT_GT(flush.result().pushing, 0) << fit().name;
      EXPECT_EQ(flush.collisions(), 0) << fit().name << ", " << blocked.transpose();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, FlushFits, testing::Range<std::size_t>(0, 20));

TEST(FlushFits, AreAllTested) {
  EXPECT_EQ(nominal_fits().size(), 20u);
}

const NominalFit& fit_of(const std::string& name) {
  return *std::find_if(nominal_fits().begin(), nominal_fits().end(),
                       [&](const NominalFit& fit) { return fit.name == name; });
}

// Statics: a force across the peg, in the middle of it, is held at the rim of the sleeve and at the end of the peg.
TEST(FlushFit, FrictionOfALateralPullMatchesStatics) {
  constexpr double kFriction = 0.2;
  constexpr double kAside = 0.5e-3;
  FlushFit flush(fit_of("peg in its sleeve"), Isometry3d::Identity(), 0.0, OverlapRule::kRefuse, kFriction);
  flush.lead({kAside, 0.0, 0.035});
  const double z = flush.moved_A().z();
  const double inside = 0.04 - z;
  const double outside = z + 0.03 - 0.04;  // from the rim to the middle
  const double pull = -flush.spring_W().x();
  const FlushFit::Forces forces = flush.forces();
  EXPECT_NEAR(forces.pressed, pull * (2.0 * outside + inside) / inside, 0.1 * forces.pressed);
  EXPECT_NEAR(-forces.sum_W.x(), pull, 0.01 * pull);
  EXPECT_LT(z, 0.0345) << "friction holds it back";
  EXPECT_NEAR(-forces.sum_W.z(), 1e3 * (0.035 - z), 0.01 * forces.friction);
}

// Less than two margins: the part may come nearer than its margin to the side to which it is pulled. It stays there.
TEST(NarrowSlot, APartRestsInItWithoutGoingToAndFro) {
  for (const double clearance : {0.9, 1.5, 1.85, 1.95}) {
    const double half = 0.01 + 0.5 * clearance * kMarginOfFits;
    const auto wall = geometry::make_box({0.02, 0.1, 0.1}, 12);
    Sliding sliding(
        {obstacle_of(wall, pose({half + 0.01, 0.0, 0.0})), obstacle_of(wall, pose({-half - 0.01, 0.0, 0.0}))},
        test_support::cube(0.02), Isometry3d::Identity(), {.rules = {.max_cycles = 1, .margin = kMarginOfFits}});
    for (int i = 0; i < 20; ++i)
      sliding.advance(pose({1e-3, 0.0, 0.0}));
    const Isometry3d X_WV = sliding.result().X_WV;
    for (int i = 0; i < 20; ++i) {
      sliding.advance(pose({1e-3, 0.0, 0.0}));
      EXPECT_LT((sliding.result().X_WV.translation() - X_WV.translation()).norm(), 1e-9) << clearance;
    }
    for (int i = 0; i < 300; ++i)
      sliding.advance(pose({1e-3, 0.02, 0.01}));
    EXPECT_LT((sliding.result().X_WV.translation().tail<2>() - Vector3d(1e-3, 0.02, 0.01).tail<2>()).norm(), 1e-9)
        << "along the walls it goes";
  }
}

// The haptic thread takes its constraints from gap and margin.
TEST(NarrowSlot, ContactMarginIsLessThanTheGap) {
  const auto wall = geometry::make_box({0.02, 0.1, 0.1}, 12);
  const double half = 0.01 + 0.45 * kMarginOfFits;
  Sliding sliding({obstacle_of(wall, pose({half + 0.01, 0.0, 0.0})), obstacle_of(wall, pose({-half - 0.01, 0.0, 0.0}))},
                  test_support::cube(0.02), Isometry3d::Identity(), {.rules = {.margin = kMarginOfFits}});
  for (int i = 0; i < 20; ++i)
    sliding.advance(pose({0.0, 1e-4 * i, 0.0}));
  ASSERT_GE(sliding.result().contacts.size(), 8u);
  for (const Contact& contact : sliding.result().contacts) {
    EXPECT_NEAR(contact.gap, 0.45 * kMarginOfFits, 0.01 * kMarginOfFits);
    EXPECT_LT(contact.margin, contact.gap);
    EXPECT_GT(contact.margin, 0.0);
  }
}

TEST(NarrowSlot, AnotherPartKeepsItsMargin) {
  const auto wall = geometry::make_box({0.02, 0.1, 0.1}, 12);
  const double half = 0.01 + 0.7 * kMarginOfFits;
  const auto cube = test_support::cube(0.02);
  MultiPartSliding sliding(
      {obstacle_of(wall, pose({half + 0.01, 0.0, 0.0})), obstacle_of(wall, pose({-half - 0.01, 0.0, 0.0})),
       obstacle_of(wall, pose({0.5, 0.0, 0.0}))},
      {{.part_V = cube}, {.part_V = cube, .X_WV_start = pose({0.47, 0.0, 0.0})}}, {.margin = kMarginOfFits});
  const std::vector<Isometry3d> X_WG{pose({1e-3, 0.0, 0.0}), pose({0.482, 0.0, 0.0})};
  for (int i = 0; i < 100; ++i)
    sliding.advance(X_WG);
  EXPECT_NEAR(sliding.result(1).X_WV.translation().x(), 0.48 - kMarginOfFits, 0.01 * kMarginOfFits);
}

TEST(FlushFit, OpensToTheMarginWhereThereIsRoom) {
  FlushFit flush(fit_of("box pushed along a table"), Isometry3d::Identity());
  flush.lead(5e-3 * Vector3d::UnitX());
  EXPECT_NEAR(flush.moved_A().z(), kMarginOfFits, 0.01 * kMarginOfFits);
}

// When the faces of a box move inwards, its corners move 1.7 times as far.
TEST(TouchingParts, GetNoDeeperWhereACornerTouches) {
  const Isometry3d X_start =
      pose({0.0, 0.0, 0.01 * std::sqrt(3.0)}, test_support::turn_from_to(Vector3d::Ones(), Vector3d::UnitZ()));
  Sliding sliding({obstacle_of(geometry::make_box({0.1, 0.1, 0.02}, 12), pose({0.0, 0.0, -0.01}))},
                  test_support::cube(0.02), X_start, {.rules = {.margin = kMarginOfFits}});
  const auto lead = [&](double height) {
    for (int i = 0; i < 50; ++i)
      sliding.advance(Eigen::Translation3d(0.0, 0.0, height) * X_start);
    return sliding.result().X_WV.translation().z() - X_start.translation().z();
  };
  EXPECT_GT(lead(-1e-3), -0.05 * kMarginOfFits);
  EXPECT_GT(lead(5e-3), 4e-3);
  EXPECT_NEAR(lead(-1e-3), kMarginOfFits, 0.01 * kMarginOfFits) << "once it was apart, it is a part like any other";
}

TEST(TouchingParts, OpenMeshLiesFlatSlidesAndLiftsOff) {
  const auto plate = part_of(geometry::make_plate({0.04, 0.04}, 2));
  Sliding sliding({obstacle_of(geometry::make_box({0.2, 0.2, 0.02}, 12), pose({0.0, 0.0, -0.01}))}, plate,
                  Isometry3d::Identity(), {.rules = {.margin = kMarginOfFits}});
  const auto lead = [&](const Vector3d& to) {
    for (int i = 0; i < 100; ++i)
      sliding.advance(pose(to));
    return Vector3d(sliding.result().X_WV.translation());
  };
  EXPECT_GT(lead({0.0, 0.0, -2e-3}).z(), -kDeeper * kMarginOfFits);
  const Vector3d aside = lead({5e-3, 3e-3, -2e-3});
  EXPECT_LT((aside - Vector3d(5e-3, 3e-3, 0.0)).norm(), 2.0 * kMarginOfFits);
  EXPECT_LT((lead({5e-3, 3e-3, 4e-3}) - Vector3d(5e-3, 3e-3, 4e-3)).norm(), 1e-9);
}

TEST(TouchingParts, OpenMeshSlidesBetweenTwoBodiesButIsRefusedBetweenFacesOfOne) {
  const auto plate = part_of(geometry::make_plate({0.04, 0.04}, 2));
  const geometry::TriangleMesh box = geometry::make_box({0.2, 0.2, 0.02}, 12);
  Sliding sliding({obstacle_of(box, pose({0.0, 0.0, -0.01})), obstacle_of(box, pose({0.0, 0.0, 0.01}))}, plate,
                  Isometry3d::Identity(), {.rules = {.margin = kMarginOfFits}});
  for (int i = 0; i < 100; ++i)
    sliding.advance(pose({5e-3, 0.0, 1e-3}));
  EXPECT_LT((sliding.result().X_WV.translation() - Vector3d(5e-3, 0.0, 0.0)).norm(), kDeeper * kMarginOfFits);
  const std::vector<geometry::TriangleMesh> faces{geometry::transformed(box, pose({0.0, 0.0, -0.01})),
                                                  geometry::transformed(box, pose({0.0, 0.0, 0.01}))};
  EXPECT_THROW(Sliding({obstacle_of(geometry::merge(faces))}, plate, Isometry3d::Identity()), std::invalid_argument);
}

double depth_of(const NominalFit& fit, double overlap) {
  double depth = 0.0;
  for (const geometry::TriangleMesh& mesh : fit.others)
    depth =
        std::max(depth, overlap_depth(*obstacle_of(mesh).body, *part_of(fit.part(-overlap)), Isometry3d::Identity()));
  return depth;
}

TEST(OverlapDepth, ZeroForTouchingPartsElseTheOverlap) {
  for (const NominalFit& fit : nominal_fits()) {
    EXPECT_EQ(depth_of(fit, 0.0), 0.0) << fit.name;
    EXPECT_NEAR(depth_of(fit, 0.1e-3), 0.1e-3, 1e-6) << fit.name;
  }
}

TEST(OverlapDepth, DoesNotDependOnTheOrientationOfTriangles) {
  const NominalFit& fit = fit_of("peg in its sleeve");
  const auto sleeve = obstacle_of(geometry::flip_randomly(fit.others.front(), 1)).body;
  const auto peg = part_of(geometry::flip_randomly(fit.part(-0.1e-3), 2));
  EXPECT_NEAR(overlap_depth(*sleeve, *peg, Isometry3d::Identity()), 0.1e-3, 1e-6);
}

TEST(OverlapDepth, PartInASheetHasTheDepthOfTheShortestWayOut) {
  const auto sheet = obstacle_of(geometry::make_plate({0.4, 0.4}, 2)).body;
  EXPECT_NEAR(overlap_depth(*sheet, *test_support::cube(0.02), pose({0.0, 0.0, 0.0})), 0.01, 1e-4);
  EXPECT_NEAR(overlap_depth(*sheet, *test_support::cube(0.02), pose({0.0, 0.0, 0.008})), 0.002, 1e-5);
}

TEST(Depenetration, NeverTakesAPartThroughAWall) {
  FlushFit flush(fit_of("peg in its sleeve"), Isometry3d::Identity(), 0.1e-3, OverlapRule::kDepenetrate);
  flush.lead(Vector3d::Zero());
  EXPECT_LT(flush.moved_A().norm(), 2.0 * kMarginOfFits) << "there is no short way out";
  flush.lead(3e-3 * Vector3d::UnitX());
  EXPECT_LT(flush.moved_A().norm(), 2.0 * kMarginOfFits) << "the wall holds";
  flush.lead(0.07 * Vector3d::UnitZ());
  EXPECT_LT((flush.moved_A() - 0.07 * Vector3d::UnitZ()).norm(), 1e-9) << "but the hand can pull it out";
  EXPECT_EQ(flush.collisions(), 0);
}

TEST(Depenetration, IsRefusedWhereNoWayOutIsCertain) {
  const auto sheet = test_support::wall(0.0);
  EXPECT_THROW(Sliding({sheet}, test_support::cube(0.02), Isometry3d::Identity(),
                       {.rules = {.overlap = OverlapRule::kDepenetrate}}),
               std::invalid_argument)
      << "in the middle of a sheet";
  EXPECT_THROW(Sliding({obstacle_of(geometry::make_box({0.02, 0.02, 0.02}, 12))}, test_support::cube(0.02),
                       Isometry3d::Identity(), {.rules = {.overlap = OverlapRule::kDepenetrate}}),
               std::invalid_argument)
      << "one in the other, all faces in one";
}

TEST(TouchingParts, TwoOfThemComeApartAndNeverGetDeeper) {
  const auto box = test_support::cube(0.02);
  MultiPartSliding sliding({test_support::wall(1.0)},
                           {{.part_V = box}, {.part_V = box, .X_WV_start = pose({0.02, 0.0, 0.0})}});
  std::vector<Isometry3d> X_WG{Isometry3d::Identity(), pose({0.02, 0.0, 0.0})};
  const reference::GridCheck check({{std::make_shared<const geometry::TriangleMesh>(box->tree.mesh())}});
  const geometry::TriangleMesh smaller = geometry::make_box(Vector3d::Constant(0.02 - 0.6e-6), 12);
  for (int i = 0; i < 100; ++i) {
    X_WG[1].translation() -= Vector3d(0.1e-3, 0.0, 0.02e-3);
    sliding.advance(X_WG);
    ASSERT_FALSE(check.collides(smaller, sliding.result(0).X_WV.inverse() * sliding.result(1).X_WV)) << "tick " << i;
  }
  EXPECT_GT(sliding.result(1).pushing, 0);
  ASSERT_FALSE(sliding.result(1).contacts.empty());
  EXPECT_EQ(sliding.result(1).contacts.front().rider, -1) << "of the part itself";
  for (int i = 0; i < 300; ++i) {
    X_WG[1].translation() += Vector3d(0.1e-3, 0.0, 0.0);
    sliding.advance(X_WG);
  }
  EXPECT_EQ(sliding.result(1).state, SlidingState::kFree);
}

}  // namespace
}  // namespace glissade::contact
