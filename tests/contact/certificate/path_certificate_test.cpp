#include "certificate/path_certificate.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/triangle_pair.h>

#include "random_numbers.h"
#include "sanitizers.h"
#include "search/candidate_pairs.h"

namespace glissade::contact {
namespace {

constexpr double kFloor = 1e-6;
constexpr double kProofReach = 10.0;

std::shared_ptr<const geometry::TriangleMesh> one_triangle(double z) {
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  mesh->vertices = {{-1.0, -1.0, z}, {1.0, -1.0, z}, {0.0, 1.0, z}};
  mesh->triangles = {{0, 1, 2}};
  return mesh;
}

/// Whether all pairs of the bodies are proved apart while each part goes from its pose along its displacement.
bool prove(const std::vector<Obstacle>& obstacles, const std::vector<std::shared_ptr<const SlidingPart>>& parts,
           const std::vector<Eigen::Isometry3d>& X_WV, const std::vector<geometry::Displacement>& displacements) {
  ContactScene scene(obstacles, parts, std::vector<double>(parts.size(), kFloor / kMinClearanceOfMargin));
  for (std::size_t p = 0; p < parts.size(); ++p)
    scene.place(p, X_WV[p]);
  CandidatePairs candidates(scene, kProofReach);
  candidates.look(kProofReach, 0.0, {});
  std::vector<PairToCertify> to_certify;
  PathCertificate certificate(scene);
  WorkBudget unlimited;
  certificate.begin_step(displacements);
  candidates.pairs().unproved_within(kProofReach, certificate, to_certify, unlimited);
  certificate.begin(to_certify);
  EXPECT_TRUE(certificate.go_on(unlimited));
  return certificate.failures().empty();
}

/// A triangle above another one, both without thickness.
class TwoTriangles : public ::testing::Test {
 protected:
  bool proves(const Eigen::Isometry3d& X_WV, const geometry::Displacement& d) {
    return prove(obstacles_, {part_}, {X_WV}, {d});
  }
  static Eigen::Isometry3d at_height(double z) { return Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, z)); }

  std::vector<Obstacle> obstacles_{{std::make_shared<ContactBody>(one_triangle(0.0))}};
  std::shared_ptr<const SlidingPart> part_ = std::make_shared<SlidingPart>(one_triangle(0.0));
};

TEST_F(TwoTriangles, ApproachIsCertifiedOnlyDownToTheMinimumClearance) {
  const geometry::Displacement down{{0.0, 0.0, -1e-3}, Eigen::Vector3d::Zero()};
  EXPECT_TRUE(proves(at_height(1e-3 + 1.01 * kFloor), down));
  EXPECT_FALSE(proves(at_height(1e-3 + 0.99 * kFloor), down));
}

TEST_F(TwoTriangles, PassingThroughIsNotProvedThoughBothEndsAreFree) {
  EXPECT_FALSE(proves(at_height(0.1), {{0.0, 0.0, -0.2}, Eigen::Vector3d::Zero()}));
  EXPECT_TRUE(proves(at_height(0.1), {{0.5, 0.0, 0.2}, Eigen::Vector3d::Zero()}));
}

// Two needles that cross, 2 m long, and turn past each other. Bisection would need a stretch for every direction.
TEST_F(TwoTriangles, NeedlesThatTurnPastEachOtherAreProvedInOneStretch) {
  const auto needle = [](const Eigen::Vector3d& along, double thickness) {
    auto mesh = std::make_shared<geometry::TriangleMesh>();
    mesh->vertices = {-along, along, along + Eigen::Vector3d(0.0, 0.0, thickness)};
    mesh->triangles = {{0, 1, 2}};
    return mesh;
  };
  const std::vector<Obstacle> obstacles{{std::make_shared<ContactBody>(needle(Eigen::Vector3d::UnitY(), -1e-5))}};
  ContactScene scene(obstacles, {std::make_shared<SlidingPart>(needle(Eigen::Vector3d::UnitX(), 1e-5))},
                     std::vector{kFloor / kMinClearanceOfMargin});
  scene.place(0, at_height(4.0 * kFloor) * Eigen::AngleAxisd(-0.002, Eigen::Vector3d::UnitY()));
  MovingBodies bodies(scene);
  bodies.begin_step(std::vector<geometry::Displacement>{{Eigen::Vector3d::Zero(), {0.0, 0.004, 0.0}}});
  TriangleCertificate certificate(bodies, {{0, 1}, 0, 0}, kFloor, 1e-15);
  Eigen::Vector3d n_start;
  EXPECT_TRUE(certificate.prove(Eigen::Vector3d::Zero(), n_start));
  EXPECT_LE(certificate.stretches(), 2);
}

