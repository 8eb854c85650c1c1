// Proofs of whole meshes by boxes: what is proved is true by brute force, and faces that slide flush are proved however
// finely they are cut.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>

#include "certificate/path_certificate.h"
#include "held_part.h"
#include "near_bodies.h"
#include "poses.h"
#include "sanitizers.h"
#include "search/candidate_pairs.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::RandomNumbers;

/// What came of trying to prove a step.
struct Proof {
  bool holds;
  std::size_t to_certify;
  std::size_t boxes;  ///< of the to_certify, pairs of boxes
  std::vector<UncertifiedPair> failures;
};

/// Tries to prove that each part goes free from its place along its displacement.
Proof prove(const ContactScene& scene, const std::vector<geometry::Displacement>& displacements) {
  double radius = kMinClearanceOfMargin * kGreatestMargin_m;
  for (std::size_t p = 0; p < displacements.size(); ++p)
    radius += geometry::motion_bound(displacements[p], scene.movers()[p]->radius());
  CandidatePairs candidates(scene, radius);
  candidates.look(radius, 0.0, {});
  std::vector<PairToCertify> to_certify;
  candidates.pairs().within(radius, to_certify);
  const auto boxes = std::count_if(to_certify.begin(), to_certify.end(), [](const PairToCertify& pair_to_certify) {
    return pair_to_certify.item_O.kind != TreeItem::Kind::kTriangle;
  });
  PathCertificate certificate(scene);
  WorkBudget unlimited;
  certificate.begin_step(displacements);
  std::vector<PairToCertify> unproved;
  candidates.pairs().unproved_within(radius, certificate, unproved, unlimited);
  certificate.begin(unproved);
  EXPECT_TRUE(certificate.go_on(unlimited));
  const std::vector<UncertifiedPair>& failures = certificate.failures();
  return {failures.empty(), to_certify.size(), static_cast<std::size_t>(boxes), failures};
}

/// The first pair of triangles that comes nearer than it may on a path, and when; empty if none does.
std::string what_comes_too_near(const ContactScene& scene, const std::vector<geometry::Displacement>& displacements) {
  constexpr int kMoments = 25;
  constexpr double kRounding = 1e-13;
  const std::vector<PlacedBody> start(scene.bodies().begin(), scene.bodies().end());
  for (int i = 0; i <= kMoments; ++i) {
    std::vector<PlacedBody> bodies = start;
    for (std::size_t p = 0; p < displacements.size(); ++p) {
      Isometry3d& X_WV = bodies[scene.body_of_mover(p)].X_WB;
      X_WV = geometry::displaced(X_WV, scene.p_Vref(p), displacements[p].scaled(1.0 * i / kMoments));
    }
    // All have the same margin.
    const double floor = scene.min_clearance(0, static_cast<std::int32_t>(scene.body_of_mover(0)));
    for (const auto& [pair, distance] :
         test_support::near_triangles(bodies, scene.obstacles().size(), floor - kRounding)) {
      if (distance >= 0.95 * test_support::distance_of(start, pair) - kRounding) continue;
      return std::to_string(pair.obstacle_triangle) + " of body " + std::to_string(pair.bodies.obstacle) + " and " +
             std::to_string(pair.part_triangle) + " of body " + std::to_string(pair.bodies.part) + " are " +
             std::to_string(distance / floor) + " floors apart at moment " + std::to_string(i);
    }
  }
  return "";
}

/// About as long as the parts are far from each other, so that both proofs and refusals occur; seldom a large turn.
geometry::Displacement random_displacement(double gap, double radius, RandomNumbers& random) {
  const double length = gap * random.power_of_ten(-1.0, 1.5);
  const double angle = random.chance(0.3) ? random.uniform(0.0, 1.0) : random.power_of_ten(-1.0, 1.0) * gap / radius;
  return {length * random.direction(), random.chance(0.2) ? Vector3d(Vector3d::Zero()) : angle * random.direction()};
}

TEST(PathCertificate, CertifiedPathsOfRandomMeshesKeepMinimumClearance) {
  constexpr std::uint64_t kSeed = 51;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomNumbers random(kSeed);
  int proved = 0;
  int refused = 0;
  int near = 0;  // proved though they might have met, by how far they went
  for (int trial = 0; trial < test_support::affordable(200); ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const double margin = random.power_of_ten(-5.0, -3.7);
    const double gap = margin * random.uniform(0.2, 4.0);
    const auto scene = test_support::random_contact_scene(0.02, margin, gap, random);
    for (int step = 0; step < 5; ++step) {
      std::vector<geometry::Displacement> displacements;
      double motion = 0.0;
      for (const auto& part : scene->movers()) {
        displacements.push_back(random_displacement(gap, part->radius(), random));
        if (random.chance(0.2)) displacements.back() = {};
        motion += geometry::motion_bound(displacements.back(), part->radius());
      }
      const Proof proof = prove(*scene, displacements);
      ++(proof.holds ? proved : refused);
      if (!proof.holds) continue;
      near += proof.to_certify > 0 && motion > gap ? 1 : 0;
      ASSERT_EQ(what_comes_too_near(*scene, displacements), "") << "step " << step;
    }
  }
  EXPECT_GT(refused, 5);
  EXPECT_GT(proved, 20);
  EXPECT_GT(near, 5);
}

