// The founding paper's classification of contacts, on the smallest bodies that show each case. The part stops one
// micrometre above an obstacle and touches it one micrometre further down.

#include "paper/paper_classification.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>

#include "paper/collision_object.h"

namespace glissade::reference {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using geometry::TriangleMesh;

constexpr double kStep = 1e-6;
constexpr double kNear = 4e-6;
using enum PaperContactKind;

TEST(PaperTable, CountsOfOneAreEdgeOnEdge) {
  EXPECT_EQ(kind_of({1, 1}), kEdgeEdge);
}

TEST(PaperTable, CountAboveOneOnOneSideIsAVertexOnAFace) {
  EXPECT_EQ(kind_of({2, 0}), kVertexFace);
  EXPECT_EQ(kind_of({3, 1}), kVertexFace);
  EXPECT_EQ(kind_of({0, 2}), kFaceVertex);
  EXPECT_EQ(kind_of({1, 2}), kFaceVertex);
}

TEST(PaperTable, ZeroCountIsDecidedByItsRim) {
  EXPECT_EQ(kind_of({0, 1, true, false}), kEdgeEdge);
  EXPECT_EQ(kind_of({0, 2, true, false}), kEdgeEdge);
  EXPECT_EQ(kind_of({0, 1, false, false}), kFaceVertex);
  EXPECT_EQ(kind_of({1, 0, false, true}), kEdgeEdge);
  EXPECT_EQ(kind_of({1, 0, false, false}), kVertexFace);
}

TEST(PaperTable, TwoZeroCountsAreDecidedByBothRims) {
  EXPECT_EQ(kind_of({0, 0, true, true}), kEdgeEdge);
  EXPECT_EQ(kind_of({0, 0, true, false}), kVertexFace);
  EXPECT_EQ(kind_of({0, 0, false, true}), kFaceVertex);
  EXPECT_EQ(kind_of({0, 0, false, false}), kUnclear);
}

TEST(PaperTable, CountsAboveOneOnBothSidesAreDecidedByTheLarger) {
  EXPECT_EQ(kind_of({3, 2}), kVertexFace);
  EXPECT_EQ(kind_of({2, 3}), kFaceVertex);
  EXPECT_EQ(kind_of({2, 2}), kEdgeEdge);
}

/// The contacts of a part that goes on by `step` from the origin.
std::vector<PaperContact> contacts_of(const geometry::TriangleMesh& part, const geometry::TriangleMesh& obstacle,
                                      const Vector3d& step) {
  const auto part_V = std::make_shared<contact::SlidingPart>(std::make_shared<geometry::TriangleMesh>(part));
  const auto body = std::make_shared<contact::ContactBody>(std::make_shared<geometry::TriangleMesh>(obstacle));
  CollisionObject object({{body}}, part_V);
  const Isometry3d X_WV = Isometry3d::Identity();
  const Isometry3d X_WC(Translation3d{step});
  EXPECT_FALSE(object.collides(X_WV));
  std::vector<TouchingPair> pairs;
  object.touching_pairs(X_WC, pairs);
  EXPECT_FALSE(pairs.empty());
  std::vector<PaperContact> contacts;
  classify_contacts(object.obstacles(), *part_V, pairs, X_WC, X_WV, kNear, contacts);
  keep_first_of_each(contacts);
  return contacts;
}

/// All contacts are of the kind, and the tangent plane's normal is `n`. Whatever the order of vertices.
void expect_only(const geometry::TriangleMesh& part, const geometry::TriangleMesh& obstacle, const Vector3d& step,
                 PaperContactKind kind, const Vector3d& n_W, double gap) {
  for (const std::uint64_t seed : {0u, 1u, 2u, 3u, 4u}) {
    const auto turned = [&](const geometry::TriangleMesh& mesh) {
      return seed == 0 ? mesh : geometry::flip_randomly(mesh, seed);
    };
    const auto contacts = contacts_of(turned(part), turned(obstacle), step);
    EXPECT_FALSE(contacts.empty());
    for (const PaperContact& contact : contacts) {
      EXPECT_EQ(contact.features.kind, kind);
      EXPECT_LT((contact.n_W - n_W).norm(), 1e-6) << contact.n_W.transpose();
      EXPECT_NEAR(contact.gap_at(Isometry3d::Identity()), gap, 1e-12);
    }
  }
}

geometry::TriangleMesh moved(const geometry::TriangleMesh& mesh, const Vector3d& p) {
  return geometry::transformed(mesh, Isometry3d(Translation3d(p)));
}

/// A pyramid with its tip at the origin, that opens upwards (or downwards).
geometry::TriangleMesh pyramid(double height) {
  const double a = 0.01;
  return {{{0, 0, 0}, {a, a, height}, {-a, a, height}, {-a, -a, height}, {a, -a, height}},
          {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {1, 2, 3}, {1, 3, 4}}};
}

/// A wedge with its ridge on the x axis, below (or above) the rest of it.
geometry::TriangleMesh wedge(double height) {
  const double a = 0.02;
  const double b = 0.01;
  return {{{-a, 0, 0}, {a, 0, 0}, {a, b, height}, {-a, b, height}, {-a, -b, height}, {a, -b, height}},
          {{0, 1, 2}, {0, 2, 3}, {0, 4, 5}, {0, 5, 1}, {2, 3, 4}, {2, 4, 5}, {0, 3, 4}, {1, 2, 5}}};
}

geometry::TriangleMesh quarter_turned(const geometry::TriangleMesh& mesh) {
  return geometry::transformed(mesh, Isometry3d(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitZ())));
}