// The part turns in its plane, so that its normal stays, too, but what that may lose between the ends is not known.
TEST_F(TwoTriangles, PlaneFixedToThePartNeedsALargerGapThanOneFixedToTheObstacle) {
  ContactScene scene(obstacles_, std::vector{part_}, std::vector{kFloor / kMinClearanceOfMargin});
  const std::vector<geometry::Displacement> turn{{Eigen::Vector3d::Zero(), {0.0, 0.0, 0.1}}};
  PathCertificate certificate(scene);
  certificate.begin_step(turn);
  const PathOfBodies path = certificate.path_of({0, 1}, BallAboutPart::at(at_height(0.0), part_->tree)).value();
  ASSERT_GT(path.needed_turning, 1.5 * path.needed);
  scene.place(0, at_height(0.5 * (path.needed + path.needed_turning)));
  CandidatePairs candidates(scene, kProofReach);
  candidates.look(kProofReach, 0.0, {});
  for (const bool turns_with_part : {false, true}) {
    candidates.pairs().planes().front().turn(0, {Eigen::Vector3d::UnitZ(), turns_with_part}, scene.bodies());
    WorkBudget unlimited;
    std::vector<PairToCertify> unproved;
    certificate.begin_step(turn);
    candidates.pairs().unproved_within(kProofReach, certificate, unproved, unlimited);
    EXPECT_EQ(unproved.size(), turns_with_part ? 1U : 0U);
  }
}

// One pair for each two bodies: it waits for vector code until the bodies change or the call ends.
TEST_F(TwoTriangles, FailuresAreToldForEachPairOfBodiesInOneCallAndInMany) {
  obstacles_.push_back({std::make_shared<ContactBody>(one_triangle(-0.05))});
  ContactScene scene(obstacles_, std::vector{part_}, std::vector{kFloor / kMinClearanceOfMargin});
  scene.place(0, at_height(0.1));
  CandidatePairs candidates(scene, kProofReach);
  candidates.look(kProofReach, 0.0, {});
  for (const std::int64_t work_of_call : {kUnlimitedWork, std::int64_t{1}}) {
    std::vector<PairToCertify> to_certify;
    PathCertificate certificate(scene);
    WorkBudget unlimited;
    certificate.begin_step(std::vector<geometry::Displacement>{{{0.0, 0.0, -0.2}, Eigen::Vector3d::Zero()}});
    candidates.pairs().unproved_within(kProofReach, certificate, to_certify, unlimited);
    certificate.begin(to_certify);
    int calls = 1;
    for (WorkBudget budget{work_of_call}; !certificate.go_on(budget); budget.left = work_of_call)
      ++calls;
    EXPECT_EQ(calls > 1, work_of_call == 1);
    ASSERT_EQ(certificate.failures().size(), 2U);
    EXPECT_NE(certificate.failures()[0].bodies.obstacle, certificate.failures()[1].bodies.obstacle);
  }
}

TEST_F(TwoTriangles, TurningThroughIsNotProvedThoughBothEndsAreFree) {
  // Half a turn about x sweeps a triangle that stands beside the other through it.
  const geometry::Displacement flip{{0.0, 0.0, 0.0}, {3.0, 0.0, 0.0}};
  EXPECT_FALSE(proves(at_height(0.3), flip));
  EXPECT_TRUE(proves(at_height(3.0), flip));
}

TEST_F(TwoTriangles, PairBelowMinimumClearanceMayHardlyApproach) {
  const double gap = 0.5 * kFloor;
  EXPECT_TRUE(proves(at_height(gap), {{1e-3, 0.0, 0.0}, Eigen::Vector3d::Zero()}));
  EXPECT_TRUE(proves(at_height(gap), {{0.0, 0.0, -0.04 * gap}, Eigen::Vector3d::Zero()}));
  EXPECT_FALSE(proves(at_height(gap), {{0.0, 0.0, -0.06 * gap}, Eigen::Vector3d::Zero()}));
}

// Between the ends of a step, a height along a direction that turns falls below the lesser end by at most what the
// certificate asks for in advance. Some heights fall by most of it.
TEST(PathCertificate, GapNeededByATurningDirectionBoundsItsLossBetweenTheEnds) {
  constexpr std::uint64_t kSeed = 15;
  RecordProperty("seed", static_cast<int>(kSeed));
  test_support::RandomNumbers random(kSeed);
  Eigen::Isometry3d X_WO(Eigen::AngleAxisd(0.8, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()));
  X_WO.translation() = Eigen::Vector3d(0.3, -0.5, 0.2);
  const std::vector<Obstacle> obstacles{{std::make_shared<ContactBody>(one_triangle(0.0)), X_WO}};
  const auto part = std::make_shared<SlidingPart>(one_triangle(0.0));
  ContactScene scene(obstacles, {part}, std::vector{kFloor / kMinClearanceOfMargin});
  scene.set_p_Vref(0, Eigen::Vector3d(0.7, 0.2, -0.4));
  PathCertificate certificate(scene);
  double most = 0.0;  // of what is asked for
  for (int trial = 0; trial < 2000; ++trial) {
    const Eigen::Isometry3d X_WV(Eigen::Translation3d(random.point(0.1)) *
                                 Eigen::AngleAxisd(random.uniform(0.0, 3.0), random.direction()));
    scene.place(0, X_WV);
    const geometry::Displacement d{random.point(0.2), random.uniform(0.0, 1.0) * random.direction()};
    certificate.begin_step(std::vector{d});
    const BallAboutPart ball = BallAboutPart::at(X_WO.inverse() * X_WV, part->tree);
    const std::optional<PathOfBodies> path = certificate.path_of({0, 1}, ball);
    ASSERT_TRUE(path);
    const double asked = path->needed_turning - kFloor;
    const Eigen::Vector3d y_W = X_WO * (ball.center_O + ball.radius * random.direction());
    const Eigen::Vector3d n_V = random.direction();
    const auto height = [&](double t) {
      const Eigen::Isometry3d X = geometry::displaced(X_WV, scene.p_Vref(0), d.scaled(t));
      return -n_V.dot(X.inverse() * y_W);
    };
    const double lesser_end = std::min(height(0.0), height(1.0));
    for (double t = 0.05; t < 1.0; t += 0.05) {
      ASSERT_GE(height(t), lesser_end - asked) << "trial " << trial << ", moment " << t;
      most = std::max(most, (lesser_end - height(t)) / asked);
    }
  }
  EXPECT_GT(most, 0.6);
}

