// Friction against Coulomb's law in closed form: a box on a plane, held by the spring of the coupling.

#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/collision/mesh_generators.h>
#include <glissade/haptics/coupling.h>
#include <glissade/haptics/sliding.h>

#include "held_part.h"

namespace glissade::haptics {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using std::chrono::milliseconds;
using test_support::pose;

constexpr double kStiffness = 1000.0;  // N/m, the default
constexpr double kPressed = 2e-3;      // metres below the plane: 2 N
constexpr double kAtRest = 0.5;
constexpr double kSliding = 0.3;

/// A box on a plate, pressed down by 2 N.
class PressedBox : public ::testing::Test {
 protected:
  explicit PressedBox(const Friction& friction = {kAtRest, kSliding}) { start(friction); }

  void start(const Friction& friction) {
    const auto plate =
        std::make_shared<ContactBody>(std::make_shared<collision::TriangleMesh>(collision::make_plate({0.4, 0.4}, 2)));
    const auto box = std::make_shared<SlidingPart>(
        std::make_shared<collision::TriangleMesh>(collision::make_box({0.06, 0.04, 0.02}, 12)));
    sliding_ = std::make_unique<Sliding>(std::vector<Obstacle>{{plate}}, box, pose({0.0, 0.0, 0.0101}),
                                         SlidingOptions{.rules = {.friction = friction}});
    lead({0.0, 0.0, 0.01 - kPressed}, 40);
    settle();
  }

  /// Leads the ghost straight to a place.
  void lead(const Vector3d& p_WG, int calls) {
    const Vector3d from = sliding_->result().X_WG.translation();
    for (int i = 1; i <= calls; ++i)
      sliding_->advance(pose(from + (p_WG - from) * i / calls));
  }
  void settle() {
    for (int i = 0; i < 20; ++i)
      sliding_->advance(sliding_->result().X_WG);
  }
  double x_of_part() const { return sliding_->result().X_WV.translation().x(); }
  Vector3d force_of_spring() const { return -spring_wrench(sliding_->stiffness(), sliding_->error()).f; }

  std::unique_ptr<Sliding> sliding_;
};

TEST_F(PressedBox, SticksAsLongAsTheSpringPullsLessThanTheCoefficientAtRestAllows) {
  const double x = x_of_part();
  lead({0.98 * kAtRest * kPressed, 0.0, 0.01 - kPressed}, 100);
  settle();
  EXPECT_NEAR(x_of_part(), x, 1e-9);
  EXPECT_EQ(sliding_->result().state, SlidingState::kResting);
  lead({1.02 * kAtRest * kPressed, 0.0, 0.01 - kPressed}, 10);
  settle();
  EXPECT_GT(x_of_part(), x + 0.1 * kAtRest * kPressed) << "the force of sliding is smaller: it comes some way";
}

TEST_F(PressedBox, SlidesWithTheForceOfSliding) {
  lead({0.05, 0.03, 0.01 - kPressed}, 500);
  const double normal = force_of_spring().z();
  EXPECT_NEAR(-normal, kStiffness * kPressed, 0.01);
  const Vector3d across(force_of_spring().x(), force_of_spring().y(), 0.0);
  EXPECT_NEAR(across.norm(), -kSliding * normal, 1e-3 * -normal);
  EXPECT_NEAR(across.normalized().dot(Vector3d(0.05, 0.03, 0.0).normalized()), 1.0, 1e-3) << "against the motion";
}

TEST_F(PressedBox, IsHeldByWhatItsContactsTell) {
  lead({0.05, 0.03, 0.01 - kPressed}, 500);
  Vector3d sum = Vector3d::Zero();
  for (const Contact& contact : sliding_->result().contacts) {
    sum += contact.force * contact.n_W + contact.friction_W;
    EXPECT_LE(contact.friction_W.norm(), kSliding * contact.force * (1.0 + 1e-9));
    EXPECT_NEAR(contact.friction_W.dot(contact.n_W), 0.0, 1e-12);
  }
  EXPECT_LT((sum + force_of_spring()).norm(), 1e-6 * sum.norm());
}

TEST_F(PressedBox, TurnsOnTheSpotAgainstATorqueOfFriction) {
  // Pressed evenly, four feet at radius r hold up to μ N r against turning.
  const Vector3d p = sliding_->result().X_WG.translation();
  const double radius = std::hypot(0.03, 0.02);
  const double most = kAtRest * kStiffness * kPressed * radius;
  const auto turned = [&](double torque) {
    start({kAtRest, kAtRest});
    const double angle = torque / sliding_->stiffness().rotational;
    for (int i = 1; i <= 50; ++i) {
      Isometry3d X_WG = pose(p);
      X_WG.linear() = Eigen::AngleAxisd(angle * i / 50, Vector3d::UnitZ()).toRotationMatrix();
      sliding_->advance(X_WG);
    }
    const double part = Eigen::AngleAxisd(sliding_->result().X_WV.linear()).angle();
    return part / angle;
  };
  EXPECT_LT(turned(0.9 * most), 1e-3);
  EXPECT_NEAR(turned(2.0 * most), 0.5, 0.02) << "half of the torque is friction's, half turns the part";
}

TEST_F(PressedBox, AHundredMillionthOfFrictionHardlyDiffersFromNone) {
  const auto end_of_way = [&](const Friction& friction) {
    start(friction);
    lead({0.05, 0.03, 0.01 - kPressed}, 100);
    return sliding_->result().X_WV;
  };
  const Isometry3d without = end_of_way({});
  EXPECT_LT((end_of_way({1e-8, 1e-8}).translation() - without.translation()).norm(), 1e-9);
}

/// A box on a lift that stands still for 200 ms and then goes along x at 0.1 m/s for 100 ms; pressed down by 2 N.
class BoxOnLift : public ::testing::Test {
 protected:
  static constexpr int kWaits = 200;
  static constexpr int kGoes = 100;
  static constexpr double kWay_m = 0.01;