const Vector3d kAbove(0.0, 0.0, kStep / 2);
const Vector3d kDown(0.0, 0.0, -kStep);

TEST(PaperClassification, ATipOnAFace) {
  const geometry::TriangleMesh plate = moved(geometry::make_plate({0.1, 0.1}, 2), {0.003, 0.001, 0.0});
  expect_only(moved(pyramid(0.02), kAbove), plate, kDown, kVertexFace, Vector3d::UnitZ(), kStep / 2);
}

TEST(PaperClassification, AFaceOnATip) {
  const geometry::TriangleMesh plate = moved(geometry::make_plate({0.1, 0.1}, 2), Vector3d(0.003, 0.001, 0.0) + kAbove);
  expect_only(plate, pyramid(-0.02), kDown, kFaceVertex, Vector3d::UnitZ(), kStep / 2);
}

TEST(PaperClassification, TwoWedgesThatCross) {
  // Edges of the touching polygons alone would not tell: each pair of polygons has one edge that meets the other one,
  // as a tip near the rim of a triangle has.
  expect_only(moved(wedge(0.02), kAbove), quarter_turned(wedge(-0.02)), kDown, kEdgeEdge, Vector3d::UnitZ(), kStep / 2);
}

TEST(PaperClassification, ATipWithinABracketOfASeamIsTakenForAnEdge) {
  // 0.3 µm beside the diagonal of the plate, which the tip overlaps when it has gone 1 µm deep: faces of the pyramid
  // touch both triangles of the plate, so the counts are those of two edges, and a normal leans. This is where the
  // method jams on finely cut faces.
  const Isometry3d turned(Eigen::AngleAxisd(0.5, Vector3d::UnitZ()));
  const geometry::TriangleMesh plate =
      moved(geometry::transformed(geometry::make_plate({0.1, 0.1}, 2), turned), {0.3e-6, 0.0, 0.0});
  const auto contacts = contacts_of(moved(pyramid(0.02), 0.02 * kAbove), plate, kDown);
  EXPECT_TRUE(std::any_of(contacts.begin(), contacts.end(), [](const PaperContact& contact) {
    return contact.features.kind == kEdgeEdge && contact.n_W.z() < 0.99;
  }));
}

/// An upright sheet on the xz plane, its lower rim on the x axis.
geometry::TriangleMesh upright_sheet(double height) {
  const double a = 0.02;
  return {{{-a, 0, 0}, {a, 0, 0}, {a, 0, height}, {-a, 0, height}}, {{0, 1, 2}, {0, 2, 3}}};
}

TEST(PaperClassification, TheRimOfASheetOnARidge) {
  expect_only(moved(upright_sheet(0.02), kAbove), quarter_turned(wedge(-0.02)), kDown, kEdgeEdge, Vector3d::UnitZ(),
              kStep / 2);
  expect_only(moved(wedge(0.02), kAbove), quarter_turned(upright_sheet(-0.02)), kDown, kEdgeEdge, Vector3d::UnitZ(),
              kStep / 2);
}

TEST(PaperClassification, TheRimsOfTwoSheets) {
  expect_only(moved(upright_sheet(0.02), kAbove), quarter_turned(upright_sheet(-0.02)), kDown, kEdgeEdge,
              Vector3d::UnitZ(), kStep / 2);
}

TEST(PaperClassification, TheCornerOfASheetOnAFace) {
  const geometry::TriangleMesh corner{{{0, 0, 0}, {0.01, 0, 0.02}, {-0.01, 0, 0.02}}, {{0, 1, 2}}};
  const geometry::TriangleMesh plate = moved(geometry::make_plate({0.1, 0.1}, 2), {0.003, 0.001, 0.0});
  expect_only(moved(corner, kAbove), plate, kDown, kVertexFace, Vector3d::UnitZ(), kStep / 2);
  const geometry::TriangleMesh upside_down =
      geometry::transformed(corner, Isometry3d(Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitX())));
  expect_only(moved(plate, kAbove), upside_down, kDown, kFaceVertex, Vector3d::UnitZ(), kStep / 2);
}

