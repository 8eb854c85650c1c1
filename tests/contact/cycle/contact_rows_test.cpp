// Rows are found only where they are needed: by brute force over all contacts, none that is missing is in the way.

#include "cycle/contact_rows.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>

#include "features/contact_search.h"
#include "held_part.h"
#include "poses.h"
#include "random_numbers.h"
#include "sanitizers.h"

namespace glissade::contact {
namespace {

using Eigen::Vector3d;
using test_support::RandomNumbers;

constexpr double kReachOfRows = 0.3e-3;   // metres
constexpr double kPlayOfBall = 0.05e-3;   // metres, of a ball in its socket
constexpr double kBallRadius = 0.02;      // metres
constexpr double kRoundingOfRows = 1e-9;  // metres

/// A finely cut ball somewhere in a socket that it nearly fills.
SimulatedParts close_fit(RandomNumbers& random) {
  const Eigen::Isometry3d X_WV = test_support::pose(random.uniform(0.0, 0.3) * kPlayOfBall * random.direction(),
                                                    test_support::turn(random.uniform(0.0, 3.0), random.direction()));
  return {{test_support::obstacle_of(geometry::make_sphere(kBallRadius + kPlayOfBall, 4000))},
          {{.part_V = test_support::part_of(geometry::make_sphere(kBallRadius - 0.3 * kPlayOfBall, 4000)),
            .X_WV_start = X_WV}},
          {},
          {}};
}

/// All contacts within reach, from all candidates.
std::vector<Contact> all_contacts(const SimulatedParts& shared) {
  std::vector<TrianglesOfBodies> pairs;
  shared.candidates.pairs().within(kReachOfRows, pairs);
  std::vector<Contact> contacts;
  find_contacts(shared.scene.bodies(), shared.scene.obstacles().size(), pairs, kReachOfRows, shared.largest_margin,
                contacts);
  return contacts;
}

CoupledRow row_of(const Contact& contact, const HeldPartState& part) {
  CoupledRow row;
  row.n = contact.n_W;
  row.r = contact.p_W - part.p_Wref();
  const double missing = part.margin - contact.gap;
  row.bound = missing > 0.0 ? 0.7 * missing : missing;
  return row;
}

/// The distance of the triangles of a contact after the part has moved, to first order.
double distance_after(const SimulatedParts& shared, const Contact& contact, const geometry::Displacement& d) {
  const PlacedBody& obstacle = shared.scene.bodies()[0];
  geometry::TrianglePoints part = shared.scene.bodies()[1].triangle_W(contact.part_triangle);
  for (Vector3d& x : part)
    x += d.v + d.w.cross(x - shared.states[0].p_Wref());
  return geometry::triangle_distance(obstacle.triangle_W(contact.obstacle_triangle), part).distance;
}

using Features = std::array<std::int32_t, 3>;

Features identity_of(const Contact& contact) {
  return {static_cast<std::int32_t>(contact.kind), contact.part_feature, contact.obstacle_feature};
}

TEST(ContactRows, OmittedOnlyWhereTheStepKeepsTheMargin) {
  constexpr std::uint64_t kSeed = 94;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomNumbers random(kSeed);
  std::size_t needed = 0;
  std::size_t all = 0;
  int pushed = 0;
  int optimal = 0;
  const int trials = std::max(6, test_support::affordable(30));
  for (int trial = 0; trial < trials; ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    SimulatedParts shared = close_fit(random);
    shared.candidates.look(kReachOfRows, 0.0, {});
    const HeldPartState& part = shared.states[0];
    Displacements wanted{};
    wanted[0] = {random.uniform(0.0, 4.0) * kPlayOfBall * random.direction(),
                 random.uniform(0.0, 2e-3) * random.direction()};
    ContactRows rows(shared);
    WorkBudget unlimited;
    rows.find(kReachOfRows, kReachOfRows, unlimited);
    ProjectionSolver solver;
    Displacements step{};
    do {
      step = solver.project(shared.of_parts(wanted), {&part.stiffness, 1}, rows.rows()).displacements;
    } while (rows.find_violated(step, unlimited));
    needed += rows.rows().size();

    std::vector<CoupledRow> of_all;
    double worst = 0.0;
    for (const Contact& contact : all_contacts(shared)) {
      const CoupledRow row = row_of(contact, part);
      of_all.push_back(row);
      const double missing = row.bound - row.velocity(shared.of_parts(step));
      worst = std::max(worst, missing);
      if (missing <= kRoundingOfRows) continue;
      ASSERT_GE(distance_after(shared, contact, step[0]), part.margin - kRoundingOfRows)
          << "at a gap of " << contact.gap;
    }
    all += of_all.size();
    const CoupledProjection reference = solver.project(shared.of_parts(wanted), {&part.stiffness, 1}, of_all);
    pushed += reference.active_count > 0 ? 1 : 0;
    if (worst > kRoundingOfRows) continue;
    ++optimal;
    EXPECT_LT((reference.displacements[0].v - step[0].v).norm(), kRoundingOfRows);
    EXPECT_LT((reference.displacements[0].w - step[0].w).norm(), kRoundingOfRows / kBallRadius);
  }
  EXPECT_GT(pushed, trials / 2);
  EXPECT_GT(10 * optimal, 9 * trials) << "nearly always no row is violated at all";
  EXPECT_LT(2 * needed, all);
}

TEST(ContactRows, AllContactsWithinTheReportedDistanceAreFound) {
  constexpr std::uint64_t kSeed = 95;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomNumbers random(kSeed);
  for (int trial = 0; trial < test_support::affordable(20); ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    SimulatedParts shared = close_fit(random);
    shared.candidates.look(kReachOfRows, 0.0, {});
    ContactRows rows(shared);
    WorkBudget unlimited;
    rows.find(0.5 * kReachOfRows, kReachOfRows, unlimited);
    const double complete_with_rows = rows.complete();
    const std::size_t with_rows = rows.rows().size();
    const double complete = rows.find_ahead(unlimited);
    EXPECT_GE(complete, complete_with_rows);
    EXPECT_LE(complete, kReachOfRows);
    EXPECT_GT(complete, 3.0 * shared.largest_margin) << "contacts that touch";
    std::set<Features> known;
    std::size_t place = 0;
    std::set<Features> known_with_rows;
    for (const Contact& contact : rows.all_contacts()) {
      EXPECT_TRUE(known.insert(identity_of(contact)).second) << "twice";
      if (place++ < with_rows) known_with_rows.insert(identity_of(contact));
    }
    std::size_t expected = 0;
    for (const Contact& contact : all_contacts(shared)) {
      if (contact.gap < complete_with_rows) {
        EXPECT_TRUE(known_with_rows.contains(identity_of(contact))) << contact.gap;
      }
      if (contact.gap >= complete) continue;
      ++expected;
      EXPECT_TRUE(known.contains(identity_of(contact))) << contact.gap;
    }
    EXPECT_GT(expected, 10U);
  }
}

}  // namespace
}  // namespace glissade::contact
