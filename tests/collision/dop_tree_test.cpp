/// The tree as a whole: how it is made, what it refuses, and how it follows a mesh that moves.

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <glissade/collision/dop_tree.h>
#include <glissade/geometry/mesh_generators.h>

#include "allocation_counter.h"
#include "expect_bad_input.h"
#include "same_tree.h"
#include "sanitizers.h"
#include "tree/tree_nodes.h"
#include "tree_answers.h"

namespace glissade::collision {
namespace {

using Eigen::Vector3d;
using test_support::expect_bad_input;

constexpr int kDirections[] = {6, 14, 18, 24, 26};

std::shared_ptr<geometry::TriangleMesh> shared(geometry::TriangleMesh mesh) {
  return std::make_shared<geometry::TriangleMesh>(std::move(mesh));
}

/// The first `count` triangles of a torus.
std::shared_ptr<geometry::TriangleMesh> piece_of_torus(std::size_t count) {
  geometry::TriangleMesh mesh = geometry::make_torus(0.1, 0.03, 400);
  mesh.triangles.resize(count);
  return shared(std::move(mesh));
}

/// What may happen to the vertices of a plate of 0.4 m × 0.3 m.
struct Motion {
  std::string name;
  Vector3d (*moved)(const Vector3d& x, std::mt19937& random);
};

double uniform(std::mt19937& random) {
  return std::uniform_real_distribution<double>(-1.0, 1.0)(random);
}

const Motion kMotions[] = {
    {"bend",
     [](const Vector3d& x, std::mt19937&) -> Vector3d {
       return {x.x(), x.y(), 2.0 * x.x() * x.x()};
     }},
    {"roll",
     [](const Vector3d& x, std::mt19937&) -> Vector3d {
       return {0.1 * std::sin(x.x() / 0.1), x.y(), 0.1 * std::cos(x.x() / 0.1)};
     }},
    {"scatter",
     [](const Vector3d& x, std::mt19937& random) -> Vector3d {
       return x + 0.2 * Vector3d(uniform(random), uniform(random), uniform(random));
     }},
    {"grow", [](const Vector3d& x, std::mt19937&) -> Vector3d { return 20.0 * x; }},
    {"shrink", [](const Vector3d& x, std::mt19937&) -> Vector3d { return 1e-3 * x; }},
    {"shift", [](const Vector3d& x, std::mt19937&) -> Vector3d { return x + Vector3d(1e3, -1e3, 1e3); }},
    // All between the two lines collapses on them.
    {"fold",
     [](const Vector3d& x, std::mt19937&) -> Vector3d {
       return {x.x() < -0.1 ? x.x() : x.x() < 0.1 ? -0.1 : x.x() - 0.2, x.y(), x.z()};
     }},
};

void move(geometry::TriangleMesh& mesh, const std::vector<Vector3d>& vertices, const Motion& motion) {
  std::mt19937 random(20);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    mesh.vertices[i] = motion.moved(vertices[i], random);
}

TEST(DopTreeRefit, AnswersStayExactWhateverTheVerticesDo) {
  std::vector<DopTreeOptions> all_options{{.thin_slab = false}, {.realignment = Realignment::kBruteForce}};
  for (const int k : kDirections)
    all_options.push_back({.directions = k});
  for (const DopTreeOptions& options : all_options) {
    const auto plate = shared(geometry::make_plate({0.4, 0.3}, 200));
    const std::vector<Vector3d> flat = plate->vertices;
    DopTree tree(plate, options);
    const DopTree original = tree;
    const DopTree ball(shared(geometry::make_sphere(0.1, 100)), options);
    for (const Motion& motion : kMotions) {
      SCOPED_TRACE(testing::Message() << "k " << options.directions << ", " << motion.name);
      move(*plate, flat, motion);
      tree.refit();
      std::size_t pairs = expect_right_answers(tree, ball, std::max(2, test_support::affordable(20)));
      pairs += expect_right_answers(ball, tree, std::max(2, test_support::affordable(20)));
      EXPECT_GT(pairs, 0U);
    }
    plate->vertices = flat;
    tree.refit();
    expect_same_tree(tree, original);
  }
}

TEST(DopTreeRefit, QueriesAreExactOverARandomWalkOfVertices) {
  const auto plate = shared(geometry::make_plate({0.4, 0.3}, 200));
  DopTree tree(plate);
  const DopTree ball(shared(geometry::make_sphere(0.1, 100)));
  std::mt19937 random(20);
  CoherentWorkspace memory;  // of the tree as it was a step before
  std::vector<TrianglePair> pairs;
  const Eigen::Isometry3d X_AB = Eigen::Isometry3d::Identity();
  for (int step = 0; step < std::max(2, test_support::affordable(40)); ++step) {
    SCOPED_TRACE(testing::Message() << "step " << step);
    for (Vector3d& vertex : plate->vertices)
      vertex += 0.02 * Vector3d(uniform(random), uniform(random), uniform(random));
    tree.refit();
    expect_right_answers(tree, ball, 5);
    intersecting_pairs(tree, ball, X_AB, memory, pairs);
    EXPECT_EQ(pairs, reference::brute_force_pairs(*plate, ball.mesh(), X_AB));
  }
}

TEST(DopTreeRefit, TrianglesLoseTheirAreaAndGetItBack) {
  const auto plate = shared(geometry::make_plate({0.4, 0.3}, 200));
  const std::vector<Vector3d> flat = plate->vertices;
  DopTree tree(plate);
  const DopTree ball(shared(geometry::make_sphere(0.1, 100)));
  EXPECT_EQ(tree.degenerate_triangles(), 0);

  // On a line, then in one point: nothing is left that could collide.
  for (const Vector3d& direction : {Vector3d(1.0, 0.0, 0.0), Vector3d(0.0, 0.0, 0.0)}) {
    for (std::size_t i = 0; i < flat.size(); ++i)
      plate->vertices[i] = flat[i].cwiseProduct(direction);
    tree.refit();
    EXPECT_GT(tree.radius(), 0.0);  // a length to measure by
    EXPECT_EQ(tree.degenerate_triangles(), static_cast<std::int64_t>(plate->triangles.size()));
    EXPECT_EQ(expect_right_answers(tree, ball, 5), 0U);
    EXPECT_EQ(expect_right_answers(tree, tree, 5), 0U);
  }

  plate->vertices = flat;
  tree.refit();
  EXPECT_EQ(tree.degenerate_triangles(), 0);
  EXPECT_GT(expect_right_answers(tree, ball, 5), 0U);
}

TEST(DopTreeRefit, AllocatesNothing) {
  if (!test_support::allocations_are_counted()) GTEST_SKIP() << "allocations cannot be counted here";
  for (const Realignment realignment : {Realignment::kAffine, Realignment::kBruteForce}) {
    const auto plate = shared(geometry::make_plate({0.4, 0.3}, 2000));
    DopTree tree(plate, {.realignment = realignment});
    for (Vector3d& vertex : plate->vertices)
      vertex.z() = vertex.x() * vertex.y();
    const std::int64_t before = test_support::allocations_of_this_thread();
    tree.refit();
    EXPECT_EQ(test_support::allocations_of_this_thread(), before);
  }
}

TEST(DopTreeRefit, LeavesTheTreeAsItWasWhenAVertexIsRefused) {
  const auto plate = shared(geometry::make_plate({0.4, 0.3}, 200));
  DopTree tree(plate);
  const DopTree original = tree;
  const Vector3d good = plate->vertices[17];
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -1.1e9}) {
    plate->vertices[17].y() = bad;
    expect_bad_input([&] { tree.refit(); }, {"vertex 17", "not finite or beyond"});
    expect_same_tree(tree, original);
  }
  plate->vertices[17] = good;
  tree.refit();
  EXPECT_GT(expect_right_answers(tree, DopTree(shared(geometry::make_sphere(0.1, 100))), 5), 0U);
}

