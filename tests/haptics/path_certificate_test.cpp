#include <memory>

#include <gtest/gtest.h>

#include <glissade/haptics/path_certificate.h>

namespace glissade::haptics {
namespace {

constexpr double kFloor = 1e-6;

std::shared_ptr<const collision::TriangleMesh> one_triangle(double z) {
  auto mesh = std::make_shared<collision::TriangleMesh>();
  mesh->vertices = {{-1.0, -1.0, z}, {1.0, -1.0, z}, {0.0, 1.0, z}};
  mesh->triangles = {{0, 1, 2}};
  return mesh;
}

/// A triangle above another one, both without thickness.
class TwoTriangles : public ::testing::Test {
 protected:
  bool proves(const Eigen::Isometry3d& X_WV, const Displacement& d) {
    CandidatePairs candidates(obstacle_, part_);
    candidates.refresh(X_WV, 10.0);
    std::vector<UncertifiedPair> failures;
    return PathCertificate(obstacle_, part_, kFloor).prove(X_WV, d, candidates.within(10.0), failures);
  }
  static Eigen::Isometry3d at_height(double z) { return Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, z)); }

  ContactBody obstacle_{one_triangle(0.0)};
  SlidingPart part_{one_triangle(0.0)};
};

TEST_F(TwoTriangles, ApproachIsProvedDownToTheFloorAndNotBelow) {
  const Displacement down{{0.0, 0.0, -1e-3}, Eigen::Vector3d::Zero()};
  EXPECT_TRUE(proves(at_height(1e-3 + 1.01 * kFloor), down));
  EXPECT_FALSE(proves(at_height(1e-3 + 0.99 * kFloor), down));
}

TEST_F(TwoTriangles, PassingThroughIsNotProvedThoughBothEndsAreFree) {
  EXPECT_FALSE(proves(at_height(0.1), {{0.0, 0.0, -0.2}, Eigen::Vector3d::Zero()}));
  EXPECT_TRUE(proves(at_height(0.1), {{0.5, 0.0, 0.2}, Eigen::Vector3d::Zero()}));
}

TEST_F(TwoTriangles, TurningThroughIsNotProvedThoughBothEndsAreFree) {
  // Half a turn about x sweeps a triangle that stands beside the other through it.
  const Displacement flip{{0.0, 0.0, 0.0}, {3.0, 0.0, 0.0}};
  EXPECT_FALSE(proves(at_height(0.3), flip));
  EXPECT_TRUE(proves(at_height(3.0), flip));
}

TEST_F(TwoTriangles, APairThatStartsNearerThanTheFloorMayStayButHardlyApproach) {
  const double gap = 0.5 * kFloor;
  EXPECT_TRUE(proves(at_height(gap), {{1e-3, 0.0, 0.0}, Eigen::Vector3d::Zero()}));
  EXPECT_TRUE(proves(at_height(gap), {{0.0, 0.0, -0.04 * gap}, Eigen::Vector3d::Zero()}));
  EXPECT_FALSE(proves(at_height(gap), {{0.0, 0.0, -0.06 * gap}, Eigen::Vector3d::Zero()}));
}

}  // namespace
}  // namespace glissade::haptics
