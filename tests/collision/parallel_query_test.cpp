#include "query/parallel_query.h"

#include <memory>
#include <vector>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <glissade/collision/dop_query.h>
#include <glissade/shapes/benchmark_shapes.h>

namespace glissade::collision {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

// Two copies of a part that lie so in each other that thousands of triangles meet.
class OverlappingParts : public testing::TestWithParam<int> {
 protected:
  template <typename Work>
  void with_threads(const Work& work) {
    const oneapi::tbb::global_control allowance(oneapi::tbb::global_control::max_allowed_parallelism,
                                                static_cast<std::size_t>(GetParam()));
    oneapi::tbb::task_arena(GetParam()).execute(work);
  }

  static Isometry3d pose(double shift) {
    Isometry3d X_AB = Isometry3d::Identity();
    X_AB.rotate(Eigen::AngleAxisd(0.3, Vector3d(1.0, 2.0, 3.0).normalized()));
    X_AB.translation() = shift * Vector3d(1.0, 0.2, 0.1);
    return X_AB;
  }

  const DopTree tree_{std::make_shared<geometry::TriangleMesh>(shapes::make_headlight(20'000))};
  const double size_ = tree_.radius();
};

TEST_P(OverlappingParts, HaveTheSameTrianglePairsAsForOneThread) {
  with_threads([&] {
    QueryWorkspace alone;
    ParallelWorkspace together;
    std::vector<TrianglePair> expected;
    std::vector<TrianglePair> found;
    for (const double shift : {0.02, 0.3, 0.5}) {
      const Isometry3d X_AB = pose(shift * size_);
      intersecting_pairs(tree_, tree_, X_AB, alone, expected);
      intersecting_pairs(tree_, tree_, X_AB, together, found);
      ASSERT_GT(expected.size(), 1000U);
      EXPECT_GT(together.pieces(), 1) << "too little work to be a test of anything";
      EXPECT_EQ(found, expected);
      EXPECT_EQ(together.counters().node_tests, alone.counters().node_tests) << "something was looked at twice";
      EXPECT_EQ(together.counters().triangle_tests, alone.counters().triangle_tests);
    }
  });
}

TEST_P(OverlappingParts, HaveTheSameClosePairsAsForOneThread) {
  with_threads([&] {
    QueryWorkspace alone;
    ParallelWorkspace together;
    std::vector<ClosePair> expected;
    std::vector<ClosePair> found;
    const Isometry3d X_AB = pose(0.3 * size_);
    pairs_within(tree_, tree_, X_AB, 0.002 * size_, alone, expected);
    pairs_within(tree_, tree_, X_AB, 0.002 * size_, together, found);
    ASSERT_GT(expected.size(), 1000U);
    EXPECT_GT(together.pieces(), 1);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].triangles, expected[i].triangles);
      EXPECT_EQ(found[i].distance, expected[i].distance);
      EXPECT_EQ(found[i].p_A, expected[i].p_A);
      EXPECT_EQ(found[i].p_B, expected[i].p_B);
    }
  });
}

TEST_P(OverlappingParts, LittleWorkIsNotDivided) {
  with_threads([&] {
    ParallelWorkspace workspace;
    std::vector<TrianglePair> pairs{{1, 2}};
    intersecting_pairs(tree_, tree_, pose(1.9 * size_), workspace, pairs);
    EXPECT_TRUE(pairs.empty());
    EXPECT_EQ(workspace.pieces(), 0);
  });
}

INSTANTIATE_TEST_SUITE_P(Threads, OverlappingParts, testing::Values(1, 2, 4));

}  // namespace
}  // namespace glissade::collision
