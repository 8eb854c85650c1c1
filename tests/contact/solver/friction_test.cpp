// Friction against Coulomb's law in closed form: a box on a plane, held by the spring of the coupling.

#include "solver/friction.h"

#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/sliding.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/pose_trajectory.h>

#include "held_part.h"
#include "poses.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using std::chrono::milliseconds;
using test_support::pose;
using test_support::turn;

constexpr double kStiffness_N_per_m = 1000.0;  // N/m, the default
constexpr double kPressed = 2e-3;              // metres below the plane: 2 N
constexpr double kAtRest = 0.5;
constexpr double kWhileSliding = 0.3;

/// A box on a plate, pressed down by 2 N.
class PressedBox : public ::testing::Test {
 protected:
  explicit PressedBox(const Friction& friction = {kAtRest, kWhileSliding}) { start(friction); }

  void start(const Friction& friction) {
    const auto plate =
        std::make_shared<ContactBody>(std::make_shared<geometry::TriangleMesh>(geometry::make_plate({0.4, 0.4}, 2)));
    const auto box = std::make_shared<SlidingPart>(
        std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.06, 0.04, 0.02}, 12)));
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
  Vector3d force_of_spring() const { return -spring_wrench(sliding_->stiffness(), sliding_->lag()).f; }

  std::unique_ptr<Sliding> sliding_;
};

TEST_F(PressedBox, SticksUpToTheStaticFrictionLimit) {
  const double x = x_of_part();
  lead({0.98 * kAtRest * kPressed, 0.0, 0.01 - kPressed}, 100);
  settle();
  EXPECT_NEAR(x_of_part(), x, 1e-9);
  EXPECT_EQ(sliding_->result().state, SlidingState::kResting);
  lead({1.02 * kAtRest * kPressed, 0.0, 0.01 - kPressed}, 10);
  settle();
  EXPECT_GT(x_of_part(), x + 0.1 * kAtRest * kPressed) << "the force of sliding is smaller: it comes some way";
}

TEST_F(PressedBox, SlidesWithTheKineticFrictionForce) {
  lead({0.05, 0.03, 0.01 - kPressed}, 500);
  const double normal = force_of_spring().z();
  EXPECT_NEAR(-normal, kStiffness_N_per_m * kPressed, 0.01);
  const Vector3d across(force_of_spring().x(), force_of_spring().y(), 0.0);
  EXPECT_NEAR(across.norm(), -kWhileSliding * normal, 1e-3 * -normal);
  EXPECT_NEAR(across.normalized().dot(Vector3d(0.05, 0.03, 0.0).normalized()), 1.0, 1e-3) << "against the motion";
}

TEST_F(PressedBox, ContactForcesBalanceTheSpring) {
  lead({0.05, 0.03, 0.01 - kPressed}, 500);
  Vector3d sum = Vector3d::Zero();
  for (const Contact& contact : sliding_->result().contacts) {
    sum += contact.force * contact.n_W + contact.friction_W;
    EXPECT_LE(contact.friction_W.norm(), kWhileSliding * contact.force * (1.0 + 1e-9));
    EXPECT_NEAR(contact.friction_W.dot(contact.n_W), 0.0, 1e-12);
  }
  EXPECT_LT((sum + force_of_spring()).norm(), 1e-6 * sum.norm());
}

