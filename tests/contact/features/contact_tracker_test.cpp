// The contacts as the user gets them: which touch, in which order, and for how long they are the same.

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/sliding.h>
#include <glissade/contact/tracked_contacts.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>

#include "allocation_counter.h"
#include "sanitizers.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::TriangleMesh;

constexpr double kTrackedMargin = 5e-6;
constexpr unsigned kTrackerSeed = 41;

/// Vertex `vertex` of the part over face `face` of obstacle 0, which is horizontal.
Contact vertex_over_face(std::int32_t vertex, std::int32_t face, const Vector3d& p_W, double gap = kTrackedMargin) {
  return {ContactKind::kVertexFace, 0, 0, face, Vector3d::UnitZ(), p_W, gap, 0.0, vertex, face};
}

/// What a simulation would tell of these contacts, with the part at x along the world's x-axis.
SlidingResult result_of(std::vector<Contact> contacts, double x = 0.0) {
  SlidingResult result;
  result.X_WV = Isometry3d(Eigen::Translation3d(x, 0.0, 0.0));
  result.X_WV_of_contacts = result.X_WV;
  result.contacts = std::move(contacts);
  return result;
}

std::vector<std::int64_t> ids(std::span<const TrackedContact> contacts) {
  std::vector<std::int64_t> numbers;
  for (const TrackedContact& contact : contacts)
    numbers.push_back(contact.id);
  return numbers;
}

using Ids = std::vector<std::int64_t>;

TEST(ContactTracker, ReportsContactsWithinTwoMarginsOrWithForce) {
  ContactTracker tracker(kTrackedMargin);
  Contact pushing = vertex_over_face(3, 0, Vector3d(0.3, 0, 0), 10.0 * kTrackedMargin);
  pushing.force = 0.1;
  const auto contacts =
      tracker.update(result_of({vertex_over_face(1, 0, Vector3d(0.1, 0, 0), 1.9 * kTrackedMargin),
                                vertex_over_face(2, 0, Vector3d(0.2, 0, 0), 2.1 * kTrackedMargin), pushing}));
  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_EQ(contacts[0].contact.part_feature, 1);
  EXPECT_EQ(contacts[1].contact.part_feature, 3);
}

TEST(ContactTracker, OrderAndNumbersDoNotDependOnTheOrderOfTheSearch) {
  RecordProperty("seed", static_cast<int>(kTrackerSeed));
  SCOPED_TRACE("seed " + std::to_string(kTrackerSeed));
  std::mt19937 random(kTrackerSeed);
  std::vector<Contact> contacts;
  for (std::int32_t i = 0; i < 40; ++i) {
    Contact contact = vertex_over_face(i % 7, i, Vector3d(0.01 * i, 0, 0));
    contact.kind = i % 2 == 0 ? ContactKind::kVertexFace : ContactKind::kVertexVertex;
    contact.obstacle = i % 3;
    contacts.push_back(contact);
  }
  ContactTracker tracker(kTrackedMargin);
  tracker.update(result_of(contacts));
  const std::vector<TrackedContact> expected(tracker.contacts().begin(), tracker.contacts().end());
  for (std::size_t i = 1; i < expected.size(); ++i) {
    const auto key = [](const Contact& c) {
      return std::make_tuple(c.obstacle, c.kind, c.part_feature, c.obstacle_feature);
    };
    EXPECT_LT(key(expected[i - 1].contact), key(expected[i].contact));
    EXPECT_EQ(expected[i].id, expected[i - 1].id + 1);
  }
  for (int trial = 0; trial < 20; ++trial) {
    std::shuffle(contacts.begin(), contacts.end(), random);
    ContactTracker other(kTrackedMargin);
    const auto found = other.update(result_of(contacts));
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i].id, expected[i].id);
      ASSERT_EQ(found[i].contact.p_W, expected[i].contact.p_W);
    }
  }
}

TEST(ContactTracker, TheSameFeaturesKeepTheirNumberUntilTheyAreThreeMarginsApart) {
  ContactTracker tracker(kTrackedMargin);
  const auto at_gap = [&](double margins) {
    return tracker.update(result_of({vertex_over_face(1, 0, Vector3d(0.1, 0, 0), margins * kTrackedMargin)}));
  };
  EXPECT_EQ(ids(at_gap(1.0)), Ids{1});
  EXPECT_EQ(at_gap(1.0)[0].age, 1);
  EXPECT_TRUE(at_gap(2.5).empty());  // it does not touch, but is remembered
  ASSERT_EQ(ids(at_gap(1.5)), Ids{1});
  EXPECT_EQ(tracker.contacts()[0].age, 3);
  EXPECT_TRUE(at_gap(3.5).empty());
  ASSERT_EQ(ids(at_gap(1.0)), Ids{2});
  EXPECT_EQ(tracker.contacts()[0].age, 0);
}