TEST(DopTree, HoldsEveryTriangleInOneLeaf) {
  for (const std::size_t count : {1U, 2U, 4U, 5U, 8U, 9U, 17U, 300U}) {
    SCOPED_TRACE(count);
    const DopTree tree(piece_of_torus(count));
    std::vector<std::int32_t> triangles;
    for (const TriangleLeaf& leaf : leaves_of(tree)) {
      EXPECT_NE(leaf.triangle[0], kNoTriangle);
      // Free places come last.
      EXPECT_TRUE(std::is_partitioned(leaf.triangle.begin(), leaf.triangle.end(),
                                      [](std::int32_t triangle) { return triangle != kNoTriangle; }));
      std::copy_if(leaf.triangle.begin(), leaf.triangle.end(), std::back_inserter(triangles),
                   [](std::int32_t triangle) { return triangle != kNoTriangle; });
    }
    std::sort(triangles.begin(), triangles.end());
    ASSERT_EQ(triangles.size(), count);
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_EQ(triangles[i], static_cast<std::int32_t>(i));

    // Each node but the root, and each leaf, is the child of one.
    std::size_t nodes = 1;
    std::size_t leaves = 0;
    for (const NodeHead& head : nodes_of(tree)) {
      EXPECT_GE(head.child_count(), count <= 4 ? 1 : 2);
      EXPECT_LE(head.child_count(), 4);
      nodes += head.node_count;
      leaves += head.leaf_count;
    }
    EXPECT_EQ(nodes, nodes_of(tree).size());
    EXPECT_EQ(leaves, leaves_of(tree).size());
    EXPECT_GT(expect_right_answers(tree, DopTree(shared(geometry::make_sphere(0.1, 100))), 40), 0U);
  }
}

