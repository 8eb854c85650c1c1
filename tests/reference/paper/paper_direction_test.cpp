// New directions from one, two, three and more contact points.

#include "paper/paper_direction.h"

#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/spring.h>

namespace glissade::reference {
namespace {

using Eigen::Vector3d;

const Vector3d kX = Vector3d::UnitX();
const Vector3d kY = Vector3d::UnitY();
const Vector3d kZ = Vector3d::UnitZ();
const Vector3d kWanted(-1.0, -2.0, -3.0);

NewTranslation translation(const std::vector<Vector3d>& normals) {
  return new_translation(kWanted, normals);
}

void expect_translation(const std::vector<Vector3d>& normals, const Vector3d& expected, int planes) {
  const NewTranslation found = translation(normals);
  EXPECT_LT((found.v - expected).norm(), 1e-12) << found.v.transpose();
  EXPECT_EQ(found.planes, planes);
}

TEST(NewTranslation, UnchangedWithoutContact) {
  expect_translation({}, kWanted, 0);
}

TEST(NewTranslation, OfOneContactIsInItsTangentPlane) {
  expect_translation({kZ}, {-1.0, -2.0, 0.0}, 1);
  expect_translation({(kX + kZ).normalized()}, {1.0, -2.0, -1.0}, 1);
}

TEST(NewTranslation, UnchangedByAContactThatItLeaves) {
  expect_translation({-kZ}, kWanted, 0);
}

TEST(NewTranslation, OfTwoContactsIsAlongBothPlanes) {
  expect_translation({kY, kZ}, {-1.0, 0.0, 0.0}, 2);
}

TEST(NewTranslation, OnePlaneOfTwoContactsSufficesIfItClearsTheOther) {
  // Along the plane z = 0 it moves away from the second one already.
  expect_translation({kZ, (kZ - kX).normalized()}, {-1.0, -2.0, 0.0}, 1);
}

TEST(NewTranslation, BetweenTwoOpposedPlanesIsAlongThem) {
  expect_translation({kZ, -kZ}, {-1.0, -2.0, 0.0}, 1);
}

TEST(NewTranslation, ZeroForThreeIndependentNormals) {
  expect_translation({kX, kY, kZ}, Vector3d::Zero(), 3);
}

TEST(NewTranslation, DependentNormalsDoNotCount) {
  expect_translation({kZ, kZ, kZ, kZ}, {-1.0, -2.0, 0.0}, 1);
  expect_translation({kY, kZ, (kY + kZ).normalized()}, {-1.0, 0.0, 0.0}, 2);
}

TEST(NewTranslation, ManyNormalsRespectTheMostOpposed) {
  // A fan of planes about the x axis, steeper and steeper, all of them opposed to the motion.
  std::vector<Vector3d> fan;
  for (int i = 0; i <= 200; ++i)
    fan.push_back((i * kY + (200 - i) * kZ).normalized());
  const NewTranslation found = translation(fan);
  EXPECT_GT(found.planes, 0);
  EXPECT_LE(found.v.dot(kWanted), kWanted.squaredNorm());
  EXPECT_GE(found.v.dot(fan[120]), -1e-9) << "the most opposed of all";
}

TEST(NewMotion, OfAContactBesideTheMiddleTurnsThePart) {
  // The part goes down and one point of it, 0.1 m ahead along x, is held: with k_r = k_t ρ², ρ = 0.1 m, the least
  // change turns it upwards there.
  const contact::CouplingStiffness stiffness{1000.0, 10.0};
  contact::ProjectionSolver solver;
  const contact::ConstraintRow row{kZ, 0.1 * kX, 0.0};
  const std::optional<geometry::Displacement> found =
      new_motion({-1e-3 * kZ, Vector3d::Zero()}, stiffness, {&row, 1}, solver);
  ASSERT_TRUE(found);
  EXPECT_LT((found->v - Vector3d(0.0, 0.0, -0.5e-3)).norm(), 1e-12);
  EXPECT_LT((found->w - Vector3d(0.0, -5e-3, 0.0)).norm(), 1e-12);
}

TEST(NewMotion, ThreePointsOfAPlaneAllowOnlyPlanarMotion) {
  const contact::CouplingStiffness stiffness{1000.0, 10.0};
  contact::ProjectionSolver solver;
  const std::vector<contact::ConstraintRow> rows{
      {kZ, 0.1 * kX, 0.0}, {kZ, 0.1 * kY - 0.1 * kX, 0.0}, {kZ, -0.1 * kY - 0.1 * kX, 0.0}};
  const std::optional<geometry::Displacement> found =
      new_motion({1e-3 * (kX - kZ), 1e-3 * kZ}, stiffness, rows, solver);
  ASSERT_TRUE(found);
  EXPECT_LT((found->v - 1e-3 * kX).norm(), 1e-12);
  EXPECT_LT((found->w - 1e-3 * kZ).norm(), 1e-12) << "it may turn about the normal";
}

TEST(NewMotion, NoneForInfeasibleOpposedContacts) {
  const contact::CouplingStiffness stiffness{1000.0, 10.0};
  contact::ProjectionSolver solver;
  const std::vector<contact::ConstraintRow> rows{{kZ, Vector3d::Zero(), 1e-6}, {-kZ, Vector3d::Zero(), 1e-6}};
  EXPECT_FALSE(new_motion({1e-3 * kX, Vector3d::Zero()}, stiffness, rows, solver));
}

}  // namespace
}  // namespace glissade::reference