TEST_F(PressedBox, TurnsOnTheSpotAgainstATorqueOfFriction) {
  // Pressed evenly, four feet at radius r hold up to μ N r against turning.
  const Vector3d p = sliding_->result().X_WG.translation();
  const double radius = std::hypot(0.03, 0.02);
  const double most = kAtRest * kStiffness_N_per_m * kPressed * radius;
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

TEST_F(PressedBox, TinyFrictionMatchesTheFrictionlessPose) {
  const auto end_of_way = [&](const Friction& friction) {
    start(friction);
    lead({0.05, 0.03, 0.01 - kPressed}, 100);
    return sliding_->result().X_WV;
  };
  const Isometry3d without = end_of_way({});
  EXPECT_LT((end_of_way({1e-8, 1e-8}).translation() - without.translation()).norm(), 1e-9);
}

/// A box on a carriage that stands still for 200 ms and then moves for 100 ms; pressed down by 2 N.
class BoxOnCarriage : public ::testing::Test {
 protected:
  static constexpr int kWaits = 200;
  static constexpr int kMoves = 100;
  /// What the hand pulls with across is more than what slides could hold, and less than what rests can.
  static constexpr double kPulled = 0.8 * kAtRest * kPressed;
  static_assert(0.8 * kAtRest > kWhileSliding);

  /// The motion is in world axes, about the middle of the carriage.
  void start(const Vector3d& p_box, const Isometry3d& X_motion) {
    motion_ = X_motion;
    const Isometry3d X_WCarriage = pose({0.0, 0.0, -0.01});
    const geometry::PoseTrajectory script({{milliseconds(0), X_WCarriage},
                                           {milliseconds(kWaits), X_WCarriage},
                                           {milliseconds(kWaits + kMoves), X_motion * X_WCarriage}});
    const auto carriage = test_support::part_of(geometry::make_box({0.4, 0.4, 0.02}, 12));
    const auto box = test_support::part_of(geometry::make_box({0.06, 0.04, 0.02}, 12));
    sliding_ = std::make_unique<Sliding>(
        std::vector<Obstacle>{}, box, pose(p_box + Vector3d(0.0, 0.0, 0.0101)),
        SlidingOptions{.rules = {.friction = {.at_rest = kAtRest, .sliding = kWhileSliding}}},
        std::vector<ScriptedPart>{{.part_B = carriage, .script_X_WB = script, .name = "the carriage"}});
    lead(p_box + Vector3d(0.0, 0.0, 0.01 - kPressed), kWaits / 2);
  }

  void lead(const Vector3d& p_WG, int calls) { test_support::lead(*sliding_, pose(p_WG), calls); }
  /// The hand goes with the carriage.
  void go_along() {
    const Isometry3d X_WG = sliding_->result().X_WG;
    for (int i = 1; i <= kMoves; ++i)
      sliding_->advance(test_support::between(Isometry3d::Identity(), motion_, static_cast<double>(i) / kMoves) * X_WG);
    EXPECT_LT((sliding_->scripted_X_WB()[0].matrix() - (motion_ * pose({0.0, 0.0, -0.01})).matrix()).norm(), 1e-5)
        << "the carriage went";
  }
  /// Where the box is on the carriage.
  Vector3d p_CarriageV() const {
    return (sliding_->scripted_X_WB()[0].inverse() * sliding_->result().X_WV).translation();
  }

  Isometry3d motion_;
  std::unique_ptr<Sliding> sliding_;
};

TEST_F(BoxOnCarriage, StaticFrictionCarriesItAlong) {
  start({0.0, 0.0, 0.0}, pose({0.01, 0.0, 0.0}));
  lead({kPulled, 0.0, 0.01 - kPressed}, kWaits / 2);
  const Vector3d before = p_CarriageV();
  go_along();
  EXPECT_LT((p_CarriageV() - before).norm(), 1e-5);
}

TEST_F(BoxOnCarriage, StaticFrictionCarriesItThroughATurn) {
  // A turn by 180°/s, 0.1 m from its axis.
  start({0.1, 0.0, 0.0}, pose({0.0, 0.0, 0.0}, turn(0.1 * std::numbers::pi, Vector3d::UnitZ())));
  lead({0.1, kPulled, 0.01 - kPressed}, kWaits / 2);
  const Vector3d before = p_CarriageV();
  go_along();
  const Vector3d moved = p_CarriageV() - before;
  EXPECT_NEAR(moved.y(), 0.0, 0.1 * (kPulled - kWhileSliding * kPressed)) << "held against the pull";
  const double turned = 1e-3 * std::numbers::pi;  // in a call
  EXPECT_NEAR(moved.x(), 0.0, 1.2 * kMoves * 0.5 * turned * turned * 0.1) << "creeps outwards to second order";
}

TEST_F(BoxOnCarriage, SlipsWithKineticFrictionIfHeldBack) {
  constexpr double kWay_m = 0.01;
  start({0.0, 0.0, 0.0}, pose({kWay_m, 0.0, 0.0}));
  lead({0.0, 0.0, 0.01 - kPressed}, kWaits / 2 + kMoves);
  EXPECT_LT(p_CarriageV().x(), -0.9 * kWay_m + kAtRest * kPressed);
  EXPECT_NEAR(sliding_->result().X_WV.translation().x(), kWhileSliding * kPressed, 1e-5);
}

TEST(FrictionSolver, WithoutCoefficientFindsTheFrictionlessProjection) {
  const std::vector<geometry::Displacement> wanted{{{1e-3, 2e-3, -3e-3}, {0.01, -0.02, 0.03}}};
  const std::vector<CouplingStiffness> stiffness{{1000.0, 0.5}};
  std::vector<CoupledRow> rows(3);
  const std::vector<Vector3d> feet{{0.03, 0.02, -0.01}, {-0.03, 0.02, -0.01}, {0.0, -0.02, -0.01}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].n = Vector3d::UnitZ();
    rows[i].r = feet[i];
    rows[i].bound = -1e-5;
  }
  const CoupledProjection projection = ProjectionSolver().project(wanted, stiffness, rows);
  std::array<geometry::Displacement, kMaxParts> displacements{};  // a start far off
  std::vector<RowForce> forces;
  FrictionSolver().solve(wanted, stiffness, rows, std::vector<double>(rows.size(), 0.0), displacements, forces);
  EXPECT_LT((displacements[0].v - projection.displacement().v).norm(), 1e-10);
  EXPECT_LT((displacements[0].w - projection.displacement().w).norm(), 1e-9);
  ASSERT_EQ(forces.size(), static_cast<std::size_t>(projection.active_count));
}

