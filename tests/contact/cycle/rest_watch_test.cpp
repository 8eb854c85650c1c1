/// A part comes to rest on contacts that bend, however long its target stays elsewhere; and a spiral search does not go
/// on for ever.

#include "cycle/rest_watch.h"

#include <memory>

#include <gtest/gtest.h>

#include <glissade/contact/sliding.h>
#include <glissade/shapes/peg_and_hole.h>

#include "poses.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::at;

/// A peg over a hole in a plate, held at its lower end.
class PegOverHole {
 public:
  PegOverHole(double radius, double hole_radius, double plate, bool spiral_search)
      : sliding_(
            {{std::make_shared<ContactBody>(std::make_shared<geometry::TriangleMesh>(
                shapes::make_holed_plate({.hole_radius = hole_radius, .thickness = plate, .segments = 48})))}},
            std::make_shared<SlidingPart>(std::make_shared<geometry::TriangleMesh>(shapes::make_peg(
                                              {.radius = radius, .length = 0.04, .chamfer = 1e-3, .segments = 48})),
                                          Vector3d::Zero()),
            at(0.0, 0.0, 0.005), {.rules = {.spiral_search = spiral_search}}) {}

  /// Goes down to this depth within half a second, so far beside the hole, and stays.
  const SlidingResult& advance(double beside, double depth) {
    const double t = std::min(1.0, ++ms_ / 500.0);
    return sliding_.advance(at(beside, 0.0, 0.005 - t * (0.005 + depth)));
  }

 private:
  Sliding sliding_;
  int ms_ = 0;
};

TEST(RestWatch, APartRestsWhereItsContactsWouldLeadItInACircle) {
  struct Place {
    double beside;
    double depth;
  };
  for (const Place& place : {Place{1.4e-3, 3e-3}, Place{1.5e-3, 5e-3}, Place{1.6e-3, 4e-3}}) {
    PegOverHole peg(5e-3, 5.1e-3, 0.02, false);
    for (int ms = 0; ms < 1500; ++ms)
      peg.advance(place.beside, place.depth);
    const Isometry3d X_WV = peg.advance(place.beside, place.depth).X_WV;
    for (int ms = 0; ms < 100; ++ms) {
      const SlidingResult& result = peg.advance(place.beside, place.depth);
      ASSERT_EQ(result.state, SlidingState::kResting) << place.beside;
      ASSERT_EQ(result.X_WV.matrix(), X_WV.matrix()) << place.beside;
    }
  }
}

TEST(RestWatch, RestlessOnlyIfNeitherPartNorTargetAdvances) {
  const auto restless = [](double part_m, double target_m) {
    RestWatch watch;
    for (int ms = 0; ms < 1000; ++ms)
      watch.observe(at(part_m * ms), at(target_m * ms), Vector3d::Zero(), 0.05, true, 1.0);
    return watch.is_restless();
  };
  EXPECT_TRUE(restless(0.0, 0.0));
  EXPECT_FALSE(restless(1e-6, 0.0)) << "creeps";
  EXPECT_FALSE(restless(0.0, 1e-6)) << "is led elsewhere";
  RestWatch still;
  for (int ms = 0; ms < 1000; ++ms)
    still.observe(at(0.0), at(0.0), Vector3d::Zero(), 0.05, false, 1.0);
  EXPECT_TRUE(still.stays());
  EXPECT_FALSE(still.is_restless());
}

// Else it would come back from there, again and again.
TEST(RestWatch, StaysRestlessAtABetterPlaceUntilTheTargetMoves) {
  RestWatch watch;
  for (int ms = 0; ms < 300; ++ms)
    watch.observe(at(0.0), at(0.01), Vector3d::Zero(), 0.05, true, 1.0);
  for (int ms = 0; ms < 10; ++ms)
    watch.observe(at(1e-3 * ms), at(0.01), Vector3d::Zero(), 0.05, true, 1.0);
  EXPECT_TRUE(watch.is_restless());
  EXPECT_TRUE(watch.stays());
  watch.observe(at(0.01), at(0.0101), Vector3d::Zero(), 0.05, true, 1.0);
  EXPECT_FALSE(watch.is_restless());
}

TEST(SpiralSearch, EndsWithThePegInTheHole) {
  PegOverHole peg(4e-3, 4.1e-3, 9e-3, true);
  const auto depth = [&] { return -peg.advance(1.2e-3, 2e-3).X_WV.translation().z(); };
  int found_ms = 0;
  while (found_ms < 3000 && depth() < 1.5e-3)
    ++found_ms;
  ASSERT_LT(found_ms, 3000);
  for (int ms = 0; ms < 3000; ++ms)
    ASSERT_GT(depth(), 1e-3) << ms;
  const Isometry3d X_WV = peg.advance(1.2e-3, 2e-3).X_WV;
  for (int ms = 0; ms < 2000; ++ms)
    ASSERT_TRUE(peg.advance(1.2e-3, 2e-3).X_WV.isApprox(X_WV, 1e-7)) << "no other search: " << ms;
}

}  // namespace
}  // namespace glissade::contact
