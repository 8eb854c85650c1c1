#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/reference/brute_force.h>
#include <glissade/reference/grid_check.h>

#include "cgal_oracle.h"
#include "random_triangles.h"
#include "triangle_points.h"

namespace glissade::reference {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::points_of;
using test_support::RandomTriangles;

// A soup of `count` triangles of edge about `edge`, thrown into a cube of edge 2.
geometry::TriangleMesh random_soup(RandomTriangles& random, int count, double edge) {
  geometry::TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const Vector3d center = random.point_in_cube(1.0);
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    for (int corner = 0; corner < 3; ++corner)
      mesh.vertices.emplace_back(center + random.point_in_cube(edge));
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

Isometry3d random_pose(RandomTriangles& random, double reach) {
  Isometry3d X = Isometry3d::Identity();
  const Vector3d axis = random.point_in_cube(1.0).normalized();
  X.rotate(Eigen::AngleAxisd(random.uniform(-3.0, 3.0), axis));
  X.pretranslate(random.point_in_cube(reach));
  return X;
}

std::vector<collision::TrianglePair> cgal_pairs(const geometry::TriangleMesh& mesh_A,
                                                const geometry::TriangleMesh& mesh_B, const Isometry3d& X_AB) {
  std::vector<collision::TrianglePair> pairs;
  for (std::int32_t a = 0; a < static_cast<std::int32_t>(mesh_A.triangles.size()); ++a) {
    for (std::int32_t b = 0; b < static_cast<std::int32_t>(mesh_B.triangles.size()); ++b) {
      const geometry::TrianglePoints triangle_A = points_of(mesh_A, a);
      if (test_support::cgal_intersect(triangle_A, points_of(mesh_B, b, X_AB))) pairs.push_back({a, b});
    }
  }
  return pairs;
}

TEST(BruteForce, FindsThePairsThatCgalFinds) {
  RandomTriangles random(21);
  int colliding = 0;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE("seed 21, pose " + std::to_string(i));
    const geometry::TriangleMesh mesh_A = random_soup(random, 15, 0.3);
    const geometry::TriangleMesh mesh_B = random_soup(random, 15, 0.3);
    const Isometry3d X_AB = random_pose(random, 1.0);
    const std::vector<collision::TrianglePair> expected = cgal_pairs(mesh_A, mesh_B, X_AB);
    EXPECT_EQ(brute_force_pairs(mesh_A, mesh_B, X_AB), expected);
    EXPECT_EQ(brute_force_intersects(mesh_A, mesh_B, X_AB), !expected.empty());
    colliding += expected.empty() ? 0 : 1;
  }
  EXPECT_GT(colliding, 10);
  EXPECT_LT(colliding, 50);
}

TEST(BruteForce, LeavesOutTrianglesWithoutArea) {
  const geometry::TriangleMesh face{{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}, {{0, 1, 2}}};
  const geometry::TriangleMesh needle{{Vector3d(.25, .25, -1), Vector3d(.25, .25, 1), Vector3d(.25, .25, 2)},
                                      {{0, 1, 2}}};
  EXPECT_FALSE(brute_force_intersects(face, needle, Isometry3d::Identity()));
  EXPECT_FALSE(GridCheck({{std::make_shared<geometry::TriangleMesh>(face)}}).collides(needle, Isometry3d::Identity()));
  EXPECT_FALSE(GridCheck({{std::make_shared<geometry::TriangleMesh>(needle)}}).collides(face, Isometry3d::Identity()));
}

TEST(GridCheck, AgreesWithCgalOnSoups) {
  RandomTriangles random(22);
  int colliding = 0;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE("seed 22, pose " + std::to_string(i));
    const geometry::TriangleMesh obstacle = random_soup(random, 40, 0.25);
    const geometry::TriangleMesh part = random_soup(random, 5, 0.3);
    const Isometry3d X_WB = random_pose(random, 0.2);
    const Isometry3d X_WV = random_pose(random, 0.2);
    bool expected = false;
    for (std::int32_t a = 0; a < 40; ++a) {
      for (std::int32_t b = 0; b < 5; ++b) {
        expected = expected || test_support::cgal_intersect(points_of(obstacle, a, X_WB), points_of(part, b, X_WV));
      }
    }
    EXPECT_EQ(GridCheck({{std::make_shared<geometry::TriangleMesh>(obstacle), X_WB}}).collides(part, X_WV), expected);
    colliding += expected ? 1 : 0;
  }
  EXPECT_GT(colliding, 10);
  EXPECT_LT(colliding, 50);
}