// The planes that a step leaves serve for the next ones. Parts turn far about points of their own, so that a plane that
// turns with them may lose much between the ends of a step.
TEST(PathCertificate, PathsCertifiedByEarlierPlanesKeepMinimumClearance) {
  constexpr std::uint64_t kSeed = 52;
  constexpr double kRadius = 10e-3;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomNumbers random(kSeed);
  int proved = 0;
  int by_turning_planes = 0;  // pairs that planes prove which turn with the part
  for (int trial = 0; trial < test_support::affordable(300); ++trial) {
    const auto scene = test_support::random_contact_scene(0.02, 1e-4, 3e-4, random);
    for (std::size_t p = 0; p < scene->movers().size(); ++p)
      scene->set_p_Vref(p, scene->movers()[p]->p_Vref() + random.point(0.01));
    CandidatePairs candidates(*scene, kRadius);
    PathCertificate certificate(*scene);
    WorkBudget unlimited;
    candidates.look(kRadius, 0.0, {});
    for (int step = 0; step < 6; ++step) {
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial) + ", step " +
                   std::to_string(step));
      std::vector<geometry::Displacement> displacements;
      double reach = kMinClearanceOfMargin * kGreatestMargin_m;
      for (std::size_t p = 0; p < scene->movers().size(); ++p) {
        displacements.push_back(
            {random.uniform(0.0, 2e-4) * random.direction(), random.uniform(0.0, 0.05) * random.direction()});
        reach += geometry::motion_bound(displacements.back(), scene->lever(p));
      }
      if (!candidates.covers(reach)) break;
      certificate.begin_step(displacements);
      std::vector<PairToCertify> unproved;
      candidates.pairs().unproved_within(reach, certificate, unproved, unlimited);
      std::size_t turning = 0;
      for (const PlanesOfBodies& planes : candidates.pairs().planes()) {
        for (std::size_t slot = 0; slot < planes.numbers().size(); ++slot)
          turning += planes.block(slot / kPlanesAtOnce).turns_with_part[slot % kPlanesAtOnce] > 0.0F ? 1U : 0U;
      }
      certificate.begin(unproved);
      ASSERT_TRUE(certificate.go_on(unlimited));
      candidates.pairs().note_planes(certificate.separated());
      if (!certificate.failures().empty()) continue;
      ++proved;
      by_turning_planes += static_cast<int>(turning);
      ASSERT_EQ(what_comes_too_near(*scene, displacements), "");
      for (std::size_t p = 0; p < displacements.size(); ++p) {
        const Isometry3d& X_WV = scene->bodies()[scene->body_of_mover(p)].X_WB;
        scene->place(p, geometry::displaced(X_WV, scene->p_Vref(p), displacements[p]));
      }
      candidates.moved();
    }
  }
  EXPECT_GT(proved, test_support::affordable(50));
  EXPECT_GT(by_turning_planes, 0);
}

/// A finely cut plate of 100 × 60 mm over a larger one, both in parallel planes.
class FinePlates : public ::testing::Test {
 protected:
  static constexpr double kMargin = 4e-6;
  static constexpr double kHalfLength = 0.05;

  static ContactScene at_height(double z) {
    static const Obstacle kTable = test_support::obstacle_of(geometry::make_plate({0.5, 0.5}, 4000));
    static const auto kPart = test_support::part_of(geometry::make_plate({2.0 * kHalfLength, 0.06}, 4000));
    ContactScene scene({kTable}, {kPart}, std::vector<double>{kMargin});
    scene.place(0, test_support::pose({0.02, 0.01, z}, test_support::turn(0.3, Vector3d::UnitZ())));
    return scene;
  }
  static double floor() { return kMinClearanceOfMargin * kMargin; }
};

TEST_F(FinePlates, FlushSlidingOneMarginApartIsCertifiedByAFewBoxPairs) {
  const Proof proof = prove(at_height(kMargin), {{{1e-3, 2e-3, 0.0}, {0.0, 0.0, 0.01}}});
  EXPECT_TRUE(proof.holds);
  EXPECT_LE(proof.to_certify, 16U) << "of 16 million pairs of triangles: the children of the roots";
  EXPECT_EQ(proof.boxes, proof.to_certify);
}

