#include <memory>
#include <random>

#include <gtest/gtest.h>

#include <glissade/apps/commands/collide_method.h>

#include "expect_bad_input.h"

namespace glissade::apps {
namespace {

using geometry::TriangleMesh;

/// A strip of `cells` unit squares along x in the plane z = 0, two triangles each.
std::shared_ptr<const geometry::TriangleMesh> strip(int cells) {
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  for (int i = 0; i <= cells; ++i) {
    mesh->vertices.emplace_back(i, 0.0, 0.0);
    mesh->vertices.emplace_back(i, 1.0, 0.0);
  }
  for (int i = 0; i < cells; ++i) {
    mesh->triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    mesh->triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  return mesh;
}

TEST(CollideMethod, ToleranceDecidesWhatCounts) {
  const Eigen::Isometry3d X_AB(Eigen::Translation3d(0.25, 0.25, 0.125));
  for (const std::string& name : collide_method_names()) {
    SCOPED_TRACE(name);
    const auto colliding_within = [&](double tolerance) {
      return make_collide_method(name, strip(3), strip(3), {tolerance, false})(X_AB).colliding;
    };
    EXPECT_FALSE(colliding_within(0.0));
    EXPECT_FALSE(colliding_within(0.124));
    EXPECT_TRUE(colliding_within(0.125));
  }
}

TEST(CollideMethod, CountsPairsOfTriangles) {
  // Standing on the middle of the first cell's diagonal, the upright triangle touches both of its triangles.
  auto upright = std::make_shared<geometry::TriangleMesh>();
  upright->vertices = {{0.5, 0.5, 0.0}, {0.5, 0.5, 1.0}, {0.6, 0.5, 1.0}};
  upright->triangles = {{0, 1, 2}, {0, 0, 1}};
  for (const std::string& name : collide_method_names()) {
    SCOPED_TRACE(name);
    const CollideAnswer answer =
        make_collide_method(name, strip(3), upright, {0.0, true})(Eigen::Isometry3d::Identity());
    EXPECT_TRUE(answer.colliding);
    EXPECT_EQ(answer.pairs, 2);
  }
}

TEST(CollideMethod, AllMethodsGiveTheSameAnswer) {
  constexpr unsigned kSeed = 20;
  SCOPED_TRACE(testing::Message() << "seed " << kSeed);
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const double tolerance : {0.0, 0.3}) {
    CollideMethod tree = make_collide_method("dop-tree", strip(8), strip(5), {tolerance, true});
    CollideMethod brute_force = make_collide_method("brute-force", strip(8), strip(5), {tolerance, true});
    int colliding = 0;
    for (int i = 0; i < 100; ++i) {
      Eigen::Isometry3d X_AB(
          Eigen::Quaterniond(uniform(random), uniform(random), uniform(random), uniform(random)).normalized());
      X_AB.translation() = Eigen::Vector3d(4.0 + 6.0 * uniform(random), 2.0 * uniform(random), 2.0 * uniform(random));
      const CollideAnswer answer = tree(X_AB);
      EXPECT_EQ(answer.colliding, brute_force(X_AB).colliding) << "pose " << i;
      EXPECT_EQ(answer.pairs, brute_force(X_AB).pairs) << "pose " << i;
      colliding += answer.colliding ? 1 : 0;
    }
    EXPECT_GT(colliding, 10);
    EXPECT_LT(colliding, 90);
  }
}

TEST(CollideMethod, AnUnknownNameListsTheKnownOnes) {
  test_support::expect_bad_input([] { make_collide_method("guess", strip(1), strip(1), {}); },
                                 {"'guess'", "dop-tree, brute-force"});
}

}  // namespace
}  // namespace glissade::apps
