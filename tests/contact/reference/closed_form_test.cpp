// Sliding against optima in closed form, with the margin in them: the box lies on a plane, stands on an edge and on a
// corner, is caught in a groove and in a corner, and balances on the edge of a block; two spheres meet. Position,
// rotation, force and torque.

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "held_part.h"
#include "poses.h"
#include "sanitizers.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::make_box;
using geometry::make_plate;
using test_support::kBoxSize;
using test_support::kRestBalance;
using test_support::kRestPosition_m;
using test_support::kRestRotation_rad;
using test_support::pose;
using test_support::turn;
using test_support::turn_from_to;

constexpr double kLag_m = 1e-6;
constexpr double kRightAngle = 0.5 * std::numbers::pi;

const double kHalfLength = 0.5 * kBoxSize.x();
const double kHalfHeight = 0.5 * kBoxSize.z();

Obstacle floor_below() {
  return test_support::obstacle_of(geometry::make_plate({0.5, 0.5}, 200));
}

/// A long block one of whose edges lies on the y axis and points up.
Obstacle ridge() {
  constexpr double kWidth = 0.05;
  return test_support::obstacle_of(
      geometry::make_box({kWidth, 0.4, kWidth}, 12),
      pose({0.0, 0.0, -kWidth / std::numbers::sqrt2}, turn(0.5 * kRightAngle, Vector3d::UnitY())));
}

Sliding held_box(std::vector<Obstacle> obstacles, const Isometry3d& X_WV) {
  return {std::move(obstacles),
          test_support::part_of(geometry::make_box(kBoxSize, 300)),
          X_WV,
          {.metaphor = Metaphor::kRubberBandSpring}};
}

double turned_by(const Isometry3d& X, const Isometry3d& Y) {
  return geometry::displacement_between(X, Y, Vector3d::Zero()).w.norm();
}

/// The part is at the optimum, and what holds it there is the spring's force and torque.
void expect_at_rest(Sliding& sliding, const Isometry3d& X_optimum) {
  ASSERT_GE(test_support::hold_until_rest(sliding), 0);
  const SlidingResult& result = sliding.result();
  EXPECT_LE((result.X_WV.translation() - X_optimum.translation()).norm(), kRestPosition_m);
  EXPECT_LE(turned_by(result.X_WV, X_optimum), kRestRotation_rad);
  EXPECT_LE(test_support::imbalance(sliding), kRestBalance);

  const geometry::Displacement stretch = geometry::displacement_between(X_optimum, result.X_WG, Vector3d::Zero());
  const Wrench on_part = test_support::spring_on_part(sliding);
  EXPECT_LE((on_part.f - sliding.stiffness().translational * stretch.v).norm(),
            sliding.stiffness().translational * kRestPosition_m);
  EXPECT_LE((on_part.t - sliding.stiffness().rotational * stretch.w).norm(),
            sliding.stiffness().rotational * kRestRotation_rad);
}

/// Where a function with one change of sign between `low` and `high` is zero.
double zero_of(const std::function<double(double)>& f, double low, double high) {
  const bool rises = f(high) > f(low);
  for (int halving = 0; halving < 100; ++halving) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0.0) == rises ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

TEST(ClosedForm, TiltedBoxLiesFlatWhileTheForceActsWithinItsBase) {
  Sliding sliding = held_box({floor_below()}, pose({0.0, 0.0, 0.03}));
  const double depth = 3e-3;
  const double tilt = 0.02;
  // The force acts kr tilt / (kt depth) = 25 mm from the middle of a foot of 50 mm on either side.
  ASSERT_LT(sliding.stiffness().rotational * tilt, sliding.stiffness().translational * depth * kHalfLength);
  test_support::lead(sliding, pose({0.02, 0.01, kHalfHeight - depth}, turn(tilt, Vector3d::UnitY())), 100);
  expect_at_rest(sliding, pose({0.02, 0.01, kHalfHeight + sliding.margin()}));
}

TEST(ClosedForm, BoxTiltedFurtherStandsOnOneEdge) {
  Sliding sliding = held_box({floor_below()}, pose({0.0, 0.0, 0.03}));
  const double tilt = 0.15;
  const Vector3d p_WG(0.01, 0.02, kHalfHeight);
  // Turned by a, the box stands so high; then ½ kt (height − z_G)² + ½ kr (a − tilt)² is least where its slope is zero.
  const auto height = [&](double a) {
    return sliding.margin() + kHalfLength * std::sin(a) + kHalfHeight * std::cos(a);
  };
  const auto slope_of_energy = [&](double a) {
    const double slope_of_height = kHalfLength * std::cos(a) - kHalfHeight * std::sin(a);
    return sliding.stiffness().translational * (height(a) - p_WG.z()) * slope_of_height +
           sliding.stiffness().rotational * (a - tilt);
  };
  const double angle = zero_of(slope_of_energy, 0.0, tilt);
  ASSERT_GT(angle, 0.05) << "it does not lie flat";
  test_support::lead(sliding, pose(p_WG, turn(tilt, Vector3d::UnitY())), 100);
  expect_at_rest(sliding, pose({p_WG.x(), p_WG.y(), height(angle)}, turn(angle, Vector3d::UnitY())));
}

