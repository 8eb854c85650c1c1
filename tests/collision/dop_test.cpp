#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <glissade/collision/dop.h>

#include "dop_alignment.h"
#include "generic_dop.h"

namespace glissade::collision {
namespace {

TEST(Dop, HalfSpacesComeInOppositePairs) {
  for (int i = 0; i < kDopDirections; ++i) {
    EXPECT_EQ(dop_direction(opposite(i)), -dop_direction(i));
    EXPECT_EQ(opposite(opposite(i)), i);
  }
}

TEST(GenericDop, IsASimplePolytopeInWhichEveryHalfSpaceHasAFace) {
  const auto& vertices = generic_dop_vertices();
  EXPECT_EQ(vertices.size(), 2u * kDopDirections - 4u);  // Euler: a simple polytope of F faces has 2F − 4 vertices
  std::array<int, kDopDirections> corners_of_face{};
  for (const GenericVertex& vertex : vertices) {
    for (const int half_space : vertex.half_spaces)
      ++corners_of_face[static_cast<std::size_t>(half_space)];
  }
  for (const int corners : corners_of_face)
    EXPECT_GE(corners, 3);
}

class RandomPoses : public ::testing::TestWithParam<double> {
 protected:
  Eigen::Vector3d random_vector() { return {uniform_(generator_), uniform_(generator_), uniform_(generator_)}; }
  Eigen::Isometry3d random_pose(double translation) {
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.linear() =
        Eigen::Quaterniond(uniform_(generator_), uniform_(generator_), uniform_(generator_), uniform_(generator_))
            .normalized()
            .toRotationMatrix();
    X.translation() = translation * random_vector();
    return X;
  }
  static constexpr unsigned kSeed = 20;
  std::mt19937 generator_{kSeed};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

Dop enclose(const std::vector<Eigen::Vector3d>& points) {
  Dop dop;
  for (int i = 0; i < kDopDirections; ++i) {
    double support = -1e300;
    for (const Eigen::Vector3d& x : points)
      support = std::max(support, dop_direction(i).dot(x));
    dop.support[static_cast<std::size_t>(i)] = std::nextafter(static_cast<float>(support), 1e30F);
  }
  return dop;
}

// Parameter: translation in units of the object's size.
TEST_P(RandomPoses, RealignedDopEnclosesEveryTransformedPoint) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  for (const double scale : {1e-6, 1.0, 1e3}) {
    for (int trial = 0; trial < 2000; ++trial) {
      std::vector<Eigen::Vector3d> points_B;
      for (int i = 0; i < 5; ++i)
        points_B.push_back(scale * random_vector());
      const Eigen::Isometry3d X_AB = random_pose(GetParam() * scale);
      const Dop aligned = DopAlignment(X_AB, scale, scale).realign(enclose(points_B));
      for (const Eigen::Vector3d& x_B : points_B) {
        const Eigen::Vector3d x_A = X_AB * x_B;
        for (int i = 0; i < kDopDirections; ++i) {
          ASSERT_LE(dop_direction(i).dot(x_A), static_cast<double>(aligned.support[static_cast<std::size_t>(i)]));
        }
      }
    }
  }
}

TEST_P(RandomPoses, RealignmentIsTightForAGenericPolytope) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  // For the generic DOP itself the three half-spaces meet in the extremal vertex, so realignment loses nothing.
  std::vector<Eigen::Vector3d> points_B;
  for (const GenericVertex& vertex : generic_dop_vertices())
    points_B.push_back(vertex.position);
  const Dop dop_B = enclose(points_B);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Isometry3d X_AB = random_pose(GetParam());
    const Dop aligned = DopAlignment(X_AB, 2.0, 2.0).realign(dop_B);
    for (int i = 0; i < kDopDirections; ++i) {
      double support = -1e300;
      for (const Eigen::Vector3d& x : points_B)
        support = std::max(support, dop_direction(i).dot(X_AB * x));
      EXPECT_NEAR(static_cast<double>(aligned.support[static_cast<std::size_t>(i)]), support,
                  1e-5 * (1.0 + GetParam()));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Translations, RandomPoses, ::testing::Values(0.0, 1.0, 1e3, 1e6));

TEST(Disjoint, IsDecidedByTheSlabThatSeparatesAndByTheDistance) {
  const Dop a = enclose({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  const Dop b = enclose({{1.1, 1.1, 1.1}, {2, 2, 2}});
  EXPECT_TRUE(disjoint(a, b, separation_thresholds(0.0)));
  EXPECT_TRUE(disjoint(a, b, separation_thresholds(1.3)));  // the true distance, along (1,1,1), is (3.3 − 1)/√3 ≈ 1.328
  EXPECT_FALSE(disjoint(a, b, separation_thresholds(1.35)));
  EXPECT_FALSE(disjoint(a, a, separation_thresholds(0.0)));
}

}  // namespace
}  // namespace glissade::collision