TEST(DopTree, LeavesOutTrianglesWithoutArea) {
  const auto mesh = piece_of_torus(17);
  mesh->triangles[3] = {5, 5, 6};
  mesh->triangles[16] = {7, 8, 7};
  const DopTree tree(mesh);
  EXPECT_EQ(tree.degenerate_triangles(), 2);
  EXPECT_GT(expect_right_answers(tree, DopTree(shared(geometry::make_sphere(0.1, 100))), 40), 0U);
}

TEST(DopTree, IsTheSameWhateverTheNumberOfThreads) {
  const auto mesh = shared(geometry::make_torus(0.1, 0.03, 20'000));
  const DopTree tree(mesh);
  expect_same_tree(tree, DopTree(mesh));
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  expect_same_tree(tree, DopTree(mesh));
}

TEST(DopTree, TakesAtMost100BytesATriangleWithItsMesh) {
  for (const geometry::TriangleMesh& mesh :
       {geometry::make_torus(0.1, 0.03, 20'000), geometry::make_sphere(0.1, 20'000)}) {
    const std::size_t mesh_bytes =
        mesh.vertices.size() * sizeof(Vector3d) + mesh.triangles.size() * sizeof(geometry::Triangle);
    const DopTree tree(shared(mesh));
    EXPECT_LE(tree.memory_bytes() + mesh_bytes, 100 * mesh.triangles.size());
  }
}

TEST(DopTree, RefusesOptionsThatDoNotExist) {
  for (const int k : {-6, 0, 8, 12, 25, 32})
    expect_bad_input([k] { DopTree(piece_of_torus(5), {.directions = k}); }, {std::to_string(k)});
}

TEST(DopTree, RefusesMeshesItCannotHold) {
  const auto expect_mesh_refused = [](const std::shared_ptr<geometry::TriangleMesh>& mesh, const std::string& reason) {
    expect_bad_input([&] { DopTree tree(mesh); }, {reason});
  };
  expect_mesh_refused(shared({}), "no triangle of positive area");
  const auto flat = piece_of_torus(5);
  for (Vector3d& vertex : flat->vertices)
    vertex.setConstant(vertex.x());
  expect_mesh_refused(flat, "no triangle of positive area");

  for (const std::int32_t index : {-1, 1000}) {
    const auto mesh = piece_of_torus(5);
    mesh->triangles[4][2] = index;
    expect_mesh_refused(mesh, "triangle 4 names vertex " + std::to_string(index));
  }
  // Many vertices that are not numbers would upset every sort, were they not refused first.
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -1.1e9}) {
    const auto mesh = piece_of_torus(300);
    for (std::size_t i = 1; i < mesh->vertices.size(); i += 2)
      mesh->vertices[i].z() = bad;
    expect_mesh_refused(mesh, "vertex 1 has a coordinate");
  }
}

}  // namespace
}  // namespace glissade::collision
