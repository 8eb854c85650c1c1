#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include <glissade/collision/mesh_generators.h>
#include <glissade/collision/mesh_operations.h>
#include <glissade/haptics/contact_search.h>

namespace glissade::haptics {
namespace {

using collision::TriangleMesh;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kReach = 1e-3;
constexpr double kMargin = 5e-6;

std::vector<Contact> contacts(const TriangleMesh& obstacle, const TriangleMesh& part, const Isometry3d& X_WV) {
  const auto part_V = std::make_shared<SlidingPart>(std::make_shared<TriangleMesh>(part));
  Surroundings surroundings({{std::make_shared<ContactBody>(std::make_shared<TriangleMesh>(obstacle))}}, {part_V},
                            std::array{kMargin}, kReach);
  surroundings.place(0, X_WV);
  CandidatePairs candidates(surroundings);
  candidates.refresh(kReach, {});
  std::vector<Contact> found;
  find_contacts(surroundings.bodies(), 1, candidates.within(kReach), kReach, kMargin, found);
  return found;
}

std::map<ContactKind, int> kinds(const std::vector<Contact>& contacts) {
  std::map<ContactKind, int> count;
  for (const Contact& contact : contacts)
    ++count[contact.kind];
  return count;
}

Isometry3d at(const Vector3d& p, const Eigen::Quaterniond& q = Eigen::Quaterniond::Identity()) {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = q.toRotationMatrix();
  X.translation() = p;
  return X;
}

TEST(ContactSearch, ABoxOnALargePlaneTouchesWithItsFourCornersOnly) {
  const auto found = contacts(collision::make_plate({1.0, 1.0}, 2), collision::make_box({0.1, 0.1, 0.1}, 12),
                              at({0.012, 0.004, 0.0501}));
  EXPECT_EQ(kinds(found), (std::map<ContactKind, int>{{ContactKind::kVertexFace, 4}}));
  for (const Contact& contact : found) {
    EXPECT_TRUE(contact.n_W.isApprox(Vector3d::UnitZ()));
    EXPECT_NEAR(contact.gap, 1e-4, 1e-12);
  }
}

TEST(ContactSearch, NormalsOfATessellatedAndFlippedPlaneAllPointStraightUp) {
  const TriangleMesh plane = collision::flip_randomly(collision::make_plate({1.0, 1.0}, 5000), 1);
  const TriangleMesh box = collision::flip_randomly(collision::make_box({0.1, 0.1, 0.1}, 600), 2);
  const auto found =
      contacts(plane, box, at({0.0123, 0.0045, 0.0501}, Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Vector3d::UnitZ()))));
  ASSERT_FALSE(found.empty());
  for (const Contact& contact : found)
    EXPECT_TRUE(contact.n_W.isApprox(Vector3d::UnitZ(), 1e-9));
}

TEST(ContactSearch, BelowASheetNormalsPointDown) {
  const auto found = contacts(collision::make_plate({1.0, 1.0}, 2), collision::make_box({0.1, 0.1, 0.1}, 12),
                              at({0.012, 0.004, -0.0501}));
  ASSERT_EQ(found.size(), 4u);
  for (const Contact& contact : found)
    EXPECT_TRUE(contact.n_W.isApprox(-Vector3d::UnitZ()));
}

TEST(ContactSearch, CrossedEdgesMeetAlongTheirCommonNormal) {
  // Two boxes turned to stand on an edge, one along x and one along y.
  const TriangleMesh box = collision::make_box({0.1, 0.1, 0.1}, 12);
  const double half_diagonal = 0.05 * std::sqrt(2.0);
  const TriangleMesh below = collision::transformed(
      box,
      at({0.0, 0.0, -half_diagonal}, Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 4, Vector3d::UnitX()))));
  const auto found = contacts(below, box,
                              at({0.001, 0.002, half_diagonal + 2e-4},
                                 Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 4, Vector3d::UnitY()))));
  ASSERT_EQ(kinds(found), (std::map<ContactKind, int>{{ContactKind::kEdgeEdge, 1}}));
  EXPECT_TRUE(found[0].n_W.isApprox(Vector3d::UnitZ(), 1e-9));
  EXPECT_NEAR(found[0].gap, 2e-4, 1e-12);
  EXPECT_TRUE(found[0].p_W.isApprox(Vector3d(0.001, 0.0, 2e-4), 1e-9));
}

TEST(ContactSearch, ACornerBesideTheRimOfASheetMeetsTheRim) {
  const auto found =
      contacts(collision::make_plate({0.2, 0.2}, 2), collision::make_box({0.1, 0.1, 0.1}, 12), at({0.1502, 0.0, 0.0}));
  // The box's side faces the rim from 0.2 mm away; nothing but horizontal normals can come of that.
  ASSERT_FALSE(found.empty());
  for (const Contact& contact : found)
    EXPECT_TRUE(contact.n_W.isApprox(Vector3d::UnitX(), 1e-9));
}

}  // namespace
}  // namespace glissade::haptics