TEST(PaperClassification, ASheetIsTouchedFromEitherSide) {
  const geometry::TriangleMesh plate = moved(geometry::make_plate({0.1, 0.1}, 2), {0.003, 0.001, 0.0});
  expect_only(moved(pyramid(-0.02), -kAbove), plate, -kDown, kVertexFace, -Vector3d::UnitZ(), kStep / 2);
}

TEST(PaperClassification, CoplanarSheetsHaveTheSheetNormal) {
  // Exactly one on the other, in the same plane: no edge meets the other in one point only, but every touching pair is
  // reported with the right normal.
  const geometry::TriangleMesh small{{{0, 0, kStep}, {0.01, 0, kStep}, {0, 0.01, kStep}}, {{0, 1, 2}}};
  const geometry::TriangleMesh large{{{-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}}, {{0, 1, 2}}};
  const auto contacts = contacts_of(small, large, kDown);
  for (const PaperContact& contact : contacts)
    EXPECT_LT((contact.n_W - Vector3d::UnitZ()).norm(), 1e-6) << contact.n_W.transpose();
}

/// A sheet in the plane z = 0 with a round hole of this radius, of as many corners as there are `segments`.
geometry::TriangleMesh holed_sheet(double radius, int segments, double outer) {
  const std::vector<Eigen::Vector2d> profile{{radius, 0.0}, {outer, 0.0}};
  return geometry::make_revolution(profile, false, segments);
}

TEST(PaperClassification, APipeInAHoleOfASheetIsHeldAcrossItsAxis) {
  // The pipe, 40 segments, stands through the hole, 24 segments, and touches its rim on the side of positive x.
  const geometry::TriangleMesh pipe = geometry::make_tube(0.010, 0.05, 800);
  const geometry::TriangleMesh sheet = holed_sheet(0.0102, 24, 0.03);
  const auto part_V = std::make_shared<contact::SlidingPart>(std::make_shared<geometry::TriangleMesh>(pipe));
  CollisionObject object({{std::make_shared<contact::ContactBody>(std::make_shared<geometry::TriangleMesh>(sheet))}},
                         part_V);
  const auto at = [](double x) { return Isometry3d(Translation3d(x, 0.0, 0.0137)); };
  double free = 0.0;
  double touching = 0.001;
  while (touching - free > 1e-6) {
    const double middle = 0.5 * (free + touching);
    (object.collides(at(middle)) ? touching : free) = middle;
  }
  std::vector<TouchingPair> pairs;
  object.touching_pairs(at(touching), pairs);
  std::vector<PaperContact> contacts;
  classify_contacts(object.obstacles(), *part_V, pairs, at(touching), at(free), kNear, contacts);
  ASSERT_FALSE(contacts.empty());
  for (const PaperContact& contact : contacts) {
    EXPECT_EQ(contact.features.kind, kEdgeEdge) << "a rim of the sheet and an edge along the pipe";
    EXPECT_NEAR(contact.n_W.z(), 0.0, 1e-9) << "it can still be pushed through";
    EXPECT_LT(contact.n_W.x(), -0.9);
  }
}

TEST(PaperClassification, APipeOnASheetStandsOnItsRim) {
  // Its upright edges go through triangles of the sheet, far from their edges: that is no edge on edge.
  const geometry::TriangleMesh pipe = moved(geometry::make_tube(0.010, 0.05, 800), Vector3d(0.0, 0.0, 0.025) + kAbove);
  const auto contacts = contacts_of(pipe, holed_sheet(0.005, 23, 0.03), kDown);
  ASSERT_FALSE(contacts.empty());
  for (const PaperContact& contact : contacts)
    EXPECT_GT(contact.n_W.z(), 1.0 - 1e-6) << contact.n_W.transpose();
}

TEST(PaperClassification, ContactsOfTheSameFeaturesAreOne) {
  const geometry::TriangleMesh plate = moved(geometry::make_plate({0.1, 0.1}, 2), {0.003, 0.001, 0.0});
  EXPECT_EQ(contacts_of(moved(pyramid(0.02), kAbove), plate, kDown).size(), 1u);
  EXPECT_EQ(contacts_of(moved(wedge(0.02), kAbove), quarter_turned(wedge(-0.02)), kDown).size(), 1u);
}

}  // namespace
}  // namespace glissade::reference