TEST(ClosedForm, BoxOnItsCornerSlidesWithoutRotationOrLag) {
  // The space diagonal upright: the box stands on a corner right below its middle.
  const Eigen::Quaterniond q = turn_from_to(kBoxSize, Vector3d::UnitZ());
  const double half_diagonal = 0.5 * kBoxSize.norm();
  Sliding sliding = held_box({floor_below()}, pose({-0.05, 0.0, half_diagonal + 1e-3}, q));
  const double height = half_diagonal + sliding.margin();
  test_support::lead(sliding, pose({-0.05, 0.0, half_diagonal - 3e-3}, q), 50);
  expect_at_rest(sliding, pose({-0.05, 0.0, height}, q));
  test_support::lead(sliding, pose({0.05, 0.03, half_diagonal - 3e-3}, q), 300, [&](const SlidingResult& result) {
    ASSERT_LE((result.X_WV.translation() - Vector3d(result.X_WG(0, 3), result.X_WG(1, 3), height)).norm(), kLag_m);
    ASSERT_LE(turned_by(result.X_WV, result.X_WG), kRestRotation_rad);
  });
}

TEST(ClosedForm, LyingOnAPlaneItFollowsWithoutLag) {
  Sliding sliding = held_box({floor_below()}, pose({-0.1, 0.0, 0.03}));
  test_support::lead(sliding, pose({-0.1, 0.0, kHalfHeight - 3e-3}), 100);
  const double height = kHalfHeight + sliding.margin();
  expect_at_rest(sliding, pose({-0.1, 0.0, height}));
  const Isometry3d X_WG = pose({0.1, 0.05, kHalfHeight - 3e-3}, turn(0.5, Vector3d::UnitZ()));
  test_support::lead(sliding, X_WG, 500, [&](const SlidingResult& result) {
    ASSERT_LE((result.X_WV.translation() - Vector3d(result.X_WG(0, 3), result.X_WG(1, 3), height)).norm(), kLag_m);
    ASSERT_LE(turned_by(result.X_WV, result.X_WG), kRestRotation_rad);
  });
}

TEST(ClosedForm, InAGrooveItStaysOneMarginFromBothSidesAndFollowsAlongIt) {
  const Vector3d left = Vector3d(1.0, 0.0, 1.0).normalized();
  const Vector3d right = Vector3d(-1.0, 0.0, 1.0).normalized();
  const auto side = [](const Vector3d& normal) {
    return test_support::obstacle_of(geometry::make_plate({0.5, 0.5}, 200),
                                     pose(Vector3d::Zero(), turn_from_to(Vector3d::UnitZ(), normal)));
  };
  // Two of the box's faces lie flush with the sides.
  const Eigen::Quaterniond q = turn(0.5 * kRightAngle, Vector3d::UnitY());
  const Vector3d seat = kHalfHeight * left + kHalfLength * right;
  Sliding sliding = held_box({side(left), side(right)}, pose(seat + Vector3d(0.0, -0.1, 0.01), q));
  const Vector3d optimum = seat + sliding.margin() * (left + right);
  test_support::lead(sliding, pose(seat + Vector3d(0.001, -0.1, -0.003), q), 100);
  expect_at_rest(sliding, pose(optimum + Vector3d(0.0, -0.1, 0.0), q));
  test_support::lead(sliding, pose(seat + Vector3d(0.001, 0.1, -0.003), q), 500, [&](const SlidingResult& result) {
    ASSERT_LE((result.X_WV.translation() - optimum - Vector3d(0.0, result.X_WG(1, 3), 0.0)).norm(), kLag_m);
  });
}

TEST(ClosedForm, InACornerItStaysOneMarginFromAllThreeSides) {
  const auto wall = [](const Vector3d& normal) {
    return test_support::obstacle_of(geometry::make_plate({0.5, 0.5}, 200),
                                     pose(Vector3d::Zero(), turn_from_to(Vector3d::UnitZ(), normal)));
  };
  const Vector3d seat = 0.5 * kBoxSize;
  Sliding sliding = held_box({wall(Vector3d::UnitX()), wall(Vector3d::UnitY()), wall(Vector3d::UnitZ())},
                             pose(seat + Vector3d::Constant(0.01)));
  const Isometry3d optimum = pose(seat + Vector3d::Constant(sliding.margin()));
  for (const Vector3d& p_WG : {Vector3d(-2e-3, -3e-3, -4e-3), Vector3d(-4e-3, -2e-3, -1e-3)}) {
    test_support::lead(sliding, pose(seat + p_WG), 200);
    expect_at_rest(sliding, optimum);
  }
}

