#include <cstddef>
#include <functional>
#include <memory>
#include <span>

#include <gtest/gtest.h>

#include <glissade/collision/convex_hull.h>
#include <glissade/collision/dop_tree.h>
#include <glissade/collision/query_types.h>
#include <glissade/collision/world.h>
#include <glissade/geometry/mesh_generators.h>

#include "assertions.h"
#include "expect_bad_input.h"
#include "hull/gjk_simplex.h"
#include "pipeline/broad_phase.h"
#include "pipeline/interest_matrix.h"
#include "pipeline/pair_table.h"

namespace glissade::collision {
namespace {

using test_support::expect_bad_input;
using CollisionPreconditions = test_support::Preconditions;

const std::shared_ptr<const geometry::TriangleMesh> kNoMesh;

std::shared_ptr<const geometry::TriangleMesh> a_box() {
  return std::make_shared<const geometry::TriangleMesh>(geometry::make_box({1, 1, 1}, 12));
}

TEST(MissingArguments, AreRefusedByTrees) {
  expect_bad_input([] { const DopTree tree(kNoMesh); }, {"needs a mesh"});
  const DopTree tree(a_box());
  expect_bad_input([&] { const TriangleSelection selection(tree, std::function<bool(std::int32_t)>()); },
                   {"needs a function"});
}

TEST(MissingArguments, AreRefusedByTheTreeCache) {
  expect_bad_input([] { read_tree_cache("no_such_file", kNoMesh); }, {"without the mesh"});
  expect_bad_input([] { read_tree_cache_bytes(std::span<const std::byte>(), kNoMesh); }, {"without the mesh"});
  expect_bad_input([] { load_or_build_tree("no_such_file", kNoMesh); }, {"without the mesh"});
}

TEST(MissingArguments, AreRefusedByHullsAndWorlds) {
  expect_bad_input([] { const ConvexHull hull(geometry::TriangleMesh{}); }, {"no points"});
  expect_bad_input(
      [] {
        World world(1);
        world.add({});
      },
      {"needs a tree"});
}

TEST_F(CollisionPreconditions, NumbersOfATreeAreInRange) {
  const DopTree tree(a_box());
  EXPECT_DEATH(tree.node(static_cast<std::uint32_t>(tree.node_count())), "number < ");
  EXPECT_DEATH(tree.triangles_of_leaf(static_cast<std::uint32_t>(tree.leaf_count())), "leaf < ");
}

TEST_F(CollisionPreconditions, HullMemoryBelongsToItsHulls) {
  const ConvexHull hull(*a_box());
  HullMemory memory;
  memory.corner_B = 8;
  EXPECT_DEATH(hulls_apart(hull, hull, Eigen::Isometry3d::Identity(), memory), "belongs_to");
  GjkSimplex simplex;
  EXPECT_DEATH(simplex.reduce_to_nearest(), "count_ > 0");
}

TEST_F(CollisionPreconditions, SlotsHaveObjects) {
  World world(2);
  world.add({.tree = std::make_shared<const DopTree>(a_box())});
  world.take_changes();
  EXPECT_DEATH(world.is_enabled(0, 1), "slot_b");
  EXPECT_DEATH(world.is_enabled(2, 0), "slot_a");
  EXPECT_DEATH(InterestMatrix().is_enabled(0, 64, 1, 0), "group_a");

  BroadPhase broad_phase(2);
  EXPECT_DEATH(broad_phase.remove(0), "slot");
  EXPECT_DEATH(broad_phase.set(0, Eigen::AlignedBox3d()), "isEmpty");
}

TEST_F(CollisionPreconditions, PairsAreTracked) {
  PairTable pairs;
  const PairTable::Number number = pairs.add({0, 1});
  EXPECT_DEATH(pairs.number_of({0, 2}), "found");
  EXPECT_DEATH(pairs.remove(number + 1), "number < ");
  pairs.remove(number);
  EXPECT_DEATH(pairs.remove(number), "slots");
}

}  // namespace
}  // namespace glissade::collision
