#include "query/oriented_boxes.h"

#include <memory>
#include <numeric>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>

#include "kernel_fixture.h"
#include "random_numbers.h"
#include "sanitizers.h"

namespace glissade::collision {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr unsigned kOrientedBoxesSeed = 23;

// Two solid boxes at a random pose, somewhere about touching.
class TwoBoxes {
 public:
  explicit TwoBoxes(test_support::RandomNumbers& random, const Vector3d& center = Vector3d::Zero(), double defect = 0.0)
      : size_A_(random_size(random)),
        size_B_(random_size(random)),
        tree_A_(tree(size_A_, center)),
        tree_B_(tree(size_B_, -center)) {
    X_AB_.linear() = random.rotation();
    for (int column = 0; column < 3; ++column)
      X_AB_.linear().col(column) += random.point(defect);
    X_AB_.translation() = center + X_AB_.linear() * center + random.point(0.35 * (size_A_.norm() + size_B_.norm()));
  }

  // Moves B from where the surfaces meet along a direction, as far as they do.
  bool move_to_contact(const Vector3d& direction) {
    if (distance() > 0.0) return false;
    const Vector3d start = X_AB_.translation();
    const auto move = [&](double along) { X_AB_.translation() = start + along * direction; };
    double meeting = 0.0;
    double apart = 8.0;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (meeting + apart);
      move(middle);
      (distance() > 0.0 ? apart : meeting) = middle;
    }
    move(meeting);
    return true;
  }

  // Of the surfaces; 0 when they meet.
  double distance() const {
    std::vector<std::int32_t> all(12);
    std::iota(all.begin(), all.end(), 0);
    return least_distance(tree_A_, all, tree_B_, all, X_AB_);
  }

  bool one_is_inside_the_other() const {
    const Vector3d p_AB = X_AB_.translation();
    const Vector3d p_BA = X_AB_.inverse().translation();
    return (2.0 * p_AB.cwiseAbs() - size_A_).maxCoeff() < 0.0 || (2.0 * p_BA.cwiseAbs() - size_B_).maxCoeff() < 0.0;
  }

  bool apart(double distance) const {
    const QueryFrame frame(tree_A_, tree_B_, X_AB_);
    const DopTree& base = frame.base_is_A ? tree_A_ : tree_B_;
    const DopTree& other = frame.base_is_A ? tree_B_ : tree_A_;
    return boxes_apart(base, other, frame, frame.in_base_radii(distance));
  }

 private:
  static Vector3d random_size(test_support::RandomNumbers& random) {
    return {random.uniform(0.01, 2.0), random.uniform(0.01, 2.0), random.uniform(0.01, 2.0)};
  }
  static DopTree tree(const Vector3d& size, const Vector3d& center) {
    geometry::TriangleMesh mesh = geometry::make_box(size, 12);
    for (Vector3d& vertex : mesh.vertices)
      vertex += center;
    return DopTree(std::make_shared<const geometry::TriangleMesh>(std::move(mesh)));
  }

  Vector3d size_A_;
  Vector3d size_B_;
  DopTree tree_A_;
  DopTree tree_B_;
  Isometry3d X_AB_ = Isometry3d::Identity();
};

TEST(OrientedBoxes, AreApartWhenAndOnlyWhenTheSolidsAre) {
  RecordProperty("seed", static_cast<int>(kOrientedBoxesSeed));
  test_support::RandomNumbers random(kOrientedBoxesSeed);
  constexpr int kTrials = test_support::affordable(4000);
  int apart = 0;
  int meeting = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const TwoBoxes boxes(random);
    const double distance = boxes.distance();
    if (distance > 1e-9 && !boxes.one_is_inside_the_other()) {
      ++apart;
      ASSERT_TRUE(boxes.apart(0.0)) << "trial " << trial << ", seed " << kOrientedBoxesSeed;
    } else {
      ++meeting;
      ASSERT_FALSE(boxes.apart(0.0)) << "trial " << trial << ", seed " << kOrientedBoxesSeed;
    }
  }
  EXPECT_GT(apart, kTrials / 4);
  EXPECT_GT(meeting, kTrials / 4);
}

// The matrix is a rotation but for up to a thousandth, and the meshes lie far from their origins; the boxes just meet.
TEST(OrientedBoxes, TouchingBoxesAreNotApartForInexactRotationsAndOffsets) {
  RecordProperty("seed", static_cast<int>(kOrientedBoxesSeed));
  test_support::RandomNumbers random(kOrientedBoxesSeed);
  constexpr int kTrials = test_support::affordable(600);
  int compared = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double offset = trial % 3 == 0 ? 0.0 : random.power_of_ten(0.0, 6.0);
    TwoBoxes boxes(random, offset * random.direction(), random.power_of_ten(-9.0, -4.0));
    if (!boxes.move_to_contact(random.direction())) continue;
    ++compared;
    ASSERT_FALSE(boxes.apart(0.0)) << "trial " << trial << ", seed " << kOrientedBoxesSeed;
  }
  EXPECT_GT(compared, kTrials / 3);
}

TEST(OrientedBoxes, GapNeverExceedsTheDistance) {
  RecordProperty("seed", static_cast<int>(kOrientedBoxesSeed));
  test_support::RandomNumbers random(kOrientedBoxesSeed);
  constexpr int kTrials = test_support::affordable(4000);
  int told_apart = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const TwoBoxes boxes(random);
    const double distance = boxes.distance();
    ASSERT_FALSE(boxes.apart(distance)) << "trial " << trial << ", seed " << kOrientedBoxesSeed;
    told_apart += boxes.apart(0.7 * distance) ? 1 : 0;
  }
  EXPECT_GT(told_apart, kTrials / 8);
}

}  // namespace
}  // namespace glissade::collision