TEST_F(FinePlates, ApproachBelowMinimumClearanceIsNotCertified) {
  const double h = kMargin - floor();
  EXPECT_TRUE(prove(at_height(kMargin), {{{1e-4, 0.0, -0.999 * h}, Vector3d::Zero()}}).holds);
  const Proof proof = prove(at_height(kMargin), {{{1e-4, 0.0, -1.001 * h}, Vector3d::Zero()}});
  EXPECT_FALSE(proof.holds);
  ASSERT_FALSE(proof.failures.empty());
  EXPECT_NEAR(proof.failures.front().n_W.z(), 1.0, 1e-9) << "from the obstacle to the part";
}

// The boxes are taken as a whole where they are now, and one end of the part comes near.
TEST_F(FinePlates, TiltIsCertifiedWhileTheLowestCornerKeepsMinimumClearance) {
  const double z = 20e-6;
  const ContactScene scene = at_height(z);
  const Vector3d across = test_support::turn(0.3, Vector3d::UnitZ()) * Vector3d::UnitY();  // the part's y axis
  const double angle = std::asin((z - floor()) / kHalfLength);
  EXPECT_TRUE(prove(scene, {{Vector3d::Zero(), 0.999 * angle * across}}).holds);
  const Proof proof = prove(scene, {{Vector3d::Zero(), 1.001 * angle * across}});
  EXPECT_EQ(proof.boxes, proof.to_certify) << "nothing but boxes";
  EXPECT_FALSE(proof.holds);
  for (const UncertifiedPair& failure : proof.failures) {
    const geometry::TriangleMesh& mesh = scene.movers()[0]->tree.mesh();
    double farthest = 0.0;
    for (int corner = 0; corner < 3; ++corner)
      farthest = std::max(farthest, mesh.corner(failure.part_triangle, corner).x());
    EXPECT_NEAR(farthest, kHalfLength, 1e-9) << "only triangles of the side that comes down";
  }
}

// A rod turns about its middle above a table: at both ends of the step its tip is high, in between it is lower by
// ρ (1 − cos(θ/2)).
TEST(PathCertificate, TipLowestInMidSwingIsNotCertifiedByItsEndPoses) {
  constexpr double kMargin = 0.1e-3;
  constexpr double kTurn = 0.2;  // radians
  const Obstacle table = test_support::obstacle_of(geometry::make_plate({1.0, 1.0}, 100));
  const auto rod = test_support::part_of(geometry::make_plate({0.2, 1e-4}, 200));
  const auto proves = [&](double height) {
    ContactScene scene({table}, {rod}, std::vector<double>{kMargin});
    scene.place(0, test_support::pose({0.0, 0.0, height},
                                      test_support::turn(0.5 * (std::numbers::pi - kTurn), Vector3d::UnitY())));
    return prove(scene, {{Vector3d::Zero(), kTurn * Vector3d::UnitY()}}).holds;
  };
  const double radius = rod->radius();
  const double floor = kMinClearanceOfMargin * kMargin;
  EXPECT_FALSE(proves(radius * std::cos(0.5 * kTurn) + 1.1 * floor)) << "free at both ends only";
  EXPECT_FALSE(proves(radius + 0.9 * floor));
  EXPECT_TRUE(proves(radius + 1.1 * floor));
}

TEST(PathCertificate, OfTwoPartsCountsTheMotionOfBoth) {
  constexpr double kMargin = 0.1e-3;
  const Obstacle table = test_support::obstacle_of(geometry::make_plate({1.0, 1.0}, 2));
  // Flat, so that boxes tell it, and no triangle is asked.
  const auto plate = test_support::part_of(geometry::make_plate({0.02, 0.02}, 500));
  ContactScene scene({table}, {plate, plate}, std::vector<double>{kMargin, kMargin});
  const double gap = 1e-3;
  scene.place(0, test_support::pose({0.0, 0.0, 0.5}));
  scene.place(1, test_support::pose({0.0, 0.0, 0.5 + gap}));
  const double most = gap - kMinClearanceOfMargin * kMargin;
  const auto proves = [&](double first, double second) {
    return prove(scene, {{{0.0, 0.0, first}, Vector3d::Zero()}, {{0.0, 0.0, second}, Vector3d::Zero()}}).holds;
  };
  EXPECT_TRUE(proves(0.499 * most, -0.499 * most));
  EXPECT_FALSE(proves(0.501 * most, -0.501 * most));
  EXPECT_TRUE(proves(10.0 * most, 10.0 * most)) << "one follows the other";
  EXPECT_FALSE(proves(1.01 * most, 0.0));
  EXPECT_TRUE(proves(0.99 * most, 0.0));
}

}  // namespace
}  // namespace glissade::contact
