/// Queries after selected pairs of triangles, against plain loops.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/collision/dop_query.h>
#include <glissade/collision/query_types.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_pair.h>

#include "allocation_counter.h"
#include "expect_bad_input.h"
#include "query/parallel_query.h"
#include "random_numbers.h"
#include "sweeps/sweep_meshes.h"
#include "triangle_points.h"

namespace glissade::collision {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::points_of;
using test_support::RandomNumbers;
using testing::ElementsAreArray;
using testing::IsEmpty;

using Flags = std::vector<char>;

constexpr char kSelected = 1;
constexpr char kHalf = 2;

/// A tree, with marks of its selected and its half selected triangles.
struct Selected {
  Selected(geometry::TriangleMesh triangles, Flags is_selected)
      : mesh(std::make_shared<geometry::TriangleMesh>(std::move(triangles))),
        tree(mesh),
        flags(std::move(is_selected)),
        selection(
            tree, [this](std::int32_t t) { return flags[static_cast<std::size_t>(t)] == kSelected; },
            [this](std::int32_t t) { return flags[static_cast<std::size_t>(t)] == kHalf; }) {}

  std::shared_ptr<geometry::TriangleMesh> mesh;
  DopTree tree;
  Flags flags;
  TriangleSelection selection;
};

/// Selected: none, all, or about a share of the triangles of a mesh; half selected: none or half of the others.
Flags random_flags(const geometry::TriangleMesh& mesh, double share, RandomNumbers& random) {
  const bool has_half = random.chance(0.5);
  Flags flags(mesh.triangles.size());
  for (char& flag : flags)
    flag = random.chance(share) ? kSelected : has_half && random.chance(0.5) ? kHalf : 0;
  return flags;
}

bool is_selected_pair(char a, char b) {
  return a == kSelected || b == kSelected || (a == kHalf && b == kHalf);
}

/// All selected pairs, one after the other.
std::vector<TrianglePair> expected_pairs(const Selected& A, const Selected& B, const Isometry3d& X_AB,
                                         double distance) {
  std::vector<TrianglePair> pairs;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(A.flags.size()); ++i) {
    const geometry::TrianglePoints a = points_of(*A.mesh, i);
    if (geometry::is_degenerate(a)) continue;
    for (std::int32_t j = 0; j < static_cast<std::int32_t>(B.flags.size()); ++j) {
      if (!is_selected_pair(A.flags[static_cast<std::size_t>(i)], B.flags[static_cast<std::size_t>(j)])) continue;
      if (geometry::is_degenerate(points_of(*B.mesh, j))) continue;
      if (geometry::triangle_distance(a, points_of(*B.mesh, j, X_AB)).distance <= distance) pairs.push_back({i, j});
    }
  }
  return pairs;
}

template <typename Workspace>
std::vector<TrianglePair> pairs_found(const Selected& A, const Selected& B, const Isometry3d& X_AB, double distance,
                                      Workspace& workspace) {
  std::vector<ClosePair> found;
  pairs_within(A.tree, B.tree, X_AB, distance, workspace, found, {&A.selection, &B.selection});
  std::vector<TrianglePair> pairs;
  for (const ClosePair& pair : found)
    pairs.push_back(pair.triangles);
  return pairs;
}

Isometry3d pose(const Eigen::Matrix3d& R, const Vector3d& p) {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = R;
  X.translation() = p;
  return X;
}

TEST(TriangleSelection, AnswersTheSelectedPairs) {
  constexpr std::uint64_t kSeed = 71;
  RecordProperty("seed", std::to_string(kSeed));
  RandomNumbers random(kSeed);
  std::size_t all_found = 0;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", meshes " + std::to_string(i));
    geometry::TriangleMesh mesh_A = test_support::random_mesh(1.0, Vector3d::Zero(), random).mesh;
    geometry::TriangleMesh mesh_B = test_support::random_mesh(random.uniform(0.2, 2.0), Vector3d::Zero(), random).mesh;
    const std::vector<double> shares{0.0, 0.03, 0.3, 1.0};
    Flags flags_A = random_flags(mesh_A, shares[static_cast<std::size_t>(i) % 4], random);
    Flags flags_B = random_flags(mesh_B, shares[static_cast<std::size_t>(i) / 4 % 4], random);
    const Selected A(std::move(mesh_A), std::move(flags_A));
    const Selected B(std::move(mesh_B), std::move(flags_B));

    QueryWorkspace fresh;
    CoherentWorkspace remembering;
    ParallelWorkspace shared;
    Isometry3d X_AB = pose(random.rotation(), random.point(0.7));
    for (int frame = 0; frame < 6; ++frame) {
      const double distance = frame % 3 == 0 ? 0.0 : random.power_of_ten(-3.0, -0.7);
      const auto expected = expected_pairs(A, B, X_AB, distance);
      all_found += expected.size();
      ASSERT_THAT(pairs_found(A, B, X_AB, distance, fresh), ElementsAreArray(expected)) << "frame " << frame;
      ASSERT_THAT(pairs_found(A, B, X_AB, distance, remembering), ElementsAreArray(expected)) << "frame " << frame;
      ASSERT_THAT(pairs_found(A, B, X_AB, distance, shared), ElementsAreArray(expected)) << "frame " << frame;
      X_AB = X_AB * pose(Eigen::AngleAxisd(0.01, random.direction()).toRotationMatrix(), random.point(0.02));
    }
  }
  EXPECT_GT(all_found, 10'000U) << "too few to be a test of anything";
}