/// A part whose hand wants nothing of it, in a solution of one contact.
class OneContact : public ::testing::Test {
 protected:
  void solve(double bound, double coefficient, std::int64_t most_evaluations = 1000) {
    rows_[0].n = Vector3d::UnitZ();
    rows_[0].r = {0.0, 0.0, -0.01};
    rows_[0].bound = bound;
    solver_.solve(std::vector<geometry::Displacement>{{}}, std::vector<CouplingStiffness>{{kStiffness_N_per_m, 0.5}},
                  rows_, std::vector<double>{coefficient}, displacements_, forces_, most_evaluations);
  }

  std::vector<CoupledRow> rows_{1};
  FrictionSolver solver_;
  std::array<geometry::Displacement, kMaxParts> displacements_{};
  std::vector<RowForce> forces_;
};

TEST_F(OneContact, RestoringTheMarginConvergesQuickly) {
  solve(1e-6, 0.3);
  EXPECT_NEAR(displacements_[0].v.z(), 1e-6, 1e-12);
  ASSERT_EQ(forces_.size(), 1u);
  EXPECT_NEAR(forces_[0].normal, kStiffness_N_per_m * 1e-6, 1e-9);
  EXPECT_LT(solver_.evaluations(), 60);
  EXPECT_TRUE(solver_.is_settled());
}

TEST_F(OneContact, ReportsUnsettledIfTheWorkDoesNotSuffice) {
  solve(1e-6, 0.3, 2);
  EXPECT_LE(solver_.evaluations(), 2);
  EXPECT_FALSE(solver_.is_settled());
}

TEST_F(OneContact, WithoutFrictionNeverPulls) {
  solve(-1e-6, 0.0);
  EXPECT_TRUE(displacements_[0].is_zero());
  EXPECT_TRUE(forces_.empty());
}

/// A ring of very many contacts on a plane, pressed by 2 N, as two finely tessellated flush faces have them.
class FlushRing : public ::testing::Test {
 protected:
  static constexpr int kContacts = 2048;
  static constexpr double kRadius = 0.01;
  static constexpr double kCoefficient = 0.2;
  static constexpr double kRotational = 0.1;  // Nm/rad

  /// The displacement that the hand wants, besides pressing.
  geometry::Displacement solve(const Vector3d& along, double turn_about_z) {
    std::vector<CoupledRow> rows;
    for (int i = 0; i < kContacts; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kContacts;
      CoupledRow& row = rows.emplace_back();
      row.n = Vector3d::UnitZ();
      row.r = {kRadius * std::cos(angle), kRadius * std::sin(angle), 0.0};
      row.bound = 0.0;
    }
    const std::vector<geometry::Displacement> wanted{
        {along - kPressed * Vector3d::UnitZ(), turn_about_z * Vector3d::UnitZ()}};
    const std::vector<CouplingStiffness> stiffness{{kStiffness_N_per_m, kRotational}};
    auto displacements = ProjectionSolver().project(wanted, stiffness, rows).displacements;
    solver_.solve(wanted, stiffness, rows, std::vector<double>(rows.size(), kCoefficient), displacements, forces_);
    EXPECT_TRUE(solver_.is_settled());
    EXPECT_LT(solver_.evaluations(), 5 * kContacts) << "few contacts share the load";
    double pressed = 0.0;
    for (const RowForce& force : forces_)
      pressed += force.normal;
    EXPECT_NEAR(pressed, kStiffness_N_per_m * kPressed, 1e-6);
    for (const CoupledRow& row : rows)
      EXPECT_GT(row.velocity(std::span(displacements).first(1)), -1e-10);
    return displacements[0];
  }

  FrictionSolver solver_;
  std::vector<RowForce> forces_;
};

TEST_F(FlushRing, SticksWithinTheCone) {
  const geometry::Displacement d = solve({0.9 * kCoefficient * kPressed, 0.0, 0.0}, 0.0);
  EXPECT_LT(d.v.norm(), 1e-9);
  EXPECT_LT(d.w.norm(), 1e-7);
}

