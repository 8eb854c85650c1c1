// The vector code in front of the contact search: what it leaves out is no contact, by plain formulas in double
// precision, and it leaves out nearly every pair without one.

#include "features/feature_kernel.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

#include <glissade/geometry/triangle_pair.h>

#include "every_instruction_set.h"
#include "random_numbers.h"
#include "sanitizers.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::TrianglePoints;
using test_support::RandomNumbers;

struct FeaturePair {
  double distance;  // metres
  double outside;   // metres by which the closest points of the lines of two edges lie outside of one, or 0
};

FeaturePair corner_over(const Vector3d& corner, const TrianglePoints& triangle) {
  return {geometry::triangle_distance(triangle, {corner, corner, corner}).distance, 0.0};
}

double distance_from_segment(const Vector3d& x, const Vector3d& begin, const Vector3d& end) {
  const Vector3d along = end - begin;
  const double s = std::clamp(along.dot(x - begin) / along.squaredNorm(), 0.0, 1.0);
  return (begin + s * along - x).norm();
}

FeaturePair edges(const Vector3d& p0, const Vector3d& p1, const Vector3d& q0, const Vector3d& q1) {
  const double ends = std::min({distance_from_segment(p0, q0, q1), distance_from_segment(p1, q0, q1),
                                distance_from_segment(q0, p0, p1), distance_from_segment(q1, p0, p1)});
  const Vector3d d = p1 - p0;
  const Vector3d e = q1 - q0;
  const Vector3d c = d.cross(e);
  const double s = (q0 - p0).cross(e).dot(c) / c.squaredNorm();
  const double t = (q0 - p0).cross(d).dot(c) / c.squaredNorm();
  const auto outside = [](double at) { return std::max({0.0, -at, at - 1.0}); };
  const double out = std::max(outside(s) * d.norm(), outside(t) * e.norm());
  return {out > 0.0 ? ends : std::min(ends, std::abs((q0 - p0).dot(c)) / c.norm()), out};
}

/// One of the fifteen pairs of features of two triangles.
FeaturePair features_of(const TrianglePoints& obstacle, const TrianglePoints& part, FeaturePairs feature) {
  for (int i = 0; i < 3; ++i) {
    const auto a = static_cast<std::size_t>(i);
    if (feature == with_part_corner(i)) return corner_over(part[a], obstacle);
    if (feature == with_obstacle_corner(i)) return corner_over(obstacle[a], part);
    for (int j = 0; j < 3; ++j) {
      const auto b = static_cast<std::size_t>(j);
      if (feature == with_edges(i, j)) return edges(part[a], part[(a + 1) % 3], obstacle[b], obstacle[(b + 1) % 3]);
    }
  }
  return {};
}

/// By how much another corner of either triangle is nearer than edges i and j along their normal, metres; of features
/// with a corner, 0.
double nearer_corner(const TrianglePoints& obstacle, const TrianglePoints& part, FeaturePairs feature) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (feature != with_edges(static_cast<int>(i), static_cast<int>(j))) continue;
      Vector3d n = (part[(i + 1) % 3] - part[i]).cross(obstacle[(j + 1) % 3] - obstacle[j]).normalized();
      if (n.dot(part[i] - obstacle[j]) < 0.0) n = -n;
      return std::max(-n.dot(part[(i + 2) % 3] - part[i]), n.dot(obstacle[(j + 2) % 3] - obstacle[j]));
    }
  }
  return 0.0;
}

/// Sixteen random pairs of triangles near each other, somewhere, of one size.
class SixteenPairs {
 public:
  explicit SixteenPairs(RandomNumbers& random) : size_(random.power_of_ten(-5.0, 1.0)), X_OV_(Isometry3d::Identity()) {
    X_OV_.linear() = random.rotation();
    const Vector3d middle = size_ * random.power_of_ten(-1.0, 3.0) * random.direction();
    X_OV_.translation() = middle;
    coordinates_ = 3.0 * middle.norm() + 4.0 * size_;
    for (std::size_t pair = 0; pair < kTrianglePairs; ++pair) {
      const double part_size = size_ * random.power_of_ten(-2.0, 0.0);
      const Vector3d between = size_ * random.power_of_ten(-3.0, 0.0) * random.direction();
      for (std::size_t c = 0; c < 3; ++c) {
        const Vector3d y_O = middle + random.point(size_);
        const Vector3d x_V = X_OV_.inverse() * Vector3d(middle + between + random.point(part_size));
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
          pairs_.p_O[c][static_cast<std::size_t>(axis)][pair] = y_O[axis];
          pairs_.p_V[c][static_cast<std::size_t>(axis)][pair] = x_V[axis];
        }
      }
    }
  }

  double size() const { return size_; }
  TrianglePoints obstacle(std::size_t pair) const { return points(pairs_.p_O, pair); }
  TrianglePoints part(std::size_t pair) const {
    TrianglePoints t = points(pairs_.p_V, pair);
    for (Vector3d& x : t)
      x = X_OV_ * x;
    return t;
  }

  void leave_out_impossible(double reach, double past_end, double margin, PossibleContacts& possible) const {
    RelativePose pose;
    for (Eigen::Index row = 0; row < 3; ++row) {
      for (Eigen::Index column = 0; column < 3; ++column)
        pose.R_OV[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = X_OV_.linear()(row, column);
      pose.p_OV[static_cast<std::size_t>(row)] = X_OV_.translation()[row];
    }
    contact::leave_out_impossible(pairs_, pose, {reach, past_end, margin, coordinates_}, possible);
  }

 private:
  static TrianglePoints points(const TrianglePairs::Corners& corners, std::size_t pair) {
    TrianglePoints t;
    for (std::size_t c = 0; c < 3; ++c)
      t[c] = {corners[c][0][pair], corners[c][1][pair], corners[c][2][pair]};
    return t;
  }

  double size_;
  Isometry3d X_OV_;
  double coordinates_;
  TrianglePairs pairs_;
};