TEST(TriangleSelection, HasNoEffectIfOneMeshHasNone) {
  const geometry::TriangleMesh torus = geometry::make_torus(0.1, 0.03, 400);
  const Selected none(torus, Flags(torus.triangles.size(), 0));
  const Isometry3d X_AB = pose(Eigen::Matrix3d::Identity(), {0.15, 0.0, 0.0});
  QueryWorkspace workspace;
  std::vector<ClosePair> all;
  std::vector<ClosePair> found;
  pairs_within(none.tree, none.tree, X_AB, 0.01, workspace, all);
  ASSERT_FALSE(all.empty());
  pairs_within(none.tree, none.tree, X_AB, 0.01, workspace, found, {&none.selection, nullptr});
  EXPECT_EQ(found.size(), all.size());
  pairs_within(none.tree, none.tree, X_AB, 0.01, workspace, found, {nullptr, &none.selection});
  EXPECT_EQ(found.size(), all.size());
  pairs_within(none.tree, none.tree, X_AB, 0.01, workspace, found, {&none.selection, &none.selection});
  EXPECT_THAT(found, IsEmpty());
}

// Two finely cut plates lie flush: nothing but their rims is of interest.
TEST(TriangleSelection, UnselectedSubtreesAreSkipped) {
  const geometry::TriangleMesh plate = geometry::make_plate({0.2, 0.2}, 20'000);
  Flags at_rim(plate.triangles.size());
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(at_rim.size()); ++t) {
    for (int c = 0; c < 3; ++c) {
      if (plate.corner(t, c).cwiseAbs().maxCoeff() > 0.0999) at_rim[static_cast<std::size_t>(t)] = 1;
    }
  }
  const Selected A(plate, at_rim);
  const Selected none(plate, Flags(plate.triangles.size(), 0));
  const Isometry3d X_AB = pose(Eigen::Matrix3d::Identity(), {0.0502, 0.0503, 1e-5});
  QueryWorkspace workspace;
  std::vector<ClosePair> pairs;
  pairs_within(A.tree, A.tree, X_AB, 1e-4, workspace, pairs);
  const std::size_t all_pairs = pairs.size();
  const QueryCounters all = workspace.counters();
  const std::size_t rim_pairs = pairs_found(A, A, X_AB, 1e-4, workspace).size();
  EXPECT_GT(all_pairs, 10'000U);
  EXPECT_LT(10 * rim_pairs, all_pairs);
  EXPECT_LT(4 * workspace.counters().node_tests, all.node_tests);
  EXPECT_LT(4 * workspace.counters().triangle_tests, all.triangle_tests);

  CoherentWorkspace remembering;
  pairs_found(A, A, X_AB, 1e-4, remembering);
  EXPECT_LT(4 * remembering.counters().node_tests, all.node_tests);
  pairs_found(none, none, X_AB, 1e-4, workspace);
  EXPECT_EQ(workspace.counters().node_tests, 0);
}

TEST(TriangleSelection, AWorkspaceThatRemembersNoticesAnotherSelection) {
  const geometry::TriangleMesh torus = geometry::make_torus(0.1, 0.03, 400);
  RandomNumbers random(5);
  const Selected some(torus, random_flags(torus, 0.2, random));
  const Selected others(torus, random_flags(torus, 0.2, random));
  const Isometry3d X_AB = pose(Eigen::Matrix3d::Identity(), {0.15, 0.0, 0.0});
  QueryWorkspace fresh;
  CoherentWorkspace remembering;
  const auto found_by = [&](auto& workspace, const PairSelection& selection) {
    std::vector<ClosePair> pairs;
    pairs_within(some.tree, some.tree, X_AB, 0.01, workspace, pairs, selection);
    return pairs.size();
  };
  const std::vector<PairSelection> selections{{&some.selection, &some.selection},
                                              {},
                                              {&others.selection, &some.selection},
                                              {&others.selection, &others.selection},
                                              {}};
  for (const PairSelection& selection : selections)
    EXPECT_EQ(found_by(remembering, selection), found_by(fresh, selection));
  std::vector<ClosePair> pairs;
  pairs_within(some.tree, some.tree, X_AB, 0.01, remembering, pairs, {&some.selection, &some.selection});
  EXPECT_EQ(intersects(some.tree, some.tree, X_AB, remembering), intersects(some.tree, some.tree, X_AB, fresh));
}

TEST(TriangleSelection, ServesATreeThatWasRefitted) {
  geometry::TriangleMesh plate = geometry::make_plate({0.2, 0.2}, 200);
  const std::size_t first = plate.vertices.size();
  const auto corner = static_cast<std::int32_t>(first);
  plate.vertices.insert(plate.vertices.end(), 3, Vector3d::Zero());
  plate.triangles.push_back({corner, corner + 1, corner + 2});  // has no area yet
  Flags flags(plate.triangles.size(), 0);
  flags[17] = 1;
  flags.back() = 1;
  Selected A(plate, flags);
  for (Vector3d& vertex : A.mesh->vertices)
    vertex.z() = vertex.x() * vertex.x();
  A.mesh->vertices[first + 1].x() += 0.01;
  A.mesh->vertices[first + 2].y() += 0.01;
  A.tree.refit();
  const Isometry3d X_AB = pose(Eigen::Matrix3d::Identity(), {0.0, 0.0, 1e-3});
  QueryWorkspace workspace;
  EXPECT_THAT(pairs_found(A, A, X_AB, 2e-3, workspace), ElementsAreArray(expected_pairs(A, A, X_AB, 2e-3)));
}

TEST(TriangleSelection, AllocatesNothingOnceMemoryIsThere) {
  if (!test_support::allocations_are_counted()) GTEST_SKIP() << "allocations cannot be counted here";
  const geometry::TriangleMesh torus = geometry::make_torus(0.1, 0.03, 400);
  RandomNumbers random(6);
  const Selected A(torus, random_flags(torus, 0.2, random));
  QueryWorkspace fresh;
  CoherentWorkspace remembering;
  std::vector<ClosePair> pairs;
  const auto go_to_and_fro = [&] {
    for (int frame = 0; frame < 60; ++frame) {
      const Isometry3d X_AB = pose(Eigen::Matrix3d::Identity(), {0.1 + 0.005 * std::abs(frame - 30), 0.0, 0.0});
      pairs_within(A.tree, A.tree, X_AB, 0.01, fresh, pairs, {&A.selection, &A.selection});
      pairs_within(A.tree, A.tree, X_AB, 0.01, remembering, pairs, {&A.selection, &A.selection});
    }
  };
  for (int i = 0; i < 3; ++i)
    go_to_and_fro();
  const std::int64_t before = test_support::allocations_of_this_thread();
  go_to_and_fro();
  EXPECT_EQ(test_support::allocations_of_this_thread(), before);
}

TEST(TriangleSelection, OfAnotherTreeIsRefused) {
  const DopTree tree(std::make_shared<geometry::TriangleMesh>(geometry::make_plate({0.2, 0.2}, 200)));
  const DopTree larger(std::make_shared<geometry::TriangleMesh>(geometry::make_plate({0.2, 0.2}, 2000)));
  const TriangleSelection selection(larger, [](std::int32_t) { return true; });
  QueryWorkspace fresh;
  CoherentWorkspace remembering;
  ParallelWorkspace shared;
  std::vector<ClosePair> pairs;
  const auto expect_refused = [&](auto& workspace) {
    for (const PairSelection& wrong : {PairSelection{&selection, nullptr}, PairSelection{nullptr, &selection}}) {
      test_support::expect_bad_input(
          [&] { pairs_within(tree, tree, Isometry3d::Identity(), 0.0, workspace, pairs, wrong); }, {"another tree"});
    }
  };
  expect_refused(fresh);
  expect_refused(remembering);
  expect_refused(shared);
}

}  // namespace
}  // namespace glissade::collision
