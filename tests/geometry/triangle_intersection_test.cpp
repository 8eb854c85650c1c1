#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/triangle_pair.h>

#include "cgal_oracle.h"
#include "random_triangles.h"
#include "sanitizers.h"

namespace glissade::geometry {
namespace {

using Eigen::Vector3d;
using test_support::affordable;
using test_support::RandomTriangles;

const TrianglePoints kRightTriangle{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)};

// The answer may depend neither on the order of the triangles, nor on that of their corners, nor on the axes' names.
std::vector<std::pair<TrianglePoints, TrianglePoints>> equivalent_pairs(const TrianglePoints& a,
                                                                        const TrianglePoints& b) {
  static constexpr std::size_t kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  std::vector<std::pair<TrianglePoints, TrianglePoints>> pairs;
  for (const auto& order_a : kOrders) {
    for (const auto& order_b : kOrders) {
      const TrianglePoints p{a[order_a[0]], a[order_a[1]], a[order_a[2]]};
      const TrianglePoints q{b[order_b[0]], b[order_b[1]], b[order_b[2]]};
      pairs.emplace_back(p, q);
      pairs.emplace_back(q, p);
    }
  }
  const auto turned = [](const TrianglePoints& t) {
    TrianglePoints result;
    for (std::size_t i = 0; i < 3; ++i) {
      result[i] = Vector3d(t[i].y(), t[i].z(), t[i].x());
    }
    return result;
  };
  const std::size_t count = pairs.size();
  for (std::size_t i = 0; i < count; ++i) {
    pairs.emplace_back(turned(pairs[i].first), turned(pairs[i].second));
    pairs.emplace_back(turned(turned(pairs[i].first)), turned(turned(pairs[i].second)));
  }
  return pairs;
}

void expect_intersection(const TrianglePoints& a, const TrianglePoints& b, bool expected) {
  for (const auto& [p, q] : equivalent_pairs(a, b)) {
    ASSERT_EQ(triangles_intersect(p, q), expected);
  }
}

struct NamedPair {
  std::string name;
  TrianglePoints b;  // the other one is kRightTriangle
  bool intersect;
};

class TriangleIntersection : public testing::TestWithParam<NamedPair> {};

TEST_P(TriangleIntersection, IsTheSameInEveryOrderAndScale) {
  const NamedPair& named = GetParam();
  expect_intersection(kRightTriangle, named.b, named.intersect);
  // Powers of two and an offset that keeps every coordinate representable change nothing either.
  for (const double scale : {0x1p-20, 0x1p10}) {
    for (const double offset : {0.0, 0x1p20}) {
      TrianglePoints a = kRightTriangle;
      TrianglePoints b = named.b;
      for (std::size_t i = 0; i < 3; ++i) {
        a[i] = scale * a[i] + Vector3d::Constant(offset);
        b[i] = scale * b[i] + Vector3d::Constant(offset);
      }
      EXPECT_EQ(triangles_intersect(a, b), named.intersect) << "scale " << scale << ", offset " << offset;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Crossing, TriangleIntersection,
    testing::Values(
        NamedPair{"EdgePiercesInside", {Vector3d(.25, .25, -1), Vector3d(.25, .25, 1), Vector3d(3, 3, 0)}, true},
        NamedPair{"CornerReachesThrough", {Vector3d(.25, .25, -.5), Vector3d(2, 0, 1), Vector3d(-2, 1, 1)}, true},
        NamedPair{"LineOfPlanesMissed", {Vector3d(2, 2, -1), Vector3d(2, 2, 1), Vector3d(3, 3, 0)}, false},
        NamedPair{"Parallel", {Vector3d(0, 0, .125), Vector3d(1, 0, .125), Vector3d(0, 1, .125)}, false},
        NamedPair{"EdgeInPlaneCrossesInside", {Vector3d(-1, .25, 0), Vector3d(2, .25, 0), Vector3d(0, 0, 1)}, true},
        NamedPair{"EdgeInPlaneWithinInside", {Vector3d(.125, .25, 0), Vector3d(.25, .25, 0), Vector3d(9, 9, 9)}, true},
        NamedPair{"EdgeInPlaneOutside", {Vector3d(-1, 2, 0), Vector3d(2, 2, 0), Vector3d(0, 0, 1)}, false},
        NamedPair{"EdgeInPlaneBeside", {Vector3d(-2, .25, 0), Vector3d(-1, .25, 0), Vector3d(0, 0, 1)}, false},
        NamedPair{"EdgeInPlaneTouchesCorner", {Vector3d(2, -1, 0), Vector3d(0, 1, 0), Vector3d(1, 1, 1)}, true}),
    [](const auto& instance) { return instance.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Touching, TriangleIntersection,
    testing::Values(
        NamedPair{"CornerOnFace", {Vector3d(.25, .25, 0), Vector3d(0, 0, 1), Vector3d(1, 1, 1)}, true},
        NamedPair{"CornerOnEdge", {Vector3d(.5, .5, 0), Vector3d(0, 0, 1), Vector3d(1, 1, 1)}, true},
        NamedPair{"CornerOnCorner", {Vector3d(1, 0, 0), Vector3d(2, 0, 1), Vector3d(2, 1, 2)}, true},
        NamedPair{"CornerInPlaneOutside", {Vector3d(.75, .75, 0), Vector3d(0, 0, 1), Vector3d(1, 1, 1)}, false},
        NamedPair{"EdgeOnEdgeAcross", {Vector3d(.5, 0, -1), Vector3d(.5, 0, 1), Vector3d(.5, -1, 0)}, true},
        NamedPair{"EdgeBesideEdge", {Vector3d(.5, -.0625, -1), Vector3d(.5, -.0625, 1), Vector3d(.5, -1, 0)}, false},
        NamedPair{"EdgeThroughCorner", {Vector3d(0, 0, -1), Vector3d(0, 0, 1), Vector3d(-1, -1, 0)}, true},
        NamedPair{"SharedEdgeFolded", {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 0, 1)}, true}),
    [](const auto& instance) { return instance.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Coplanar, TriangleIntersection,
    testing::Values(
        NamedPair{"Same", {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}, true},
        NamedPair{"Overlapping", {Vector3d(.25, .25, 0), Vector3d(2, .25, 0), Vector3d(.25, 2, 0)}, true},
        NamedPair{"Star", {Vector3d(.75, .75, 0), Vector3d(-.5, .5, 0), Vector3d(.5, -.5, 0)}, true},
        NamedPair{"Nested", {Vector3d(.125, .125, 0), Vector3d(.25, .125, 0), Vector3d(.125, .25, 0)}, true},
        NamedPair{"Around", {Vector3d(-9, -9, 0), Vector3d(9, -9, 0), Vector3d(0, 9, 0)}, true},
        NamedPair{"SharedEdge", {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(.5, -1, 0)}, true},
        NamedPair{"PartOfAnEdge", {Vector3d(.25, 0, 0), Vector3d(.5, 0, 0), Vector3d(.5, -1, 0)}, true},
        NamedPair{"SharedCorner", {Vector3d(0, 0, 0), Vector3d(-1, 0, 0), Vector3d(0, -1, 0)}, true},
        NamedPair{"CornerOnEdge", {Vector3d(.5, .5, 0), Vector3d(1, 1, 0), Vector3d(.5, 1, 0)}, true},
        NamedPair{"Disjoint", {Vector3d(1, 1, 0), Vector3d(2, 1, 0), Vector3d(1, 2, 0)}, false},
        NamedPair{"EdgesOnOneLineApart", {Vector3d(2, 0, 0), Vector3d(3, 0, 0), Vector3d(2, 1, 0)}, false},
        NamedPair{
            "BoxesOverlapButNot", {Vector3d(.875, .875, 0), Vector3d(.25, .875, 0), Vector3d(.875, .25, 0)}, false}),
    [](const auto& instance) { return instance.param.name; });

TEST(TriangleIntersectionExact, SeesOneUnitInTheLastPlace) {
  for (const double height : {1e-6, 1.0, 1e3, 1e6}) {
    const TrianglePoints face{Vector3d(0, 0, height), Vector3d(1, 0, height), Vector3d(0, 1, height)};
    TrianglePoints above{Vector3d(.25, .25, height), Vector3d(.25, .5, height + 1), Vector3d(.5, .25, height + 1)};
    EXPECT_TRUE(triangles_intersect(face, above));
    above[0].z() = std::nextafter(height, 2 * height);
    EXPECT_FALSE(triangles_intersect(face, above));
    above[0].z() = std::nextafter(height, 0.0);
    EXPECT_TRUE(triangles_intersect(face, above));
  }
}

TEST(TriangleIntersectionExact, DecidesWhereCoordinateDifferencesAreRounded) {
  // 2^60 + 1 is no double: the differences to the apex are rounded, and a determinant of them is 0.
  const TrianglePoints face{Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1)};
  const TrianglePoints in_plane{Vector3d(0x1p60, -0x1p60, 1), Vector3d(0, 0, 2), Vector3d(0, 0, 3)};
  const TrianglePoints face_far{Vector3d(1, 0, 0), Vector3d(0x1p60, -0x1p60, 1), Vector3d(0, 0, 1)};
  const TrianglePoints touching{Vector3d(0, 1, 0), Vector3d(0, 5, 5), Vector3d(5, 5, 5)};
  EXPECT_EQ(triangles_intersect(face, in_plane), test_support::cgal_intersect(face, in_plane));
  EXPECT_EQ(triangles_intersect(face_far, touching), test_support::cgal_intersect(face_far, touching));
}

TEST(TriangleIntersectionExact, SeesDegenerateTriangles) {
  EXPECT_FALSE(is_degenerate(kRightTriangle));
  EXPECT_TRUE(is_degenerate({Vector3d(1, 2, 3), Vector3d(1, 2, 3), Vector3d(4, 5, 7)}));
  EXPECT_TRUE(is_degenerate({Vector3d(1, 2, 3), Vector3d(2, 4, 6), Vector3d(4, 8, 12)}));
  EXPECT_FALSE(is_degenerate({Vector3d(1, 2, 3), Vector3d(2, 4, 6), Vector3d(4, 8, std::nextafter(12.0, 13.0))}));
  for (int axis = 0; axis < 3; ++axis) {  // a triangle that two of the three projections do not see
    TrianglePoints t{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
    t[1][axis] = 1e-6;
    t[2][(axis + 1) % 3] = 1e3;
    EXPECT_FALSE(is_degenerate(t));
  }
}

void expect_same_answer(const test_support::TrianglePair& pair, int& intersecting) {
  const bool expected = test_support::cgal_intersect(pair.a, pair.b);
  intersecting += expected ? 1 : 0;
  ASSERT_EQ(triangles_intersect(pair.a, pair.b), expected);
  ASSERT_EQ(triangles_intersect(pair.b, pair.a), expected);
  ASSERT_EQ(triangles_intersect({pair.a[1], pair.a[0], pair.a[2]}, {pair.b[2], pair.b[0], pair.b[1]}), expected);
}

template <typename Next>
void expect_same_answers_as_cgal(int count, std::uint64_t seed, const Next& next) {
  RandomTriangles random(seed);
  int intersecting = 0;
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", pair " + std::to_string(i));
    expect_same_answer(next(random), intersecting);
    if (testing::Test::HasFatalFailure()) {
      return;
    }
  }
  // A stream of only one answer would prove little.
  EXPECT_GT(intersecting, count / 20);
  EXPECT_LT(intersecting, count - count / 20);
}

TEST(TriangleIntersectionAgainstCgal, AgreesAnywhere) {
  expect_same_answers_as_cgal(affordable(40'000), 1, [](RandomTriangles& random) { return random.anywhere(); });
}

TEST(TriangleIntersectionAgainstCgal, AgreesOnSmallLattices) {
  expect_same_answers_as_cgal(affordable(40'000), 2, [](RandomTriangles& random) { return random.on_lattice(2); });
  expect_same_answers_as_cgal(affordable(40'000), 3, [](RandomTriangles& random) { return random.on_lattice(4); });
}

TEST(TriangleIntersectionAgainstCgal, AgreesOnPairsThatNearlyTouch) {
  expect_same_answers_as_cgal(affordable(50'000), 4, [](RandomTriangles& random) { return random.nearly_touching(); });
}

TEST(TriangleIntersectionAgainstCgal, AgreesOnPairsThatAreNearlyCoplanar) {
  expect_same_answers_as_cgal(affordable(30'000), 5, [](RandomTriangles& random) { return random.nearly_coplanar(); });
}

TEST(TrianglesIntersect, DegenerateTriangleActsAsASegmentOrPoint) {
  const TrianglePoints triangle{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)};
  const auto meets = [&](const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    const Eigen::Vector3d middle = 0.5 * (p + q);
    const bool first = triangles_intersect(triangle, {p, q, middle});
    EXPECT_EQ(triangles_intersect(triangle, {middle, p, q}), first);
    EXPECT_EQ(triangles_intersect(triangle, {q, middle, p}), first);
    return first;
  };
  EXPECT_TRUE(meets({0.25, 0.25, -1}, {0.25, 0.25, 1}));    // through the face
  EXPECT_TRUE(meets({0.25, 0.25, 0}, {0.25, 0.25, 1}));     // ends on it
  EXPECT_TRUE(meets({1, 0, -1}, {1, 0, 1}));                // through a corner
  EXPECT_FALSE(meets({0.75, 0.75, -1}, {0.75, 0.75, 1}));   // past it
  EXPECT_FALSE(meets({0.25, 0.25, 0.5}, {0.25, 0.25, 1}));  // above it
  EXPECT_TRUE(meets({-1, 0.25, 0}, {2, 0.25, 0}));          // within its plane, across
  EXPECT_FALSE(meets({-1, 1.5, 0}, {2, 1.5, 0}));           // within its plane, past it
  EXPECT_FALSE(meets({-1, 0.25, 0}, {-0.5, 0.25, 0}));      // within its plane, too short
  EXPECT_FALSE(meets({-0.75, 0.3, -0.0625}, {0.5, 0.3, 0.25}));
  EXPECT_TRUE(meets({0.25, 0.25, 0}, {0.25, 0.25, 0}));  // a point
  EXPECT_FALSE(meets({0.25, 0.25, 1}, {0.25, 0.25, 1}));
  EXPECT_FALSE(meets({0.75, 0.75, 0}, {0.75, 0.75, 0}));
}

}  // namespace
}  // namespace glissade::geometry