TEST(ContactTracker, AContactThatPassesToTheNextTriangleOfAFaceStaysTheSame) {
  ContactTracker tracker(kTrackedMargin);
  EXPECT_EQ(ids(tracker.update(result_of({vertex_over_face(1, 7, Vector3d(0.1, 0, 0))}, 0.0))), Ids{1});
  EXPECT_EQ(ids(tracker.update(result_of({vertex_over_face(1, 8, Vector3d(0.101, 0, 0))}, 0.001))), Ids{1});
  // ... also where it is another feature of the part, as on a tessellated curve, ...
  EXPECT_EQ(ids(tracker.update(result_of({vertex_over_face(2, 9, Vector3d(0.102, 0, 0))}, 0.002))), Ids{1});
  EXPECT_EQ(tracker.contacts()[0].age, 2);
  // ... but not where the point has jumped further than the part has moved, ...
  EXPECT_EQ(ids(tracker.update(result_of({vertex_over_face(2, 10, Vector3d(0.104, 0, 0))}, 0.003))), Ids{2});
  // ... and not round a corner.
  Contact on_wall = vertex_over_face(2, 11, Vector3d(0.104, 0, 0));
  on_wall.n_W = -Vector3d::UnitX();
  EXPECT_EQ(ids(tracker.update(result_of({on_wall}, 0.003))), Ids{3});
}

TEST(ContactTracker, NearbyContactsAreMatchedByTheirVertices) {
  ContactTracker tracker(kTrackedMargin);
  tracker.update(
      result_of({vertex_over_face(1, 7, Vector3d(0.1, 0, 0)), vertex_over_face(2, 7, Vector3d(0.1008, 0, 0))}));
  // The part has moved by 1 mm: vertex 1 is now nearly where vertex 2 was.
  const auto contacts = tracker.update(result_of(
      {vertex_over_face(1, 8, Vector3d(0.101, 0, 0)), vertex_over_face(2, 9, Vector3d(0.1018, 0, 0))}, 0.001));
  EXPECT_EQ(ids(contacts), (Ids{1, 2}));
}

TEST(ContactTracker, DuplicateContactsAtOnePointAreMerged) {
  std::vector<Contact> contacts{vertex_over_face(1, 8, Vector3d(0.1, 0, 0)),
                                vertex_over_face(1, 7, Vector3d(0.1, 0, 0)),
                                vertex_over_face(2, 7, Vector3d(0.2, 0, 0))};
  contacts[0].force = 0.5;
  contacts[1].force = 0.25;
  // The same with a vertex of the obstacle below two faces of the part.
  for (const std::int32_t face : {4, 3}) {
    contacts.push_back(
        {ContactKind::kFaceVertex, face, 0, 0, Vector3d::UnitZ(), Vector3d::Zero(), kTrackedMargin, 1.0, face, 9});
  }
  ContactTracker tracker(kTrackedMargin);
  const auto found = tracker.update(result_of(contacts));
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].contact.obstacle_triangle, 7);
  EXPECT_EQ(found[0].contact.force, 0.75);
  EXPECT_EQ(found[2].contact.part_triangle, 3);
  EXPECT_EQ(found[2].contact.force, 2.0);
  // Two edges that meet at a vertex, and an edge across it: three ways to tell one place.
  Contact crossing{ContactKind::kEdgeEdge, 0, 0, 0, Vector3d::UnitZ(), Vector3d(0.3, 0, 0), kTrackedMargin, 0.0, 5, 6};
  contacts.push_back(crossing);
  crossing.obstacle_feature = 7;
  contacts.push_back(crossing);
  crossing.kind = ContactKind::kEdgeVertex;
  crossing.p_W.y() += 0.5 * kTrackedMargin;
  contacts.push_back(crossing);
  EXPECT_EQ(tracker.update(result_of(contacts)).size(), 4u);
  // On the wall beside it, it is another.
  contacts[0].n_W = Vector3d::UnitX();
  EXPECT_EQ(tracker.update(result_of(contacts)).size(), 5u);
}

TEST(ContactTracker, OverlapContactsAreTracked) {
  Contact overlap = vertex_over_face(-1, -1, Vector3d(0.1, 0, 0), -3e-3);
  overlap.kind = ContactKind::kOverlap;
  ContactTracker tracker(kTrackedMargin);
  EXPECT_EQ(ids(tracker.update(result_of({overlap}))), Ids{1});
  overlap.gap = -2.8e-3;
  EXPECT_EQ(ids(tracker.update(result_of({overlap}))), Ids{1});
}

