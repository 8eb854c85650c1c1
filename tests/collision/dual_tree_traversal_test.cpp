// Visits of what is near, for those who take on more than triangles, against plain loops.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/mesh_generators.h>

#include "allocation_counter.h"
#include "mesh_oracle.h"
#include "random_numbers.h"
#include "sanitizers.h"
#include "sweeps/sweep_meshes.h"
#include "tree_triangles.h"

namespace glissade::collision {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::RandomNumbers;
using test_support::triangles_below;

/// Two children that the visitor has taken on.
struct TakenPair {
  TreeChild child_A;
  TreeChild child_B;
};

/// Takes on a share of what it is asked about, and always the same of it.
class Taker final : public DualTreeVisitor {
 public:
  explicit Taker(std::uint64_t sixteenths) : sixteenths_(sixteenths) {}

  bool accepts(const TreeChild& child_A, const TreeChild& child_B) override {
    const std::uint64_t children = (std::uint64_t{child_A.node} << 32U) + child_B.node;
    const std::uint64_t hash =
        (children * 4U + static_cast<std::uint64_t>(child_A.child)) * 4U + static_cast<std::uint64_t>(child_B.child);
    if ((hash * 0x9e3779b97f4a7c15U) >> 60U >= sixteenths_) return false;
    taken.push_back({child_A, child_B});
    return true;
  }
  void visit(const NearTriangles& pair) override { seen.push_back(pair); }
  void visit_below_accepted(const NearTriangles& pair) override { seen_below.push_back(pair); }

  std::vector<TakenPair> taken;
  std::vector<NearTriangles> seen;
  std::vector<NearTriangles> seen_below;

 private:
  std::uint64_t sixteenths_;
};

/// Two random meshes, one of them up to ten times as large as the other, and a pose at which they are close.
struct RandomPair {
  explicit RandomPair(RandomNumbers& random) : A(mesh_of(random)), B(mesh_of(random)), size(std::min(A.size, B.size)) {
    X_AB.linear() = random.rotation();
    X_AB.translation() = A.center + random.point(A.size + B.size) - X_AB.linear() * B.center;
  }
  static test_support::SweepMesh mesh_of(RandomNumbers& random) {
    const double size = random.power_of_ten(-1.0, 0.0);
    return random_mesh(size, random.point(size), random);
  }

  test_support::SweepMesh A;
  test_support::SweepMesh B;
  double size;
  Isometry3d X_AB = Isometry3d::Identity();
  DopTree tree_A{std::make_shared<geometry::TriangleMesh>(A.mesh)};
  DopTree tree_B{std::make_shared<geometry::TriangleMesh>(B.mesh)};
};

/// How often each pair of triangles was seen, or is below what was taken.
std::map<TrianglePair, int> times_answered(const RandomPair& pair, const Taker& visitor) {
  std::map<TrianglePair, int> times;
  for (const NearTriangles& near : visitor.seen)
    ++times[near.triangles];
  for (const TakenPair& taken : visitor.taken) {
    for (const std::int32_t a : triangles_below(pair.tree_A, taken.child_A.node, taken.child_A.child)) {
      for (const std::int32_t b : triangles_below(pair.tree_B, taken.child_B.node, taken.child_B.child))
        ++times[{a, b}];
    }
  }
  return times;
}

class NearVisit : public ::testing::Test {
 protected:
  static constexpr std::uint64_t kSeed = 20;

  NearVisit() : random_(kSeed) { RecordProperty("seed", static_cast<int>(kSeed)); }

  /// In some trials all pairs are measured, in some only those that nothing separates.
  NearDistances random_distances(double within) {
    return {.within = within, .exact_below = within * std::clamp(random_.uniform(-0.2, 1.2), 0.0, 1.0)};
  }

