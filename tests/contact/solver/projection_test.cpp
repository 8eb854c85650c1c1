#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/projection.h>

namespace glissade::contact {
namespace {

const CouplingStiffness kProjectedStiffness{1000.0, 2.5};

ConstraintRow floor_at(double height, const Eigen::Vector3d& r = Eigen::Vector3d::Zero()) {
  return {Eigen::Vector3d::UnitZ(), r, -height};
}

TEST(Projection, LeavesAnUnhinderedDisplacementAsItIs) {
  const geometry::Displacement wanted{{1e-3, 2e-3, -3e-3}, {0.01, 0.02, 0.03}};
  const std::vector<ConstraintRow> rows{floor_at(4e-3)};
  const Projection<1> result = ProjectionSolver().project(wanted, kProjectedStiffness, rows);
  EXPECT_EQ(result.status, ProjectionStatus::kSolved);
  EXPECT_EQ(result.active_count, 0);
  EXPECT_TRUE(result.displacement().stacked().isApprox(wanted.stacked(), 1e-14));
}

TEST(Projection, SlidesAlongAFloorAndReportsTheContactForce) {
  const geometry::Displacement wanted{{1e-3, 0.0, -3e-3}, Eigen::Vector3d::Zero()};
  const std::vector<ConstraintRow> rows{floor_at(1e-3)};
  const Projection<1> result = ProjectionSolver().project(wanted, kProjectedStiffness, rows);
  EXPECT_TRUE(result.displacement().v.isApprox(Eigen::Vector3d(1e-3, 0.0, -1e-3), 1e-12));
  ASSERT_EQ(result.active_count, 1);
  EXPECT_NEAR(result.force[0], 1000.0 * 2e-3, 1e-9);  // k_t times the 2 mm that were refused
}

TEST(Projection, TurnsAboutAnEccentricContactAsTheStiffnessesAllow) {
  // Minimise k_t (z + d)² + k_r θ² with z + a θ ≥ 0 by hand: the force is d / (1/k_t + a²/k_r).
  const double a = 0.05;
  const double d = 1e-3;
  const std::vector<ConstraintRow> rows{floor_at(0.0, {0.0, a, 0.0})};  // rotation about x lifts the contact point
  const Projection<1> result =
      ProjectionSolver().project({{0.0, 0.0, -d}, Eigen::Vector3d::Zero()}, kProjectedStiffness, rows);
  const double force = d / (1.0 / kProjectedStiffness.translational + a * a / kProjectedStiffness.rotational);
  ASSERT_EQ(result.active_count, 1);
  EXPECT_NEAR(result.force[0], force, 1e-9);
  EXPECT_NEAR(result.displacement().w.x(), force * a / kProjectedStiffness.rotational, 1e-12);
}

TEST(Projection, ReportsInfeasibleConstraints) {
  const std::vector<ConstraintRow> rows{{Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero(), 1e-3},
                                        {-Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero(), 1e-3}};
  EXPECT_EQ(ProjectionSolver().project({}, kProjectedStiffness, rows).status, ProjectionStatus::kInfeasible);
}

// The optimality conditions of Karush, Kuhn and Tucker are sufficient for a convex programme, so they are an oracle.
TEST(Projection, MeetsTheOptimalityConditionsOnRandomProgrammes) {
  constexpr unsigned kSeed = 11;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 generator(kSeed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto random_vector = [&] {
    return Eigen::Vector3d(uniform(generator), uniform(generator), uniform(generator));
  };
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<ConstraintRow> rows;
    const int count = 1 + trial % 60;
    for (int i = 0; i < count; ++i) {
      rows.push_back({random_vector().normalized(), 0.05 * random_vector(), -1e-4 * std::abs(uniform(generator))});
      if (i % 5 == 4) rows.push_back(rows.back());  // repeated rows are common in practice
    }
    const geometry::Displacement wanted{1e-3 * random_vector(), 0.02 * random_vector()};
    const Projection<1> result = ProjectionSolver().project(wanted, kProjectedStiffness, rows);
    ASSERT_EQ(result.status, ProjectionStatus::kSolved) << "trial " << trial;
    for (const ConstraintRow& row : rows) {
      ASSERT_GE(row.velocity(result.displacement()), row.bound - 1e-11) << "trial " << trial;
    }
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    Eigen::Vector3d torque = Eigen::Vector3d::Zero();
    for (int j = 0; j < result.active_count; ++j) {
      const auto slot = static_cast<std::size_t>(j);
      const ConstraintRow& row = rows[static_cast<std::size_t>(result.active[slot])];
      EXPECT_GE(result.force[slot], 0.0);
      EXPECT_NEAR(row.velocity(result.displacement()), row.bound, 1e-11);
      force += result.force[slot] * row.n;
      torque += result.force[slot] * row.r.cross(row.n);
    }
    EXPECT_LT((kProjectedStiffness.translational * (result.displacement().v - wanted.v) - force).norm(), 1e-8)
        << "trial " << trial;
    EXPECT_LT((kProjectedStiffness.rotational * (result.displacement().w - wanted.w) - torque).norm(), 1e-9)
        << "trial " << trial;
  }
}

}  // namespace
}  // namespace glissade::contact