  BoxOnLift() {
    const Isometry3d X_WLift = pose({0.0, 0.0, -0.01});
    const auto lift = test_support::part_of(collision::make_box({0.4, 0.4, 0.02}, 12));
    const devices::PoseTrajectory script({{milliseconds(0), X_WLift},
                                          {milliseconds(kWaits), X_WLift},
                                          {milliseconds(kWaits + kGoes), pose({kWay_m, 0.0, -0.01})}});
    const auto box = test_support::part_of(collision::make_box({0.06, 0.04, 0.02}, 12));
    sliding_ = std::make_unique<Sliding>(
        std::vector<Obstacle>{}, box, pose({0.0, 0.0, 0.0101}),
        SlidingOptions{.rules = {.friction = {.at_rest = kAtRest, .sliding = kSliding}}},
        std::vector<ScriptedPart>{{.part_B = lift, .script_X_WB = script, .name = "the lift"}});
  }

  /// From where the ghost is, evenly.
  void lead(const Vector3d& p_WG, int calls) { test_support::lead(*sliding_, pose(p_WG), calls); }
  double x_on_lift() const {
    return sliding_->result().X_WV.translation().x() - sliding_->scripted_X_WB()[0].translation().x();
  }

  std::unique_ptr<Sliding> sliding_;
};

TEST_F(BoxOnLift, IsCarriedAlongByWhatHoldsItAtRest) {
  // More than what slides could hold, less than what rests can.
  const double pulled = 0.8 * kAtRest * kPressed;
  static_assert(0.8 * kAtRest > kSliding);
  lead({0.0, 0.0, 0.01 - kPressed}, 100);
  lead({pulled, 0.0, 0.01 - kPressed}, 100);
  const double x = x_on_lift();
  lead({pulled + kWay_m, 0.0, 0.01 - kPressed}, kGoes);
  EXPECT_NEAR(sliding_->scripted_X_WB()[0].translation().x(), kWay_m, 1e-5) << "the lift went";
  EXPECT_NEAR(x_on_lift(), x, 1e-5) << "and the box with it";
}

TEST_F(BoxOnLift, SlipsWhereTheHandHoldsItBackAndFeelsTheForceOfSliding) {
  lead({0.0, 0.0, 0.01 - kPressed}, kWaits);
  lead({0.0, 0.0, 0.01 - kPressed}, kGoes);
  EXPECT_LT(x_on_lift(), -0.9 * kWay_m + kAtRest * kPressed);
  EXPECT_NEAR(sliding_->result().X_WV.translation().x(), kSliding * kPressed, 1e-5);
}

TEST(FrictionSolver, WithoutCoefficientFindsTheFrictionlessProjection) {
  const std::vector<Displacement> wanted{{{1e-3, 2e-3, -3e-3}, {0.01, -0.02, 0.03}}};
  const std::vector<CouplingStiffness> stiffness{{1000.0, 0.5}};
  std::vector<JointRow> rows(3);
  const std::vector<Vector3d> feet{{0.03, 0.02, -0.01}, {-0.03, 0.02, -0.01}, {0.0, -0.02, -0.01}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].n = Vector3d::UnitZ();
    rows[i].r = feet[i];
    rows[i].bound = -1e-5;
  }
  const JointProjection projection = ProjectionSolver().project(wanted, stiffness, rows);
  std::array<Displacement, kMaxParts> displacements;
  std::vector<RowForce> forces{{0, 1.0, Vector3d::Zero()}};  // a start far off
  FrictionSolver().solve(wanted, stiffness, rows, std::vector<double>(rows.size(), 0.0), displacements, forces);
  EXPECT_LT((displacements[0].v - projection.displacement().v).norm(), 1e-12);
  EXPECT_LT((displacements[0].w - projection.displacement().w).norm(), 1e-12);
  ASSERT_EQ(forces.size(), static_cast<std::size_t>(projection.active_count));
}

}  // namespace
}  // namespace glissade::haptics