TEST_F(FlushRing, SlidesBeyondTheCone) {
  const geometry::Displacement d = solve({0.0, 5.0 * kCoefficient * kPressed, 0.0}, 0.0);
  EXPECT_NEAR(d.v.y(), 4.0 * kCoefficient * kPressed, 1e-8);
}

TEST_F(FlushRing, TurnsAgainstTheTorqueOfAllItsFriction) {
  const double most = kCoefficient * kStiffness_N_per_m * kPressed * kRadius / kRotational;  // rad
  EXPECT_LT(std::abs(solve(Vector3d::Zero(), 0.9 * most).w.z()), 0.01 * most);
  EXPECT_NEAR(solve(Vector3d::Zero(), 2.0 * most).w.z(), most, 0.02 * most);
}

TEST(FrictionSolver, TwoPartsHoldEachOtherByTheSameForce) {
  std::vector<CoupledRow> rows(1);
  rows[0].n = Vector3d::UnitZ();
  rows[0].r.setZero();
  rows[0].bound = 0.0;
  rows[0].part = 1;
  rows[0].other = 0;
  const std::vector<geometry::Displacement> wanted{{{0.0, 0.0, 1e-3}, {0.0, 0.0, 0.0}},
                                                   {{1e-3, 0.0, 0.0}, {0.0, 0.0, 0.0}}};
  const CouplingStiffness hold{kStiffness_N_per_m, 0.5};
  std::array<geometry::Displacement, kMaxParts> displacements{};
  std::vector<RowForce> forces;
  FrictionSolver().solve(wanted, std::vector<CouplingStiffness>{hold, hold}, rows, std::vector<double>{0.2},
                         displacements, forces);
  ASSERT_EQ(forces.size(), 1u);
  EXPECT_NEAR(forces[0].normal, 0.5, 1e-6) << "each yields by half";
  EXPECT_NEAR(displacements[1].v.z(), 0.5e-3, 1e-9);
  EXPECT_NEAR(displacements[0].v.x(), 0.2 * 0.5e-3, 1e-9) << "is dragged along";
  EXPECT_NEAR(displacements[1].v.x(), 1e-3 - 0.2 * 0.5e-3, 1e-9);
}

/// A part between two walls without any room, pulled along them and a tenth as far against one.
TEST(FrictionSolver, ExactFitIsHeldOnlyByThePressingForce) {
  constexpr double kPull = 1e-3;
  constexpr double kCoefficient = 0.5;
  std::vector<CoupledRow> rows;
  for (const double side : {1.0, -1.0}) {
    for (const double along : {-0.02, 0.0, 0.02}) {
      CoupledRow& row = rows.emplace_back();
      row.n = side * Vector3d::UnitX();
      row.r = {-0.01 * side, 0.0, along};
      row.bound = 0.0;
    }
  }
  const std::vector<geometry::Displacement> wanted{{{0.1 * kPull, 0.0, kPull}, {0.0, 0.0, 0.0}}};
  const std::vector<CouplingStiffness> stiffness{{kStiffness_N_per_m, 0.5}};
  std::array<geometry::Displacement, kMaxParts> displacements =
      ProjectionSolver().project(wanted, stiffness, rows).displacements;
  std::vector<RowForce> forces;
  FrictionSolver().solve(wanted, stiffness, rows, std::vector<double>(rows.size(), kCoefficient), displacements,
                         forces);
  // Friction acts at the wall, beside the middle: its torque presses the part's ends against both walls. They do not
  // press more than that.
  const double pressed = kStiffness_N_per_m * 0.1 * kPull;
  double against_walls = 0.0;
  double along_walls = 0.0;
  for (const RowForce& force : forces) {
    against_walls += rows[static_cast<std::size_t>(force.row)].n.x() * force.normal;
    along_walls += force.across_W.z();
  }
  EXPECT_NEAR(against_walls, -pressed, 1e-6 * pressed);
  EXPECT_NEAR(displacements[0].v.x(), 0.0, 1e-10);
  EXPECT_NEAR(along_walls, kStiffness_N_per_m * (displacements[0].v.z() - kPull), 1e-6 * pressed);
  EXPECT_GT(displacements[0].v.z(), 0.0);
  double most = 0.0;
  for (const RowForce& force : forces) {
    EXPECT_NEAR(force.across_W.norm(), kCoefficient * force.normal, 1e-6 * force.normal) << "each contact slips";
    most += force.normal;
  }
  EXPECT_LT(most, 2.0 * pressed);
}

}  // namespace
}  // namespace glissade::contact
