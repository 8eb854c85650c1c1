/// What queries refuse, and what they take from the heap. Their answers: dop_query_oracle_test.cpp.

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/mesh_generators.h>

#include "allocation_counter.h"
#include "expect_bad_input.h"
#include "poses.h"

namespace glissade::collision {
namespace {

using Eigen::Isometry3d;

DopTree torus_tree(const DopTreeOptions& options = {}) {
  return DopTree(std::make_shared<const geometry::TriangleMesh>(geometry::make_torus(0.1, 0.03, 400)), options);
}

/// A query of one kind, with memory and results of its own.
struct Query {
  std::string name;
  std::function<void(const DopTree& tree_A, const DopTree& tree_B, const Isometry3d& X_AB)> ask;
};

template <typename Workspace>
std::vector<Query> queries_with() {
  const auto workspace = std::make_shared<Workspace>();
  const auto pairs = std::make_shared<std::vector<TrianglePair>>();
  const auto close_pairs = std::make_shared<std::vector<ClosePair>>();
  std::vector<Query> queries;
  for (const double tolerance : {0.0, 0.01}) {
    const std::string suffix = ", tolerance " + std::to_string(tolerance);
    queries.push_back({"intersects" + suffix, [=](const auto& tree_A, const auto& tree_B, const Isometry3d& X_AB) {
                         intersects(tree_A, tree_B, X_AB, *workspace, tolerance);
                       }});
    queries.push_back(
        {"intersecting_pairs" + suffix, [=](const auto& tree_A, const auto& tree_B, const Isometry3d& X_AB) {
           intersecting_pairs(tree_A, tree_B, X_AB, *workspace, *pairs, tolerance);
         }});
    queries.push_back({"pairs_within" + suffix, [=](const auto& tree_A, const auto& tree_B, const Isometry3d& X_AB) {
                         pairs_within(tree_A, tree_B, X_AB, tolerance, *workspace, *close_pairs);
                       }});
    queries.push_back({"distance" + suffix, [=](const auto& tree_A, const auto& tree_B, const Isometry3d& X_AB) {
                         distance(tree_A, tree_B, X_AB, *workspace, 1.0 + tolerance);
                       }});
  }
  return queries;
}

std::vector<Query> all_queries() {
  std::vector<Query> queries = queries_with<QueryWorkspace>();
  for (Query& query : queries_with<CoherentWorkspace>())
    queries.push_back({query.name + ", coherent", query.ask});
  return queries;
}

TEST(DopQuery, RefusesTreesOfDifferentOptions) {
  const DopTree tree = torus_tree();
  for (const DopTreeOptions& other : {DopTreeOptions{.directions = 18}, DopTreeOptions{.thin_slab = false},
                                      DopTreeOptions{.realignment = Realignment::kBruteForce}}) {
    const DopTree different = torus_tree(other);
    for (const Query& query : all_queries()) {
      SCOPED_TRACE(query.name);
      test_support::expect_bad_input([&] { query.ask(tree, different, Isometry3d::Identity()); },
                                     {"different options"});
      test_support::expect_bad_input([&] { query.ask(different, tree, Isometry3d::Identity()); },
                                     {"different options"});
    }
  }
}

TEST(DopQuery, RefusesInvalidPoses) {
  const DopTree tree = torus_tree();
  for (const Query& query : all_queries()) {
    SCOPED_TRACE(query.name);
    const auto expect_pose_refused = [&](const Isometry3d& X_AB) {
      test_support::expect_bad_input([&] { query.ask(tree, tree, X_AB); }, {"X_AB"});
    };
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
          Isometry3d X_AB = Isometry3d::Identity();
          X_AB.matrix()(row, column) = bad;
          expect_pose_refused(X_AB);
        }
      }
    }
    Isometry3d stretched = Isometry3d::Identity();
    stretched.linear() *= 1.001;
    expect_pose_refused(stretched);
    Isometry3d mirrored = Isometry3d::Identity();
    mirrored.linear()(2, 2) = -1.0;
    expect_pose_refused(mirrored);
    Isometry3d flat = Isometry3d::Identity();
    flat.linear().setZero();
    expect_pose_refused(flat);
    for (const double far : {-2e12, 1e13, 1e160, 1e300})
      expect_pose_refused(test_support::at(0.0, far));
    EXPECT_NO_THROW(query.ask(tree, tree, Isometry3d::Identity()));
    EXPECT_NO_THROW(query.ask(tree, tree, test_support::at(1e12)));
    expect_pose_refused(test_support::at(6e11, -6e11));
  }
}

TEST(DopQuery, RefusesInvalidDistances) {
  const DopTree tree = torus_tree();
  Isometry3d X_AB = Isometry3d::Identity();
  for (const double shift : {0.0, 100.0}) {
    X_AB.translation().x() = shift;
    const auto expect_refused = [&](auto&& workspace) {
      std::vector<TrianglePair> pairs;
      std::vector<ClosePair> close_pairs;
      for (const double bad : {-1e-9, std::numeric_limits<double>::quiet_NaN()}) {
        const auto expect_complaint = [](const auto& ask) { test_support::expect_bad_input(ask, {"negative"}); };
        expect_complaint([&] { intersects(tree, tree, X_AB, workspace, bad); });
        expect_complaint([&] { intersecting_pairs(tree, tree, X_AB, workspace, pairs, bad); });
        expect_complaint([&] { pairs_within(tree, tree, X_AB, bad, workspace, close_pairs); });
        expect_complaint([&] { distance(tree, tree, X_AB, workspace, bad); });
      }
    };
    expect_refused(QueryWorkspace());
    expect_refused(CoherentWorkspace());
  }
}

TEST(DopQuery, AnInfiniteDistanceFindsEveryPair) {
  const DopTree tree = torus_tree();
  const std::size_t triangles = tree.mesh().triangles.size();
  const double everything = std::numeric_limits<double>::infinity();
  QueryWorkspace fresh;
  CoherentWorkspace remembering;
  std::vector<TrianglePair> pairs;
  for (const double shift : {0.0, 0.1, 0.2}) {
    Isometry3d X_AB = Isometry3d::Identity();
    X_AB.translation().x() = shift;
    intersecting_pairs(tree, tree, X_AB, fresh, pairs, everything);
    EXPECT_EQ(pairs.size(), triangles * triangles);
    intersecting_pairs(tree, tree, X_AB, remembering, pairs, everything);
    EXPECT_EQ(pairs.size(), triangles * triangles);
  }
}

TEST(DopQuery, AllocatesNothingOnceMemoryIsThere) {
  if (!test_support::allocations_are_counted()) GTEST_SKIP() << "allocations cannot be counted here";
  const DopTree tree_A = torus_tree();
  const DopTree tree_B = torus_tree();
  for (const Query& query : all_queries()) {
    const auto slide_to_and_fro = [&] {
      for (int frame = 0; frame < 60; ++frame) {
        const double way = 0.01 * std::abs(frame - 30);
        Isometry3d X_AB = Isometry3d::Identity();
        X_AB.linear() =
            Eigen::AngleAxisd(1.0 + 0.1 * way, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
        X_AB.translation().x() = 0.1 + way;
        query.ask(tree_A, tree_B, X_AB);
      }
    };
    // Those that remember go another way the second time.
    for (int i = 0; i < 3; ++i)
      slide_to_and_fro();
    const std::int64_t before = test_support::allocations_of_this_thread();
    slide_to_and_fro();
    EXPECT_EQ(test_support::allocations_of_this_thread(), before) << query.name;
  }
}

}  // namespace
}  // namespace glissade::collision