class FeatureKernel : public test_support::EveryInstructionSet {};

TEST_P(FeatureKernel, RejectsMostImpossibleFeaturePairsAndNoPossibleOnes) {
  constexpr std::uint64_t kSeed = 31;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomNumbers random(kSeed);
  std::int64_t left_out = 0;
  std::int64_t impossible = 0;
  std::int64_t possible_ones = 0;
  std::int64_t not_nearest = 0;
  std::int64_t with_nearer_corner = 0;
  for (int trial = 0; trial < test_support::affordable(2000); ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const SixteenPairs pairs(random);
    const double reach = pairs.size() * random.power_of_ten(-3.0, 0.0);
    const double past_end = random.chance(0.5) ? 0.0 : reach * random.uniform(0.0, 0.5);
    const double margin = pairs.size() * random.power_of_ten(-3.0, 0.0);
    PossibleContacts possible;
    for (FeaturePairs& features : possible.features)
      features = static_cast<FeaturePairs>(random.integer(0, static_cast<int>(kAllFeaturePairs)));
    const PossibleContacts asked = possible;
    pairs.leave_out_impossible(reach, past_end, margin, possible);
    for (std::size_t pair = 0; pair < kTrianglePairs; ++pair) {
      ASSERT_EQ(possible.features[pair] & ~asked.features[pair], 0U);
      ASSERT_EQ(possible.nearest[pair] & ~possible.features[pair], 0U);
      double least = std::numeric_limits<double>::infinity();
      double least_left_out = least;
      for (FeaturePairs bit = 1; bit <= kAllFeaturePairs; bit <<= 1) {
        if ((asked.features[pair] & bit) == 0) continue;
        const FeaturePair true_one = features_of(pairs.obstacle(pair), pairs.part(pair), bit);
        least = std::min(least, true_one.distance);
        const bool is_impossible = true_one.distance > reach + past_end || true_one.outside > past_end;
        const bool is_left_out = (possible.features[pair] & bit) == 0;
        const bool is_not_nearest = !is_left_out && (possible.nearest[pair] & bit) == 0;
        const bool has_nearer_corner = nearer_corner(pairs.obstacle(pair), pairs.part(pair), bit) > margin;
        ASSERT_TRUE(has_nearer_corner || !is_not_nearest) << "feature " << bit << ", margin " << margin;
        not_nearest += is_not_nearest ? 1 : 0;
        with_nearer_corner += !is_left_out && has_nearer_corner ? 1 : 0;
        if (is_left_out) least_left_out = std::min(least_left_out, true_one.distance);
        ASSERT_TRUE(is_impossible || !is_left_out) << "feature " << bit << " at " << true_one.distance << ", "
                                                   << true_one.outside << " of reach " << reach << ", " << past_end;
        impossible += is_impossible ? 1 : 0;
        left_out += is_left_out ? 1 : 0;
        possible_ones += is_impossible ? 0 : 1;
      }
      ASSERT_LE(static_cast<double>(possible.gaps[pair]), least);
      ASSERT_GE(possible.gaps[pair], 0.0F);
      ASSERT_LE(static_cast<double>(possible.gaps_left_out[pair]), least_left_out);
      ASSERT_GE(possible.gaps_beyond[pair], possible.gaps_left_out[pair]);
    }
  }
  EXPECT_GT(static_cast<double>(left_out), 0.9 * static_cast<double>(impossible));
  EXPECT_GT(static_cast<double>(not_nearest), 0.9 * static_cast<double>(with_nearer_corner));
  EXPECT_GT(possible_ones, test_support::affordable(1000));
}

// Twice the same corner, twice the same triangle, a triangle far smaller than the rounding of its place.
TEST_P(FeatureKernel, RejectsNothingForDegenerateTriangles) {
  TrianglePairs pairs{};
  PossibleContacts possible;
  possible.features.fill(kAllFeaturePairs);
  for (std::size_t pair = 0; pair < kTrianglePairs; ++pair) {
    for (std::size_t c = 0; c < 3; ++c)
      pairs.p_O[c][0][pair] = 1.0 + (pair % 2 == 0 ? 0.0 : 1e-13 * static_cast<double>(c));
    for (std::size_t c = 0; c < 3; ++c)
      pairs.p_V[c][0][pair] = 1.0 + (pair % 4 < 2 ? 0.0 : 3e-13);
  }
  const RelativePose still{{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}}, {0.0, 0.0, 0.0}};
  contact::leave_out_impossible(pairs, still, {1e-14, 0.0, 0.0, 2.0}, possible);
  for (std::size_t pair = 0; pair < kTrianglePairs; ++pair) {
    EXPECT_EQ(possible.features[pair], kAllFeaturePairs) << "pair " << pair;
    EXPECT_EQ(possible.nearest[pair], kAllFeaturePairs) << "pair " << pair;
    EXPECT_EQ(possible.gaps[pair], 0.0F) << "pair " << pair;
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, FeatureKernel, FeatureKernel::all(), FeatureKernel::name);

}  // namespace
}  // namespace glissade::contact
