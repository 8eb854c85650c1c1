#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <glissade/geometry/displacement.h>

namespace glissade::geometry {
namespace {

constexpr unsigned kMotionSeed = 7;

class Motion : public ::testing::Test {
 protected:
  Eigen::Vector3d random_vector() { return {uniform_(generator_), uniform_(generator_), uniform_(generator_)}; }
  Eigen::Isometry3d random_pose() {
    return displaced(Eigen::Isometry3d::Identity(), Eigen::Vector3d::Zero(), {random_vector(), 3.0 * random_vector()});
  }
  std::mt19937 generator_{kMotionSeed};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

TEST_F(Motion, DisplacementBetweenTwoPosesTakesOneToTheOther) {
  SCOPED_TRACE("seed " + std::to_string(kMotionSeed));
  for (int i = 0; i < 200; ++i) {
    const Eigen::Isometry3d X_WV = random_pose();
    const Eigen::Isometry3d X_WG = random_pose();
    const Eigen::Vector3d p_Vref = random_vector();
    const Displacement d = displacement_between(X_WV, X_WG, p_Vref);
    EXPECT_TRUE(displaced(X_WV, p_Vref, d).isApprox(X_WG, 1e-12));
  }
}

TEST_F(Motion, RotatesAboutTheReferencePoint) {
  const Eigen::Vector3d p_Vref(0.1, 0.2, 0.3);
  const Displacement turn{Eigen::Vector3d::Zero(), {0.0, 0.0, std::numbers::pi / 2}};
  const Eigen::Isometry3d X = displaced(Eigen::Isometry3d::Identity(), p_Vref, turn);
  EXPECT_TRUE((X * p_Vref).isApprox(p_Vref));
  EXPECT_TRUE((X * Eigen::Vector3d(p_Vref + Eigen::Vector3d::UnitX())).isApprox(p_Vref + Eigen::Vector3d::UnitY()));
}

TEST_F(Motion, NoPointMovesMoreThanTheBoundAtAnyMoment) {
  SCOPED_TRACE("seed " + std::to_string(kMotionSeed));
  const double radius = 0.5;
  for (int i = 0; i < 200; ++i) {
    const Displacement d{0.1 * random_vector(), random_vector()};
    const Eigen::Vector3d x = radius * random_vector().normalized();
    for (const double t : {0.1, 0.5, 0.9, 1.0}) {
      const Eigen::Isometry3d X = displaced(Eigen::Isometry3d::Identity(), Eigen::Vector3d::Zero(), d.scaled(t));
      EXPECT_LE((X * x - x).norm(), motion_bound(d, radius) * (1.0 + 1e-12));
    }
  }
  // ... and the bound is attained by a half turn.
  EXPECT_DOUBLE_EQ(motion_bound({Eigen::Vector3d::Zero(), {std::numbers::pi, 0, 0}}, radius), 2.0 * radius);
}

TEST_F(Motion, ShortenedDisplacementStaysWithinTheLength) {
  const double radius = 0.5;
  for (const double angle : {0.001, 0.1, 1.0, 3.0, std::numbers::pi}) {
    for (const double longest : {0.0, 1e-4, 0.01, 0.3}) {
      const Displacement d{Eigen::Vector3d(0.02, 0.0, 0.0), Eigen::Vector3d(0.0, angle, 0.0)};
      EXPECT_LE(motion_bound(d.scaled(fraction_within(d, radius, longest)), radius), longest * (1.0 + 1e-12));
    }
    EXPECT_EQ(fraction_within({Eigen::Vector3d::Zero(), {angle, 0.0, 0.0}}, radius, 1.1), 1.0);
  }
}

}  // namespace
}  // namespace glissade::geometry
