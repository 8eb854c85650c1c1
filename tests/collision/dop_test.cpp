#include "tree/dop.h"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tree/generic_dop.h"

namespace glissade::collision {
namespace {

class EveryK : public ::testing::TestWithParam<int> {
 protected:
  int k() const { return GetParam(); }
  const DopDirections& directions() const { return dop_directions(k()); }
};

TEST_P(EveryK, HalfSpacesComeInOppositePairs) {
  EXPECT_EQ(2 * directions().slabs, k());
  for (int i = 0; i < k(); ++i) {
    EXPECT_EQ(directions().half_space(directions().opposite(i)), -directions().half_space(i));
    EXPECT_EQ(directions().opposite(directions().opposite(i)), i);
    EXPECT_NEAR(directions().half_space(i).norm(), 1.0, 1e-15);
  }
}

TEST_P(EveryK, AxesComeFirst) {
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_EQ(directions().half_space(axis), Eigen::Vector3d::Unit(axis));
}

TEST_P(EveryK, GenericDopIsASimplePolytopeInWhichEveryHalfSpaceHasAFace) {
  const auto& vertices = generic_dop_vertices(k());
  // Euler: a simple polytope of F faces has 2F − 4 vertices; they come in mirrored pairs, of which one is listed.
  EXPECT_EQ(static_cast<int>(vertices.size()), k() - 2);
  std::vector<int> corners_of_face(static_cast<std::size_t>(k()));
  for (const GenericVertex& vertex : vertices) {
    for (const int half_space : vertex.half_spaces) {
      ++corners_of_face[static_cast<std::size_t>(half_space)];
      ++corners_of_face[static_cast<std::size_t>(directions().opposite(half_space))];
    }
  }
  EXPECT_THAT(corners_of_face, ::testing::Each(::testing::Ge(3)));
}

TEST_P(EveryK, WeightsOfTheExtremalVertexExpressADirectionAndAreNotNegative) {
  constexpr unsigned kSeed = 3;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 generator(kSeed);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 1000; ++trial) {
    const Eigen::Vector3d c = Eigen::Vector3d(normal(generator), normal(generator), normal(generator)).normalized();
    const GenericVertex* extremal = nullptr;
    for (const GenericVertex& vertex : generic_dop_vertices(k())) {
      if (extremal == nullptr || std::abs(c.dot(vertex.position)) > std::abs(c.dot(extremal->position))) {
        extremal = &vertex;
      }
    }
    const double sign = c.dot(extremal->position) < 0.0 ? -1.0 : 1.0;
    const Eigen::Vector3d weights = sign * (extremal->weights_of_direction * c);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int l = 0; l < 3; ++l)
      sum += sign * weights[l] * directions().half_space(extremal->half_spaces[static_cast<std::size_t>(l)]);
    EXPECT_NEAR((sum - c).norm(), 0.0, 1e-12);
    EXPECT_GE(weights.minCoeff(), -1e-12);
    EXPECT_LE(weights.maxCoeff(), 1.0 + 1e-12);  // what 16 bits can hold
    EXPECT_LE(weights.sum(), 1.7321);            // what the grid leaves room for
  }
}

INSTANTIATE_TEST_SUITE_P(K, EveryK, ::testing::Values(6, 14, 18, 24, 26));

TEST(DopDirections, UnsupportedKIsRefused) {
  EXPECT_THROW(dop_directions(8), std::invalid_argument);
}

}  // namespace
}  // namespace glissade::collision