// What was proved must hold at every moment of the way, by the exact predicate and by distance.
TEST(PathCertificate, CertifiedRandomPathsKeepMinimumClearance) {
  constexpr unsigned kSeed = 13;
  constexpr int kTrials = test_support::affordable(2000);
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 generator(kSeed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto random_vector = [&] {
    return Eigen::Vector3d(uniform(generator), uniform(generator), uniform(generator));
  };
  const auto random_triangle = [&] {
    auto mesh = std::make_shared<geometry::TriangleMesh>();
    mesh->vertices = {random_vector(), random_vector(), random_vector()};
    mesh->triangles = {{0, 1, 2}};
    return mesh;
  };
  int proved = 0;
  int refused = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::vector<Obstacle> obstacles{{std::make_shared<ContactBody>(random_triangle())}};
    const auto part = std::make_shared<SlidingPart>(random_triangle());
    const Eigen::Isometry3d X_WV(Eigen::Translation3d(0.7 * random_vector()));
    const geometry::Displacement d{0.5 * random_vector(), random_vector()};
    if (!prove(obstacles, {part}, {X_WV}, {d})) {
      ++refused;
      continue;
    }
    ++proved;
    for (int i = 0; i <= 100; ++i) {
      const Eigen::Isometry3d X = geometry::displaced(X_WV, part->p_Vref(), d.scaled(0.01 * i));
      const auto corner = [&](int c) -> Eigen::Vector3d { return X * part->tree.mesh().corner(0, c); };
      const geometry::TriangleDistance closest =
          geometry::triangle_distance(placed(obstacles[0]).triangle_W(0), {corner(0), corner(1), corner(2)});
      ASSERT_GE(closest.distance, 0.95 * kFloor) << "trial " << trial << " at " << i << " %";
    }
  }
  EXPECT_GT(proved, kTrials / 10);  // neither answer may be the only one
  EXPECT_GT(refused, kTrials / 10);
}

// Directions are fixed to the world then, or turn in it, and both triangles go past them.
TEST(PathCertificate, CertifiedPathsOfTwoPartsKeepMinimumClearance) {
  constexpr unsigned kSeed = 14;
  constexpr int kTrials = test_support::affordable(2000);
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 generator(kSeed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto random_vector = [&] {
    return Eigen::Vector3d(uniform(generator), uniform(generator), uniform(generator));
  };
  const auto random_sliver = [&] {
    auto mesh = std::make_shared<geometry::TriangleMesh>();
    const Eigen::Vector3d along = random_vector();
    mesh->vertices = {-along, along, along + 0.05 * random_vector()};
    mesh->triangles = {{0, 1, 2}};
    return mesh;
  };
  int proved = 0;
  int refused = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<std::shared_ptr<const SlidingPart>> parts;
    std::vector<Eigen::Isometry3d> X_WV;
    std::vector<geometry::Displacement> d;
    for (int p = 0; p < 2; ++p) {
      parts.push_back(std::make_shared<SlidingPart>(random_sliver()));
      X_WV.emplace_back(Eigen::Translation3d(0.2 * random_vector()));
      d.push_back({0.1 * random_vector(), 0.5 * random_vector()});
    }
    if (!prove({}, parts, X_WV, d)) {
      ++refused;
      continue;
    }
    ++proved;
    for (int i = 0; i <= 100; ++i) {
      std::vector<geometry::TrianglePoints> then;
      for (std::size_t p = 0; p < 2; ++p) {
        const Eigen::Isometry3d X = geometry::displaced(X_WV[p], parts[p]->p_Vref(), d[p].scaled(0.01 * i));
        const geometry::TriangleMesh& mesh = parts[p]->tree.mesh();
        then.push_back({X * mesh.corner(0, 0), X * mesh.corner(0, 1), X * mesh.corner(0, 2)});
      }
      ASSERT_GE(geometry::triangle_distance(then[0], then[1]).distance, 0.95 * kFloor)
          << "trial " << trial << " at " << i << " %";
    }
  }
  EXPECT_GT(proved, kTrials / 10);
  EXPECT_GT(refused, kTrials / 10);
}

}  // namespace
}  // namespace glissade::contact
