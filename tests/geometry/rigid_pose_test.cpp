#include <cmath>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

#include <glissade/geometry/displacement.h>

#include "random_numbers.h"

namespace glissade::geometry {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;

constexpr std::uint64_t kRigidPoseSeed = 20261122;

double defect(const Matrix3d& R) {
  return (R.transpose() * R - Matrix3d::Identity()).cwiseAbs().sum();
}

Isometry3d with_rotation(const Matrix3d& R) {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = R;
  return X;
}

TEST(RigidPose, ExactRotationIsUnchanged) {
  RecordProperty("seed", static_cast<int>(kRigidPoseSeed));
  test_support::RandomNumbers random(kRigidPoseSeed);
  for (int i = 0; i < 1000; ++i) {
    Isometry3d X = with_rotation(random.rotation() * random.rotation() * random.rotation());
    X.translation() = random.point(1e9);
    const std::optional<Isometry3d> rigid = rigid_pose(X);
    ASSERT_TRUE(rigid.has_value()) << "seed " << kRigidPoseSeed << ", case " << i;
    ASSERT_EQ(rigid->matrix(), X.matrix()) << "seed " << kRigidPoseSeed << ", case " << i;
  }
}

// Stretched, sheared, one column only, or all entries.
TEST(RigidPose, NearRotationBecomesARotation) {
  RecordProperty("seed", static_cast<int>(kRigidPoseSeed));
  test_support::RandomNumbers random(kRigidPoseSeed);
  int kept = 0;
  for (int i = 0; i < 20000; ++i) {
    const Matrix3d R = random.chance(0.5) ? random.rotation() : random.cube_rotation();
    Matrix3d off = Matrix3d::Zero();
    const double size = random.power_of_ten(-15.0, -6.0);
    if (random.chance(0.5)) {
      off.col(random.integer(0, 2)) = size * random.point(1.0);
    } else {
      for (int column = 0; column < 3; ++column)
        off.col(column) = size * random.point(1.0);
    }
    const std::optional<Isometry3d> rigid = rigid_pose(with_rotation(R + off));
    ASSERT_TRUE(rigid.has_value()) << "seed " << kRigidPoseSeed << ", case " << i;
    ASSERT_LT(defect(rigid->linear()), 1.001e-12) << "seed " << kRigidPoseSeed << ", case " << i;
    // The nearest rotation is no further than this one.
    ASSERT_LE((rigid->linear() - R - off).norm(), 1.001 * off.norm() + 1e-15)
        << "seed " << kRigidPoseSeed << ", case " << i;
    kept += rigid->linear() == R + off ? 1 : 0;
  }
  EXPECT_GT(kept, 1000);
}

TEST(RigidPose, NoneForInvalidPoses) {
  EXPECT_FALSE(rigid_pose(with_rotation(1.001 * Matrix3d::Identity())).has_value());
  EXPECT_FALSE(rigid_pose(with_rotation(Eigen::Vector3d(1.0, 1.0, -1.0).asDiagonal())).has_value()) << "a reflection";
  EXPECT_FALSE(rigid_pose(with_rotation(Matrix3d::Zero())).has_value());
  EXPECT_FALSE(rigid_pose(with_rotation(Matrix3d::Constant(std::nan("")))).has_value());
  for (const double coordinate : {2e9, std::numeric_limits<double>::infinity(), std::nan("")}) {
    Isometry3d X = Isometry3d::Identity();
    X.translation().y() = coordinate;
    EXPECT_FALSE(rigid_pose(X).has_value()) << coordinate;
  }
}

}  // namespace
}  // namespace glissade::geometry
