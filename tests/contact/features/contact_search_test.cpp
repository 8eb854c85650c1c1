#include "features/contact_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>

#include "near_bodies.h"
#include "poses.h"
#include "random_numbers.h"
#include "sanitizers.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::TriangleMesh;
using test_support::pose;
using test_support::turn_from_to;

constexpr double kSearchReach = 1e-3;
constexpr double kSearchMargin = 5e-6;

/// An obstacle, at the origin or elsewhere, and a part.
class TwoBodies {
 public:
  TwoBodies(const geometry::TriangleMesh& obstacle, const geometry::TriangleMesh& part,
            const Isometry3d& X_WO = Isometry3d::Identity())
      : scene_({{std::make_shared<ContactBody>(std::make_shared<geometry::TriangleMesh>(obstacle)), X_WO}},
               {std::make_shared<SlidingPart>(std::make_shared<geometry::TriangleMesh>(part))},
               std::array{kSearchMargin}) {}

  std::vector<Contact> contacts_at(const Isometry3d& X_WV) {
    scene_.place(0, X_WV);
    candidates_.clear();
    candidates_.look(kSearchReach, 0.0, {});
    std::vector<TrianglesOfBodies> pairs;
    candidates_.pairs().within(kSearchReach, pairs);
    std::vector<Contact> found;
    find_contacts(scene_.bodies(), 1, pairs, kSearchReach, kSearchMargin, found);
    return found;
  }

 private:
  ContactScene scene_;
  CandidatePairs candidates_{scene_, kSearchReach};
};

std::vector<Contact> contacts(const geometry::TriangleMesh& obstacle, const geometry::TriangleMesh& part,
                              const Isometry3d& X_WV) {
  return TwoBodies(obstacle, part).contacts_at(X_WV);
}

std::map<ContactKind, int> kinds(const std::vector<Contact>& contacts) {
  std::map<ContactKind, int> count;
  for (const Contact& contact : contacts)
    ++count[contact.kind];
  return count;
}

TEST(ContactSearch, ABoxOnALargePlaneTouchesWithItsFourCornersOnly) {
  const auto found = contacts(geometry::make_plate({1.0, 1.0}, 2), geometry::make_box({0.1, 0.1, 0.1}, 12),
                              pose({0.012, 0.004, 0.0501}));
  EXPECT_EQ(kinds(found), (std::map<ContactKind, int>{{ContactKind::kVertexFace, 4}}));
  for (const Contact& contact : found) {
    EXPECT_TRUE(contact.n_W.isApprox(Vector3d::UnitZ()));
    EXPECT_NEAR(contact.gap, 1e-4, 1e-12);
  }
}

TEST(ContactSearch, RangeOfACornerContactReachesThePlateBorderAcrossFlatEdges) {
  // The plate reaches to x = 0.2, the box to x = 0.195; the diagonal of the plate is no border.
  const auto found = contacts(geometry::make_plate({0.4, 0.4}, 2), geometry::make_box({0.1, 0.1, 0.1}, 12),
                              pose({0.145, 0.0, 0.0501}));
  double least = 1.0;
  for (const Contact& contact : found) {
    EXPECT_EQ(contact.kind, ContactKind::kVertexFace);
    least = std::min(least, contact.range);
  }
  EXPECT_NEAR(least, 0.005, 1e-12);
}

TEST(ContactSearch, NormalsOfATessellatedAndFlippedPlaneAllPointStraightUp) {
  const geometry::TriangleMesh plane = geometry::flip_randomly(geometry::make_plate({1.0, 1.0}, 5000), 1);
  const geometry::TriangleMesh box = geometry::flip_randomly(geometry::make_box({0.1, 0.1, 0.1}, 600), 2);
  const auto found = contacts(
      plane, box, pose({0.0123, 0.0045, 0.0501}, Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Vector3d::UnitZ()))));
  ASSERT_FALSE(found.empty());
  for (const Contact& contact : found)
    EXPECT_TRUE(contact.n_W.isApprox(Vector3d::UnitZ(), 1e-9));
}