  RandomNumbers random_;
  QueryWorkspace workspace_;
};

/// How far n_A holds two triangles apart.
double gap_along(const Vector3d& n_A, const geometry::TrianglePoints& of_A, const geometry::TrianglePoints& of_B) {
  const auto heights = [&](const geometry::TrianglePoints& points) {
    return std::minmax({n_A.dot(points[0]), n_A.dot(points[1]), n_A.dot(points[2])});
  };
  return heights(of_B).first - heights(of_A).second;
}

TEST_F(NearVisit, VisitorThatAcceptsNothingSeesAllNearPairs) {
  std::size_t measured = 0;
  std::map<Separator, int> separated;
  for (int trial = 0; trial < test_support::affordable(300); ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const RandomPair pair(random_);
    const NearDistances distances =
        random_distances(random_.chance(0.2) ? 0.0 : pair.size * random_.power_of_ten(-3.0, 0.0));
    Taker visitor(0);
    traverse_near(pair.tree_A, pair.tree_B, pair.X_AB, distances, workspace_, visitor);
    const test_support::MeshOracle oracle(pair.A.mesh, pair.B.mesh);
    std::map<TrianglePair, double> missing;
    for (const ClosePair& close : oracle.pairs_within(pair.X_AB, distances.within))
      missing[close.triangles] = close.distance;
    for (const NearTriangles& near : visitor.seen) {
      const geometry::TrianglePoints of_A = oracle.points_A(near.triangles.triangle_A);
      const geometry::TrianglePoints of_B = oracle.points_B(near.triangles.triangle_B, pair.X_AB);
      const double rounding = 1e-12 * (oracle.radius_A() + oracle.radius_B() + pair.X_AB.translation().norm());
      const bool was_missing = missing.erase(near.triangles) == 1;
      ASSERT_LE(near.gap, distances.within * (1.0 + 1e-6));
      ASSERT_GE(near.gap, 0.0);
      ASSERT_LE(near.gap, geometry::triangle_distance(of_A, of_B).distance + rounding);
      if (near.n_A.isZero(0.0)) {
        ASSERT_TRUE(geometry::triangles_intersect(of_A, of_B));
        continue;
      }
      ASSERT_NEAR(near.n_A.norm(), 1.0, 1e-12);
      ASSERT_GE(gap_along(near.n_A, of_A, of_B), near.gap - rounding) << "from A to B";
      if (near.gap < 0.99 * distances.exact_below) {
        ASSERT_TRUE(was_missing) << "or seen twice";
        ASSERT_EQ(near.separator, Separator::kOther);
        ASSERT_NEAR(near.gap, geometry::triangle_distance(of_A, of_B).distance, 1e-6 * pair.size);
        ++measured;
        continue;
      }
      ++separated[near.separator];
      if (near.separator == Separator::kOther) continue;
      const geometry::TrianglePoints& own = near.separator == Separator::kPlaneOfA ? of_A : of_B;
      const Vector3d u = own[1] - own[0];
      const Vector3d v = own[2] - own[0];
      // The normal of a needle is not known well in single precision.
      if (u.cross(v).norm() < 1e-2 * std::max(u.squaredNorm(), v.squaredNorm())) continue;
      for (const Vector3d& edge : {u, v})
        ASSERT_NEAR(near.n_A.dot(edge), 0.0, 1e-3 * edge.norm()) << "it is the normal";
    }
    ASSERT_TRUE(missing.empty()) << missing.begin()->first.triangle_A << ", " << missing.begin()->first.triangle_B
                                 << " at " << missing.begin()->second;
  }
  EXPECT_GT(measured, 5U);
  for (const Separator separator : {Separator::kPlaneOfA, Separator::kPlaneOfB, Separator::kOther})
    EXPECT_GT(separated[separator], 2);
}

TEST_F(NearVisit, EachNearPairIsVisitedOnceOrIsInOneAcceptedNodePair) {
  std::size_t taken = 0;
  std::size_t seen = 0;
  for (int trial = 0; trial < test_support::affordable(300); ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const RandomPair pair(random_);
    const double distance = pair.size * random_.power_of_ten(-3.0, 0.0);
    Taker visitor(static_cast<std::uint64_t>(random_.integer(1, 8)));
    traverse_near(pair.tree_A, pair.tree_B, pair.X_AB, random_distances(distance), workspace_, visitor);
    const std::map<TrianglePair, int> times = times_answered(pair, visitor);
    for (const ClosePair& near : test_support::MeshOracle(pair.A.mesh, pair.B.mesh).pairs_within(pair.X_AB, distance)) {
      const auto found = times.find(near.triangles);
      ASSERT_NE(found, times.end()) << near.triangles.triangle_A << ", " << near.triangles.triangle_B;
      ASSERT_EQ(found->second, 1) << near.triangles.triangle_A << ", " << near.triangles.triangle_B;
    }
    taken += visitor.taken.size();
    seen += visitor.seen.size();
  }
  EXPECT_GT(taken, 5U);
  EXPECT_GT(seen, 20U);
}

TEST_F(NearVisit, SelectedPairsBelowAcceptedNodesAreVisitedOnce) {
  std::size_t below = 0;
  for (int trial = 0; trial < test_support::affordable(300); ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const RandomPair pair(random_);
    const double distance = pair.size * random_.power_of_ten(-3.0, 0.0);
    const auto is_selected = [](std::int32_t triangle) { return triangle % 3 == 0; };
    const TriangleSelection of_A(pair.tree_A, is_selected);
    const TriangleSelection of_B(pair.tree_B, is_selected);
    const auto some = static_cast<std::uint64_t>(random_.integer(1, 8));
    const NearDistances distances = random_distances(distance);
    Taker without(some);
    traverse_near(pair.tree_A, pair.tree_B, pair.X_AB, distances, workspace_, without);
    ASSERT_TRUE(without.seen_below.empty());
    Taker visitor(some);
    const PairSelection selection{&of_A, &of_B};
    traverse_near(pair.tree_A, pair.tree_B, pair.X_AB, distances, workspace_, visitor, &selection);
    ASSERT_EQ(visitor.seen.size(), without.seen.size());
    std::map<TrianglePair, int> times;
    for (const NearTriangles& near : visitor.seen)
      ++times[near.triangles];
    for (const NearTriangles& near : visitor.seen_below) {
      ASSERT_TRUE(is_selected(near.triangles.triangle_A) || is_selected(near.triangles.triangle_B));
      ++times[near.triangles];
    }
    for (const ClosePair& near : test_support::MeshOracle(pair.A.mesh, pair.B.mesh).pairs_within(pair.X_AB, distance)) {
      if (!is_selected(near.triangles.triangle_A) && !is_selected(near.triangles.triangle_B)) continue;
      ASSERT_EQ(times[near.triangles], 1) << near.triangles.triangle_A << ", " << near.triangles.triangle_B;
    }
    below += visitor.seen_below.size();
  }
  EXPECT_GT(below, 20U);
}

// One pair alone is measured by scalar code, many by vector code.
TEST_F(NearVisit, CrossingTrianglesHaveZeroDirectionAndGap) {
  const geometry::TriangleMesh lying{{{-1.0, -1.0, 0.0}, {1.0, -1.0, 0.0}, {0.1, 1.3, 0.0}}, {{0, 1, 2}}};
  const geometry::TriangleMesh standing{{{0.1, -0.3, -0.7}, {0.2, -0.2, 0.9}, {0.3, 0.4, 0.8}}, {{0, 1, 2}}};
  for (const int copies : {1, 4}) {
    const std::vector<geometry::TriangleMesh> many(static_cast<std::size_t>(copies), standing);
    const DopTree tree_A(std::make_shared<geometry::TriangleMesh>(lying));
    const DopTree tree_B(std::make_shared<geometry::TriangleMesh>(geometry::merge(many)));
    Taker visitor(0);
    traverse_near(tree_A, tree_B, Isometry3d::Identity(), {0.1, 0.1}, workspace_, visitor);
    ASSERT_EQ(visitor.seen.size(), static_cast<std::size_t>(copies));
    for (const NearTriangles& near : visitor.seen) {
      EXPECT_EQ(near.n_A, Vector3d(Vector3d::Zero()));
      EXPECT_EQ(near.gap, 0.0);
    }
  }
}

TEST_F(NearVisit, HasUnitDirectionsAtPosesThatAreNotQuiteRigid) {
  const DopTree large(std::make_shared<geometry::TriangleMesh>(geometry::make_sphere(1.0, 500)));
  const DopTree small(std::make_shared<geometry::TriangleMesh>(geometry::make_sphere(0.5, 500)));
  Isometry3d X_AB(Eigen::Translation3d(1.52, 0.1, 0.0) * Eigen::AngleAxisd(0.3, Vector3d::UnitZ()));
  X_AB.linear()(0, 1) += 2e-4;
  for (const bool is_large_first : {true, false}) {
    Taker visitor(0);
    traverse_near(is_large_first ? large : small, is_large_first ? small : large, X_AB, {0.1, 0.01}, workspace_,
                  visitor);
    ASSERT_FALSE(visitor.seen.empty());
    for (const NearTriangles& near : visitor.seen)
      ASSERT_NEAR(near.n_A.norm(), 1.0, 1e-12);
  }
}

TEST_F(NearVisit, RefusesInvalidDistances) {
  const DopTree plate(std::make_shared<geometry::TriangleMesh>(geometry::make_plate({1.0, 1.0}, 20)));
  Taker visitor(0);
  for (const NearDistances& distances : {NearDistances{-1.0, 0.1}, NearDistances{0.1, -1.0},
                                         NearDistances{0.1, std::numeric_limits<double>::quiet_NaN()}}) {
    EXPECT_THROW(traverse_near(plate, plate, Isometry3d::Identity(), distances, workspace_, visitor),
                 std::invalid_argument);
  }
}

TEST_F(NearVisit, AcceptedNodePairsAreNotOpened) {
  const DopTree plate(std::make_shared<geometry::TriangleMesh>(geometry::make_plate({1.0, 1.0}, 2000)));
  Taker all(16);
  traverse_near(plate, plate, Isometry3d(Eigen::Translation3d(0.0, 0.0, 1e-3)), {2e-3, 2e-3}, workspace_, all);
  EXPECT_TRUE(all.seen.empty());
  EXPECT_LE(all.taken.size(), 16U) << "the children of the roots";
  EXPECT_EQ(workspace_.counters().triangle_tests, 0);
}

TEST_F(NearVisit, DistantBodiesCauseNoVisits) {
  const DopTree plate(std::make_shared<geometry::TriangleMesh>(geometry::make_plate({1.0, 1.0}, 200)));
  Taker visitor(8);
  traverse_near(plate, plate, Isometry3d(Eigen::Translation3d(0.0, 0.0, 3.0)), {0.5, 0.5}, workspace_, visitor);
  EXPECT_TRUE(visitor.taken.empty());
  EXPECT_TRUE(visitor.seen.empty());
}

TEST_F(NearVisit, AllocatesNothingOnceTheWorkspaceHasGrown) {
  if (!test_support::allocations_are_counted()) GTEST_SKIP() << "a sanitizer has its own allocator";
  /// Counts, so that it needs no memory of its own.
  class Counter final : public DualTreeVisitor {
   public:
    bool accepts(const TreeChild& child_A, const TreeChild& child_B) override {
      return (child_A.node + child_B.node + static_cast<std::uint32_t>(child_A.child)) % 7 == 6;
    }
    void visit(const NearTriangles& /*pair*/) override { ++seen; }
    int seen = 0;
  } counter;
  const DopTree sphere(std::make_shared<geometry::TriangleMesh>(geometry::make_sphere(1.0, 3000)));
  const Isometry3d X_AB(Eigen::Translation3d(1.9, 0.1, 0.2));
  traverse_near(sphere, sphere, X_AB, {0.01, 0.005}, workspace_, counter);
  EXPECT_GT(counter.seen, 0);
  const std::int64_t before = test_support::allocations_of_this_thread();
  traverse_near(sphere, sphere, X_AB, {0.01, 0.005}, workspace_, counter);
  EXPECT_EQ(test_support::allocations_of_this_thread() - before, 0);
}

}  // namespace
}  // namespace glissade::collision