TEST(ClosedForm, AFaceHeldOverTheEdgeOfABlockTipsToTheSideOfTheForce) {
  Sliding sliding = held_box({ridge()}, pose({0.0, 0.0, 0.03}));
  const double reach = kHalfHeight + sliding.margin();
  const Vector3d p_WG(0.02, 0.01, kHalfHeight - 2e-3);
  // Turned by a about y, the lower face keeps `reach` from its middle to the edge on the y axis along its normal, and
  // the spring gives way along that normal only.
  const auto normal = [](double a) { return Vector3d(std::sin(a), 0.0, std::cos(a)); };
  const auto lift = [&](double a) { return reach - p_WG.dot(normal(a)); };
  const auto slope_of_energy = [&](double a) {
    const double slope_of_lift = -p_WG.dot(Vector3d(std::cos(a), 0.0, -std::sin(a)));
    return sliding.stiffness().translational * lift(a) * slope_of_lift + sliding.stiffness().rotational * a;
  };
  const double angle = zero_of(slope_of_energy, 0.0, 0.5);
  ASSERT_GT(angle, 0.005);
  test_support::lead(sliding, pose(p_WG), 100);
  expect_at_rest(sliding, pose(p_WG + lift(angle) * normal(angle), turn(angle, Vector3d::UnitY())));
}

TEST(ClosedForm, AnEdgeHeldOverTheEdgeOfABlockTipsLikeAFace) {
  // Turned by half a right angle about its length, the box hangs with one long edge down, across the block's. In the
  // plane of its length and of the vertical it is again a line at some distance from the middle.
  const double below = 0.5 * std::hypot(kBoxSize.y(), kBoxSize.z());
  const Eigen::Quaterniond q_down = turn_from_to(Vector3d(0.0, kBoxSize.y(), kBoxSize.z()), Vector3d::UnitZ());
  Sliding sliding = held_box({ridge()}, pose({0.0, 0.0, below + 0.01}, q_down));
  const double reach = below + sliding.margin();
  const Vector3d p_WG(-0.015, 0.01, below - 3e-3);
  const auto normal = [](double a) { return Vector3d(std::sin(a), 0.0, std::cos(a)); };
  const auto lift = [&](double a) { return reach - p_WG.dot(normal(a)); };
  const auto slope_of_energy = [&](double a) {
    const double slope_of_lift = -p_WG.dot(Vector3d(std::cos(a), 0.0, -std::sin(a)));
    return sliding.stiffness().translational * lift(a) * slope_of_lift + sliding.stiffness().rotational * a;
  };
  const double angle = zero_of(slope_of_energy, -0.5, 0.0);
  ASSERT_LT(angle, -0.005);
  test_support::lead(sliding, pose(p_WG, q_down), 100);
  expect_at_rest(sliding, pose(p_WG + lift(angle) * normal(angle), turn(angle, Vector3d::UnitY()) * q_down));
}

/// The distance of the nearest facet of a mesh around the origin.
double inner_radius(const geometry::TriangleMesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3d& a = mesh.corner(static_cast<std::int32_t>(t), 0);
    const Vector3d normal =
        (mesh.corner(static_cast<std::int32_t>(t), 1) - a).cross(mesh.corner(static_cast<std::int32_t>(t), 2) - a);
    if (!normal.isZero()) least = std::min(least, std::abs(normal.normalized().dot(a)));
  }
  return least;
}

TEST(ClosedForm, SphereOnSphereMatchesWithinTheFacetSagittas) {
  const double radius_O = 0.04;
  const double radius_V = 0.02;
  constexpr int kTriangles = test_support::kSanitized ? 2000 : 4000;
  const geometry::TriangleMesh sphere_O = geometry::make_sphere(radius_O, kTriangles);
  const geometry::TriangleMesh sphere_V = geometry::make_sphere(radius_V, kTriangles);
  const double sagittas = radius_O - inner_radius(sphere_O) + radius_V - inner_radius(sphere_V);
  ASSERT_LT(sagittas, 0.8 / kTriangles);
  Sliding sliding({test_support::obstacle_of(sphere_O)}, test_support::part_of(sphere_V), pose({0.0, 0.0, 0.07}),
                  {.metaphor = Metaphor::kRubberBandSpring});
  const double smooth = radius_O + radius_V + sliding.margin();
  const auto energy = [&](double stretch) { return 0.5 * sliding.stiffness().translational * stretch * stretch; };
  for (const Vector3d& direction : {Vector3d(0.1, 0.2, 1.0), Vector3d(0.5, -0.3, 0.8), Vector3d(0.9, 0.1, 0.4)}) {
    const double depth = 2e-3;
    test_support::lead(sliding, pose((smooth - depth) * direction.normalized()), 200);
    ASSERT_GE(test_support::hold_until_rest(sliding), 0);
    const double distance = sliding.result().X_WV.translation().norm();
    EXPECT_LE(distance, smooth + kRestPosition_m);
    EXPECT_GE(distance, smooth - sagittas);
    // A smaller part among smaller obstacles has more room, so its optimum is not worse.
    const double length = test_support::length_in(sliding.stiffness(), sliding.lag());
    EXPECT_LE(0.5 * length * length, energy(depth + kRestPosition_m));
    EXPECT_GE(0.5 * length * length, energy(depth - sagittas));
    EXPECT_LE(test_support::imbalance(sliding), kRestBalance);
  }
}

}  // namespace
}  // namespace glissade::contact