TEST(ContactSearch, BelowASheetNormalsPointDown) {
  const auto found = contacts(geometry::make_plate({1.0, 1.0}, 2), geometry::make_box({0.1, 0.1, 0.1}, 12),
                              pose({0.012, 0.004, -0.0501}));
  ASSERT_EQ(found.size(), 4u);
  for (const Contact& contact : found)
    EXPECT_TRUE(contact.n_W.isApprox(-Vector3d::UnitZ()));
}

TEST(ContactSearch, CrossedEdgesMeetAlongTheirCommonNormal) {
  // Two boxes turned to stand on an edge, one along x and one along y.
  const geometry::TriangleMesh box = geometry::make_box({0.1, 0.1, 0.1}, 12);
  const double half_diagonal = 0.05 * std::sqrt(2.0);
  const geometry::TriangleMesh below = geometry::transformed(
      box,
      pose({0.0, 0.0, -half_diagonal}, Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 4, Vector3d::UnitX()))));
  const auto found = contacts(below, box,
                              pose({0.001, 0.002, half_diagonal + 2e-4},
                                   Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 4, Vector3d::UnitY()))));
  ASSERT_EQ(kinds(found), (std::map<ContactKind, int>{{ContactKind::kEdgeEdge, 1}}));
  EXPECT_TRUE(found[0].n_W.isApprox(Vector3d::UnitZ(), 1e-9));
  EXPECT_NEAR(found[0].gap, 2e-4, 1e-12);
  EXPECT_NEAR(found[0].range, 0.048, 1e-9) << "to the nearer end of the upper edge";
  EXPECT_TRUE(found[0].p_W.isApprox(Vector3d(0.001, 0.0, 2e-4), 1e-9));
}

// A pair whose contacts beyond the reach are certainly farther than another reach has none between the two.
TEST(ContactSearch, ReturnsALowerBoundOfGapsBeyondItsReach) {
  constexpr std::uint64_t kSeed = 9;
  RecordProperty("seed", static_cast<int>(kSeed));
  test_support::RandomNumbers random(kSeed);
  int complete = 0;
  int contacts_beyond = 0;
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const auto scene = test_support::random_contact_scene(0.02, 1e-4, 2e-4, random);
    const double reach = random.power_of_ten(-3.5, -2.5);
    const double reach_ahead = 1.5 * reach;
    CandidatePairs candidates(*scene, reach_ahead);
    candidates.look(reach_ahead, 0.0, {});
    std::vector<TrianglesOfBodies> pairs;
    candidates.pairs().within(reach_ahead, pairs);
    const std::size_t first_part = scene->obstacles().size();
    std::vector<Contact> within;
    std::vector<GapsOfPair> gaps;
    find_contacts(scene->bodies(), first_part, pairs, reach, kSearchMargin, within, &gaps);
    ASSERT_EQ(gaps.size(), pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      std::vector<Contact> ahead;
      find_contacts(scene->bodies(), first_part, {&pairs[i], 1}, reach_ahead, kSearchMargin, ahead);
      for (const Contact& contact : ahead) {
        EXPECT_GE(contact.gap, gaps[i].least);
        if (contact.gap <= reach) continue;
        EXPECT_GE(contact.gap, gaps[i].beyond);
        ++contacts_beyond;
      }
      complete += gaps[i].beyond > reach_ahead ? 1 : 0;
    }
  }
  EXPECT_GT(contacts_beyond, 100);
  EXPECT_GT(complete, 1000);
}

