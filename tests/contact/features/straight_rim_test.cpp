// Rims that are cut finely: what crosses them slides along as over a rim of one piece.

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include <glissade/contact/sliding.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/mesh_generators.h>

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Isometry3d turned_at(const Vector3d& p, double turn = 0.0) {
  Isometry3d X(Eigen::Translation3d{p});
  X.rotate(Eigen::AngleAxisd(turn, Vector3d::UnitZ()));
  return X;
}

/// A box of 40 mm on a table of 200 mm, both cut into cells of 4 mm, so that their vertices meet wherever the box goes
/// by whole cells.
class BoxOnAFinelyCutTable : public ::testing::Test {
 protected:
  static constexpr double kCell_m = 4e-3;
  static constexpr double kHalf_m = 20e-3;
  static constexpr double kPressed_m = 1e-3;

  explicit BoxOnAFinelyCutTable()
      : sliding_({{std::make_shared<ContactBody>(std::make_shared<geometry::TriangleMesh>(table()))}},
                 std::make_shared<SlidingPart>(std::make_shared<geometry::TriangleMesh>(
                     geometry::make_box({2.0 * kHalf_m, 2.0 * kHalf_m, 2.0 * kHalf_m}, 1200))),
                 turned_at({0.0, 0.0, kHalf_m + 1e-3})) {}

  static geometry::TriangleMesh table() { return geometry::make_plate({0.2, 0.2}, 5000); }

  /// Leads the ghost straight on, `calls` milliseconds long.
  template <typename Check>
  void lead(const Isometry3d& X_WG_to, int calls, const Check& check) {
    const Vector3d from = sliding_.result().X_WG.translation();
    const double turned = std::atan2(sliding_.result().X_WG(1, 0), sliding_.result().X_WG(0, 0));
    const double turn = std::atan2(X_WG_to(1, 0), X_WG_to(0, 0)) - turned;
    for (int i = 1; i <= calls; ++i) {
      const double t = static_cast<double>(i) / calls;
      check(sliding_.advance(turned_at(from + t * (X_WG_to.translation() - from), turned + t * turn), 1.0));
    }
  }
  void lead(const Isometry3d& X_WG_to, int calls) {
    lead(X_WG_to, calls, [](const SlidingResult&) {});
  }

  /// The part lies flat under its ghost, and the hand feels the spring.
  void expect_flat(const SlidingResult& result) const {
    const Vector3d lag = result.X_WV.translation() - result.X_WG.translation();
    ASSERT_LT(lag.head<2>().norm(), 2.0 * sliding_.margin());
    ASSERT_LT(std::abs(result.X_WV.translation().z() - kHalf_m), 2.0 * sliding_.margin());
    ASSERT_LT(Eigen::AngleAxisd(result.X_WG.linear().transpose() * result.X_WV.linear()).angle(), 1e-4);
  }

  Sliding sliding_;
};

TEST_F(BoxOnAFinelyCutTable, TouchesWithItsFourCornersOnly) {
  lead(turned_at({0.0013, 0.0017, kHalf_m - kPressed_m}), 100);
  lead(turned_at({0.0513, 0.0317, kHalf_m - kPressed_m}, 0.2), 200, [&](const SlidingResult& result) {
    expect_flat(result);
    ASSERT_LE(result.contacts.size(), 8U)
        << "one for each corner, and one more where both triangles at a seam have a contact";
  });
}

TEST_F(BoxOnAFinelyCutTable, OverhangingBoxSlidesAlongTheRimWithoutJumps) {
  // A part of the box that is a whole number of cells is beyond the rim: every other cell along it vertices of both
  // meet.
  const double x = 0.1 - kHalf_m + 4.0 * kCell_m;
  lead(turned_at({0.05, 0.0, kHalf_m + 1e-3}), 50);
  lead(turned_at({x, 0.0, kHalf_m + 1e-3}), 50);
  lead(turned_at({x, 0.0, kHalf_m - kPressed_m}), 100);
  double most = 0.0;
  Vector3d p_before = sliding_.result().X_WV.translation();
  // Slowly over vertices: 10 µm a call, and then faster by half cells.
  for (const double step : {1e-5, 0.5 * kCell_m / 4.0}) {
    const Vector3d from = sliding_.result().X_WG.translation();
    lead(turned_at(from + Vector3d(0.0, 8e-3, 0.0)), static_cast<int>(std::lround(8e-3 / step)),
         [&](const SlidingResult& result) {
           expect_flat(result);
           most = std::max(most, (result.X_WV.translation() - p_before).norm() / step);
           p_before = result.X_WV.translation();
         });
  }
  EXPECT_LT(most, 1.5) << "it does not jump";
}

TEST_F(BoxOnAFinelyCutTable, StaysFlatWhileSlidingOutOverTheRim) {
  lead(turned_at({0.05, 0.0, kHalf_m - kPressed_m}), 100);
  lead(turned_at({0.1 - 1e-4, 0.0, kHalf_m - kPressed_m}), 1000,
       [&](const SlidingResult& result) { expect_flat(result); });
}

}  // namespace
}  // namespace glissade::contact