TEST(ContactTracker, ContactsAreToldAtTheVisiblePose) {
  SlidingResult result = result_of({vertex_over_face(1, 7, Vector3d(0.1, 0, 0), 3.0 * kTrackedMargin)});
  Contact under = vertex_over_face(0, 0, Vector3d(0.2, 0, 0), 3.0 * kTrackedMargin);
  under.kind = ContactKind::kFaceVertex;
  result.contacts.push_back(under);
  // The last cycle went 1 mm along the face, and down.
  result.X_WV = Isometry3d(Eigen::Translation3d(1e-3, 0.0, -2.0 * kTrackedMargin));
  ContactTracker tracker(kTrackedMargin);
  const auto contacts = tracker.update(result);
  ASSERT_EQ(contacts.size(), 2u);
  for (const TrackedContact& contact : contacts)
    EXPECT_NEAR(contact.contact.gap, kTrackedMargin, 1e-15);
  // The part's vertex has gone along; the obstacle's is where it was.
  EXPECT_TRUE(contacts[0].contact.p_W.isApprox(Vector3d(0.101, 0.0, -2.0 * kTrackedMargin), 1e-12));
  EXPECT_TRUE(contacts[1].contact.q_W().isApprox(Vector3d(0.2, 0.0, -3.0 * kTrackedMargin), 1e-12));
}

class BoxOnPlate : public ::testing::Test {
 protected:
  Sliding sliding{{{std::make_shared<ContactBody>(
                      std::make_shared<geometry::TriangleMesh>(geometry::make_plate({0.5, 0.5}, 5000)))}},
                  std::make_shared<SlidingPart>(
                      std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.1, 0.06, 0.04}, 12))),
                  Isometry3d(Eigen::Translation3d(-0.1, 0.0, 0.021))};
  ContactTracker tracker{sliding.margin()};

  const SlidingResult& lead(double x, double z) {
    const Eigen::AngleAxisd tilt(1e-4, Vector3d(1.0, 2.0, 0.0).normalized());
    return sliding.advance(Eigen::Translation3d(x, 0.3 * x, z) * tilt);
  }
  std::span<const TrackedContact> move(double x, double z) { return tracker.update(lead(x, z)); }
};

TEST_F(BoxOnPlate, TheFourCornersOfABoxKeepTheirNumbersAcrossThePlatesTriangles) {
  for (int i = 0; i < 20; ++i)
    move(-0.1, 0.017);
  const Ids four = ids(tracker.contacts());
  ASSERT_EQ(four.size(), 4u);
  std::set<std::int32_t> triangles;
  constexpr int kMilliseconds = test_support::kSanitized ? 300 : 1000;
  for (int i = 0; i < kMilliseconds; ++i) {
    for (const TrackedContact& contact : move(-0.1 + 2e-4 * i, 0.017)) {
      ASSERT_LE(contact.id, 4) << "after " << i << " ms";
      triangles.insert(contact.contact.obstacle_triangle);
    }
    ASSERT_EQ(tracker.contacts().size(), 4u) << "after " << i << " ms";
  }
  EXPECT_GT(static_cast<int>(triangles.size()), kMilliseconds / 10) << "else nothing has been crossed";
  EXPECT_EQ(tracker.contacts().front().contact.kind, ContactKind::kVertexFace);
}

TEST_F(BoxOnPlate, ContactForcesBalanceTheSpringForceAndTorque) {
  for (int i = 0; i < 520; ++i)
    move(-0.1 + 2e-4 * std::min(i, 500), 0.017);
  ASSERT_EQ(sliding.result().state, SlidingState::kResting);
  const Vector3d p_Wref = sliding.result().X_WV * sliding.part().p_Vref();
  Vector3d force = Vector3d::Zero();
  Vector3d torque = Vector3d::Zero();
  for (const TrackedContact& tracked : tracker.contacts()) {
    const Contact& contact = tracked.contact;
    force += contact.force * contact.n_W;
    torque += contact.force * (contact.p_W - p_Wref).cross(contact.n_W);
  }
  // They balance the spring between the part and what the metaphor wants.
  const geometry::Displacement error = sliding.lag();
  EXPECT_LT((force + sliding.stiffness().translational * error.v).norm(), 1e-6 * force.norm());
  EXPECT_LT((torque + sliding.stiffness().rotational * error.w).norm(), 1e-6 * sliding.part().radius() * force.norm());
}

TEST_F(BoxOnPlate, AnUpdateTakesNothingFromTheHeap) {
  if (!test_support::allocations_are_counted()) GTEST_SKIP() << "a sanitizer's allocator cannot be counted";
  for (int i = 0; i < 200; ++i)
    move(-0.1 + 2e-4 * i, 0.017);
  for (int i = 200; i < 400; ++i) {
    const SlidingResult& result = lead(-0.1 + 2e-4 * i, 0.017);
    const std::int64_t before = test_support::allocations_of_this_thread();
    tracker.update(result);
    ASSERT_EQ(test_support::allocations_of_this_thread(), before) << "at " << i;
  }
}

}  // namespace
}  // namespace glissade::contact
