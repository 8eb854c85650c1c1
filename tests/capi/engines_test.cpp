// Frames of game engines, against points and rotations that one can check by hand.

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <glissade/glissade.h>

namespace glissade {
namespace {

const double kHalf = std::sqrt(0.5);  // cosine and sine of half a right angle

void expect_pose(const GlissadePose& pose, const GlissadePose& wanted) {
  EXPECT_NEAR(pose.x, wanted.x, 1e-12);
  EXPECT_NEAR(pose.y, wanted.y, 1e-12);
  EXPECT_NEAR(pose.z, wanted.z, 1e-12);
  EXPECT_NEAR(pose.qw, wanted.qw, 1e-12);
  EXPECT_NEAR(pose.qx, wanted.qx, 1e-12);
  EXPECT_NEAR(pose.qy, wanted.qy, 1e-12);
  EXPECT_NEAR(pose.qz, wanted.qz, 1e-12);
}

GlissadePose in(GlissadeEngine engine, const GlissadePose& pose) {
  GlissadePose out{};
  EXPECT_EQ(glissade_pose_to_engine(engine, &pose, &out), GLISSADE_OK);
  return out;
}

/// A point 1 m ahead, 2 m to the left and 3 m up.
TEST(Engines, APointAheadIsAheadInEveryEngine) {
  const GlissadePose point{1, 2, 3, 1, 0, 0, 0};
  expect_pose(in(GLISSADE_UNITY, point), {-2, 3, 1, 1, 0, 0, 0});
  expect_pose(in(GLISSADE_UNREAL, point), {100, -200, 300, 1, 0, 0, 0});
}

/// A quarter turn to the left, seen from above: what was ahead is now on the left. In Unity and Unreal, a positive
/// angle about the upward axis turns to the right (both are left-handed), so the turn is one by -90° there.
TEST(Engines, ATurnToTheLeftIsATurnToTheLeft) {
  const GlissadePose turn{0, 0, 0, kHalf, 0, 0, kHalf};
  expect_pose(in(GLISSADE_UNITY, turn), {0, 0, 0, kHalf, 0, -kHalf, 0});
  expect_pose(in(GLISSADE_UNREAL, turn), {0, 0, 0, kHalf, 0, 0, -kHalf});
}

/// The nose goes down by a quarter turn: in W about y, which points to the left. In Unity, a positive angle about x
/// lowers the nose. In Unreal, a pitch of -90° does, which FRotator::Quaternion makes a positive y.
TEST(Engines, ANoseThatGoesDownGoesDown) {
  const GlissadePose nose_down{0, 0, 0, kHalf, 0, kHalf, 0};
  expect_pose(in(GLISSADE_UNITY, nose_down), {0, 0, 0, kHalf, kHalf, 0, 0});
  expect_pose(in(GLISSADE_UNREAL, nose_down), {0, 0, 0, kHalf, 0, kHalf, 0});
}

TEST(Engines, PosesComeBack) {
  const GlissadePose pose{0.1, -0.2, 0.3, 0.5, -0.5, 0.5, 0.5};
  for (const GlissadeEngine engine : {GLISSADE_UNITY, GLISSADE_UNREAL}) {
    const GlissadePose there = in(engine, pose);
    GlissadePose back{};
    EXPECT_EQ(glissade_pose_from_engine(engine, &there, &back), GLISSADE_OK);
    expect_pose(back, pose);
  }
}

/// The rotated point, with the formula for quaternions, which is the same in every frame.
void rotate(const GlissadePose& q, const double p[3], double out[3]) {
  const double u[3] = {q.qx, q.qy, q.qz};
  const double dot = u[0] * p[0] + u[1] * p[1] + u[2] * p[2];
  const double uu = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
  const double cross[3] = {u[1] * p[2] - u[2] * p[1], u[2] * p[0] - u[0] * p[2], u[0] * p[1] - u[1] * p[0]};
  for (int i = 0; i < 3; ++i)
    out[i] = 2 * dot * u[i] + (q.qw * q.qw - uu) * p[i] + 2 * q.qw * cross[i];
}

/// To rotate and then to convert is the same as to convert and then to rotate.
TEST(Engines, RotationsAreThoseOfTheConvertedPoints) {
  const GlissadePose pose{0, 0, 0, 0.1, 0.7, -0.5, 0.5};  // of unit length
  const double point[3] = {0.3, -0.4, 1.2};
  for (const GlissadeEngine engine : {GLISSADE_UNITY, GLISSADE_UNREAL}) {
    double turned[3], turned_in_engine[3], point_in_engine[3], wanted[3];
    rotate(pose, point, turned);
    glissade_vector_to_engine(engine, turned, wanted);
    glissade_vector_to_engine(engine, point, point_in_engine);
    rotate(in(engine, pose), point_in_engine, turned_in_engine);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(turned_in_engine[i], wanted[i], 1e-12);
  }
}

TEST(Engines, ForcesTurnAndKeepTheirSize) {
  const double force_N[3] = {1, 2, 3};
  double out[3], back[3];
  ASSERT_EQ(glissade_vector_to_engine(GLISSADE_UNREAL, force_N, out), GLISSADE_OK);
  EXPECT_EQ(out[0], 1.0);
  EXPECT_EQ(out[1], -2.0);
  EXPECT_EQ(out[2], 3.0);
  ASSERT_EQ(glissade_vector_to_engine(GLISSADE_UNITY, force_N, out), GLISSADE_OK);
  ASSERT_EQ(glissade_vector_from_engine(GLISSADE_UNITY, out, back), GLISSADE_OK);
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(back[i], force_N[i]);
}

/// A torque is the cross product of a lever and a force. Left-handed frames use the same formula.
TEST(Engines, ATorqueIsThatOfTheConvertedLeverAndForce) {
  const double lever_m[3] = {0.1, -0.2, 0.3};
  const double force_N[3] = {4, 5, 6};
  const Eigen::Vector3d torque_Nm = Eigen::Vector3d(lever_m).cross(Eigen::Vector3d(force_N));
  for (const GlissadeEngine engine : {GLISSADE_UNITY, GLISSADE_UNREAL}) {
    Eigen::Vector3d lever_in_engine, force_in_engine, torque_in_engine, back;
    ASSERT_EQ(glissade_vector_to_engine(engine, lever_m, lever_in_engine.data()), GLISSADE_OK);
    ASSERT_EQ(glissade_vector_to_engine(engine, force_N, force_in_engine.data()), GLISSADE_OK);
    ASSERT_EQ(glissade_torque_to_engine(engine, torque_Nm.data(), torque_in_engine.data()), GLISSADE_OK);
    EXPECT_EQ(torque_in_engine, lever_in_engine.cross(force_in_engine));
    ASSERT_EQ(glissade_torque_from_engine(engine, torque_in_engine.data(), back.data()), GLISSADE_OK);
    EXPECT_EQ(back, torque_Nm);
  }
}

}  // namespace
}  // namespace glissade