// One triangle against one: the separating axes alone.
template <typename Next>
void expect_agreement_on_single_triangles(int count, std::uint64_t seed, const Next& next) {
  RandomTriangles random(seed);
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", pair " + std::to_string(i));
    const test_support::TrianglePair pair = next(random);
    const geometry::TriangleMesh a{{pair.a.begin(), pair.a.end()}, {{0, 1, 2}}};
    const geometry::TriangleMesh b{{pair.b.begin(), pair.b.end()}, {{0, 1, 2}}};
    ASSERT_EQ(GridCheck({{std::make_shared<geometry::TriangleMesh>(a)}}).collides(b, Isometry3d::Identity()),
              test_support::cgal_intersect(pair.a, pair.b));
  }
}

TEST(GridCheck, AgreesWithCgalOnTriangles) {
  expect_agreement_on_single_triangles(3'000, 23, [](RandomTriangles& random) { return random.anywhere(); });
  expect_agreement_on_single_triangles(3'000, 24, [](RandomTriangles& random) { return random.on_lattice(3); });
}

TEST(GridCheck, NeverMissesACollisionThatRoundingHides) {
  RandomTriangles random(25);
  for (int i = 0; i < 3'000; ++i) {
    SCOPED_TRACE("seed 25, pair " + std::to_string(i));
    const test_support::TrianglePair pair = i % 2 == 0 ? random.nearly_touching() : random.nearly_coplanar();
    if (!test_support::cgal_intersect(pair.a, pair.b)) continue;
    const geometry::TriangleMesh a{{pair.a.begin(), pair.a.end()}, {{0, 1, 2}}};
    const geometry::TriangleMesh b{{pair.b.begin(), pair.b.end()}, {{0, 1, 2}}};
    ASSERT_TRUE(GridCheck({{std::make_shared<geometry::TriangleMesh>(a)}}).collides(b, Isometry3d::Identity()));
  }
}

TEST(GridCheck, SeesAMicrometre) {
  const auto face = std::make_shared<geometry::TriangleMesh>(
      geometry::TriangleMesh{{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}, {{0, 1, 2}}});
  const GridCheck check({{face}});
  const geometry::TriangleMesh tip{{Vector3d(.25, .25, 0), Vector3d(.25, .5, 1), Vector3d(.5, .25, 1)}, {{0, 1, 2}}};
  Isometry3d X_WV = Isometry3d::Identity();
  EXPECT_TRUE(check.collides(tip, X_WV));
  X_WV.translation().z() = 1e-6;
  EXPECT_FALSE(check.collides(tip, X_WV));
  X_WV.translation().z() = -1e-6;
  EXPECT_TRUE(check.collides(tip, X_WV));
  X_WV.translation().x() = 1e30;
  EXPECT_FALSE(check.collides(tip, X_WV));
}

TEST(GridCheck, ChecksManyPosesWithEveryObstacle) {
  RandomTriangles random(26);
  const auto left = std::make_shared<geometry::TriangleMesh>(random_soup(random, 50, 0.3));
  const auto right = std::make_shared<geometry::TriangleMesh>(random_soup(random, 50, 0.3));
  Isometry3d X_WRight = Isometry3d::Identity();
  X_WRight.translation().x() = 2.5;
  const geometry::TriangleMesh part = random_soup(random, 5, 0.3);
  std::vector<Isometry3d> poses;
  for (int i = 0; i < 200; ++i)
    poses.push_back(Eigen::Translation3d(1.25, 0, 0) * random_pose(random, 1.5));

  const GridCheck check({{left, Isometry3d::Identity()}, {right, X_WRight}});
  std::size_t reports = 0;
  const std::vector<char> colliding =
      check.collisions(part, poses, [&](std::size_t done) { EXPECT_EQ(done, ++reports); });
  EXPECT_EQ(reports, poses.size());
  int hits[2] = {0, 0};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const bool hits_left = brute_force_intersects(*left, part, poses[i]);
    const bool hits_right = brute_force_intersects(*right, part, X_WRight.inverse() * poses[i]);
    EXPECT_EQ(colliding[i] != 0, hits_left || hits_right) << "seed 26, pose " << i;
    hits[0] += hits_left ? 1 : 0;
    hits[1] += hits_right ? 1 : 0;
  }
  EXPECT_GT(hits[0], 10);
  EXPECT_GT(hits[1], 10);
}

TEST(GridCheck, RefusesInvalidMeshes) {
  EXPECT_THROW(GridCheck({{nullptr}}), std::invalid_argument);
  const auto broken = std::make_shared<geometry::TriangleMesh>(
      geometry::TriangleMesh{{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, std::nan(""), 0)}, {{0, 1, 2}}});
  EXPECT_THROW(GridCheck({{broken}}), std::invalid_argument);
  const GridCheck nothing({});
  EXPECT_THROW(nothing.collides(*broken, Isometry3d::Identity()), std::invalid_argument);
  EXPECT_FALSE(nothing.collides({}, Isometry3d::Identity()));
}

}  // namespace
}  // namespace glissade::reference