// The vector code looks at many pairs only.
TEST(ContactSearch, BatchFindsTheContactsOfSinglePairs) {
  constexpr std::uint64_t kSeed = 8;
  RecordProperty("seed", static_cast<int>(kSeed));
  test_support::RandomNumbers random(kSeed);
  constexpr double kNoMargin = 1e-12;  // nothing is left out at rims
  std::size_t contacts = 0;
  for (int trial = 0; trial < test_support::affordable(100); ++trial) {
    const auto scene = test_support::random_contact_scene(0.02, 1e-4, 2e-4, random);
    const double reach = random.power_of_ten(-3.5, -2.5);
    CandidatePairs candidates(*scene, reach);
    candidates.look(reach, 0.0, {});
    std::vector<TrianglesOfBodies> pairs;
    candidates.pairs().within(reach, pairs);
    const std::size_t first_part = scene->obstacles().size();
    std::vector<Contact> of_all;
    find_contacts(scene->bodies(), first_part, pairs, reach, kNoMargin, of_all);
    std::size_t i = 0;
    for (const TrianglesOfBodies& pair : pairs) {
      std::vector<Contact> of_one;
      find_contacts(scene->bodies(), first_part, {&pair, 1}, reach, kNoMargin, of_one);
      for (const Contact& contact : of_one) {
        ASSERT_LT(i, of_all.size()) << "trial " << trial;
        EXPECT_EQ(contact.kind, of_all[i].kind);
        EXPECT_EQ(contact.part_feature, of_all[i].part_feature);
        EXPECT_EQ(contact.obstacle_feature, of_all[i].obstacle_feature);
        EXPECT_EQ(contact.gap, of_all[i++].gap);
      }
    }
    ASSERT_EQ(i, of_all.size()) << "trial " << trial;
    contacts += i;
  }
  EXPECT_GT(contacts, static_cast<std::size_t>(test_support::affordable(200)));
}

/// The corners of feature `number` of a mesh, a vertex, edge or face.
std::vector<Vector3d> corners(const geometry::TriangleMesh& mesh, char feature, std::int32_t number) {
  const auto i = static_cast<std::size_t>(number);
  const auto vertex = [&](std::int32_t v) { return mesh.vertices.at(static_cast<std::size_t>(v)); };
  if (feature == 'v') return {vertex(number)};
  if (feature == 'f') return {mesh.corner(number, 0), mesh.corner(number, 1), mesh.corner(number, 2)};
  const geometry::MeshTopology topology(mesh);
  const geometry::MeshTopology::Edge& edge = topology.edges().at(i);
  return {vertex(edge.vertices[0]), vertex(edge.vertices[1])};
}

/// How far x is from the line, plane or point of a feature, metres.
double distance_from(const std::vector<Vector3d>& corners, const Vector3d& x) {
  if (corners.size() == 1) return (x - corners[0]).norm();
  const Vector3d along = (corners[1] - corners[0]).normalized();
  if (corners.size() == 2) return along.cross(x - corners[0]).norm();
  return std::abs(along.cross(corners[2] - corners[0]).normalized().dot(x - corners[0]));
}

TEST(ContactSearch, ReportedFeaturesContainTheContactPoints) {
  // A ball over a face, an edge and a corner of a box, turned in many ways: all kinds of features meet.
  const geometry::TriangleMesh box = geometry::make_box({0.1, 0.1, 0.1}, 100);
  const geometry::TriangleMesh ball = geometry::flip_randomly(geometry::make_sphere(0.05, 300), 5);
  const std::vector<Vector3d> nearest{{0.01, 0.02, 0.05}, {0.05, 0.012, 0.05}, {0.05, 0.05, 0.05}};
  const std::vector<Vector3d> away{{0.0, 0.0, 1.0}, {1.0, 0.0, 1.0}, {1.0, 1.0, 1.0}};
  std::map<ContactKind, int> seen;
  const auto check = [&](const geometry::TriangleMesh& mesh, const Isometry3d& X_WV) {
    for (const Contact& contact : contacts(box, mesh, X_WV)) {
      ++seen[contact.kind];
      const auto name = std::string(name_of(contact.kind));
      const auto part = corners(mesh, name[0], contact.part_feature);
      const auto obstacle = corners(box, name[name.find('/') + 1], contact.obstacle_feature);
      ASSERT_LT(distance_from(part, X_WV.inverse() * contact.p_W), 1e-12) << name;
      ASSERT_LT(distance_from(obstacle, contact.q_W()), 1e-12) << name;
      // The reported triangles have these features.
      for (const auto& [of, triangle, feature] :
           {std::tuple(&mesh, contact.part_triangle, part), std::tuple(&box, contact.obstacle_triangle, obstacle)}) {
        const auto of_triangle = corners(*of, 'f', triangle);
        for (const Vector3d& corner : feature)
          ASSERT_NE(std::find(of_triangle.begin(), of_triangle.end(), corner), of_triangle.end()) << name;
      }
    }
  };
  check(box, pose({0.1001, 0.1001, 0.1001}));  // corner to corner
  for (std::size_t i = 0; i < 300; ++i) {
    const auto turns = static_cast<double>(i);
    const Eigen::Quaterniond q(Eigen::AngleAxisd(0.7 * turns, Vector3d(1.0, 0.03 * turns, 2.0).normalized()));
    check(ball, pose(nearest[i % 3] + 0.0501 * away[i % 3].normalized(), q));
  }
  for (const ContactKind kind : {ContactKind::kVertexFace, ContactKind::kFaceVertex, ContactKind::kEdgeEdge,
                                 ContactKind::kVertexEdge, ContactKind::kEdgeVertex, ContactKind::kVertexVertex})
    EXPECT_GT(seen[kind], 0) << name_of(kind);
}

TEST(ContactSearch, BoxBesideASheetRimHasHorizontalNormals) {
  const auto found =
      contacts(geometry::make_plate({0.2, 0.2}, 2), geometry::make_box({0.1, 0.1, 0.1}, 12), pose({0.1502, 0.0, 0.0}));
  // The box's side faces the rim from 0.2 mm away; nothing but horizontal normals can come of that.
  ASSERT_FALSE(found.empty());
  for (const Contact& contact : found)
    EXPECT_TRUE(contact.n_W.isApprox(Vector3d::UnitX(), 1e-9));
}

TEST(ContactSearch, HoweverFinelyFacesAreCutABoxTouchesATableWithItsCornersOnly) {
  const geometry::TriangleMesh table = geometry::flip_randomly(geometry::make_plate({1.0, 1.0}, 20'000), 7);
  const geometry::TriangleMesh box = geometry::flip_randomly(geometry::make_box({0.1, 0.1, 0.1}, 6'000), 8);
  EXPECT_EQ(kinds(contacts(table, box, pose({0.0123, 0.0045, 0.0501}))),
            (std::map<ContactKind, int>{{ContactKind::kVertexFace, 4}}));
  // Half beyond the rim of the table: two corners, and two edges of the box over the rim.
  EXPECT_EQ(kinds(contacts(table, box, pose({0.5003, 0.0045, 0.0501}))),
            (std::map<ContactKind, int>{{ContactKind::kVertexFace, 2}, {ContactKind::kEdgeEdge, 2}}));
}

/// Rounding errors and a little more, to both sides.
std::vector<double> tiny_shifts() {
  std::vector<double> shifts{0.0};
  for (const double size : {1e-17, 1e-16, 1e-14, 1e-10, 1e-7, 4e-7, 6e-7, 1e-6, 1e-4}) {
    shifts.push_back(size);
    shifts.push_back(-size);
  }
  return shifts;
}

TEST(ContactSearch, CrossingRimsMeetWhereBothHaveVertices) {
  // Cells of 10 mm and of 20 mm: two edges of the box cross the rim of the table over vertices of both.
  TwoBodies box_on_table(geometry::make_plate({1.0, 1.0}, 5'000), geometry::make_box({0.1, 0.1, 0.1}, 1'200));
  const std::vector<double> turns{0.0, 1e-9, 1e-3};
  for (const double turn : std::span(turns).first(test_support::kSanitized ? 1 : 3)) {
    const Eigen::Quaterniond q(Eigen::AngleAxisd(turn, Vector3d::UnitZ()));
    for (const double dx : tiny_shifts()) {
      for (const double dy : tiny_shifts()) {
        SCOPED_TRACE(testing::Message() << "dx " << dx << ", dy " << dy << ", turned by " << turn);
        const auto found = box_on_table.contacts_at(pose({0.5 + dx, 0.03 + dy, 0.0501}, q));
        for (const double y : {-0.02, 0.08}) {
          const auto meets_here = [&](const Contact& contact) {
            return contact.kind == ContactKind::kEdgeEdge && std::abs(contact.p_W.y() - y) < 0.0015 &&
                   contact.n_W.isApprox(Vector3d::UnitZ(), 1e-9);
          };
          const auto count = std::count_if(found.begin(), found.end(), meets_here);
          ASSERT_GE(count, 1) << "at y " << y;
          ASSERT_LE(count, 4) << "at y " << y;
        }
      }
    }
  }
}

/// Anywhere, so that no coordinate is a round number.
Isometry3d random_frame(test_support::RandomNumbers& random) {
  return pose(random.point(1.0), Eigen::Quaterniond(random.rotation()));
}

TEST(ContactSearch, NoContactAtARimVertexIsLostToRounding) {
  constexpr std::uint64_t kSeed = 83;
  RecordProperty("seed", std::to_string(kSeed));
  test_support::RandomNumbers random(kSeed);
  const geometry::TriangleMesh table = geometry::make_plate({0.2, 0.2}, 200);
  const geometry::TriangleMesh box = geometry::make_box({0.1, 0.1, 0.1}, 48);
  const Eigen::Quaterniond on_corner = turn_from_to(Vector3d(1.0, 1.0, 1.0), -Vector3d::UnitX());
  const Vector3d beside(0.1 + 0.05 * std::sqrt(3.0) + 1e-4, 0.02, 0.0);
  for (int i = 0; i < test_support::affordable(100); ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", frame " << i);
    const Isometry3d X_WO = random_frame(random);
    // Two edges of the box cross the rim of the table over vertices of both.
    const auto crossings = TwoBodies(table, box, X_WO).contacts_at(X_WO * pose({0.1, 0.03, 0.0501}));
    for (const double y : {-0.02, 0.08}) {
      EXPECT_TRUE(std::any_of(crossings.begin(), crossings.end(),
                              [&](const Contact& contact) {
                                return contact.kind == ContactKind::kEdgeEdge &&
                                       (X_WO.inverse() * contact.p_W - Vector3d(0.1, y, 1e-4)).norm() < 1e-6;
                              }))
          << "at y " << y;
    }
    // A corner beside a vertex of the rim, and the other way round.
    const auto of_part = TwoBodies(table, box, X_WO).contacts_at(X_WO * pose(beside, on_corner));
    EXPECT_EQ(kinds(of_part).count(ContactKind::kVertexEdge), 1U);
    const auto of_obstacle = TwoBodies(box, table, X_WO).contacts_at(X_WO * pose(beside, on_corner).inverse());
    EXPECT_EQ(kinds(of_obstacle).count(ContactKind::kEdgeVertex), 1U);
  }
}

TEST(ContactSearch, CornerMeetsARimBesideARimVertex) {
  // The corner of a box points at the rim of a sheet, at a vertex inside it, and the other way round.
  const geometry::TriangleMesh sheet = geometry::make_plate({0.2, 0.2}, 200);
  const geometry::TriangleMesh box =
      geometry::transformed(geometry::make_box({0.1, 0.1, 0.1}, 12),
                            pose(Vector3d::Zero(), turn_from_to(Vector3d(1.0, 1.0, 1.0), -Vector3d::UnitX())));
  const double half_diagonal = 0.05 * std::sqrt(3.0);
  for (const double dy : tiny_shifts()) {
    SCOPED_TRACE(testing::Message() << "dy " << dy);
    const Vector3d p(0.1 + half_diagonal + 1e-4, 0.02 + dy, 0.0);
    const auto of_part = contacts(sheet, box, pose(p));
    ASSERT_GE(of_part.size(), 1U);
    ASSERT_LE(of_part.size(), 2U);
    for (const Contact& contact : of_part) {
      EXPECT_EQ(contact.kind, ContactKind::kVertexEdge);
      EXPECT_TRUE(contact.n_W.isApprox(Vector3d::UnitX(), 1e-9));
    }
    const auto of_obstacle = contacts(box, sheet, pose(-p));
    ASSERT_GE(of_obstacle.size(), 1U);
    ASSERT_LE(of_obstacle.size(), 2U);
    for (const Contact& contact : of_obstacle) {
      EXPECT_EQ(contact.kind, ContactKind::kEdgeVertex);
      EXPECT_TRUE(contact.n_W.isApprox(-Vector3d::UnitX(), 1e-9));
    }
  }
}

}  // namespace
}  // namespace glissade::contact
