// Friction against Coulomb's law in closed form and against ODE: a box on a plane sticks until the spring pulls with µ
// times the normal force, and is drawn along with that force. ODE has one coefficient for rest and sliding, and a
// pyramid for a cone, so the box goes along one of the pyramid's axes and both coefficients are the same.

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "held_part.h"
#include "ode_reference.h"
#include "poses.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::kBoxSize;
using test_support::OdeHeldPart;
using test_support::pose;
using test_support::turn;

constexpr double kSlopeFriction = 0.4;
constexpr double kSlopePosition_m = 0.1e-6;
constexpr double kSlopeForceRatio = 1e-5;  // relative

/// The box on a plane of some slope about y, simulated by both. Positions are in the frame of the plane: x down the
/// slope, z away from it.
class BoxOnSlope {
 public:
  explicit BoxOnSlope(double slope) : q_(turn(slope, Vector3d::UnitY())) {
    const Isometry3d X_WV = pose(q_ * Vector3d(0.0, 0.0, 0.5 * kBoxSize.z() + 0.1e-3), q_);
    ours_ = std::make_unique<Sliding>(
        std::vector<Obstacle>{test_support::obstacle_of(geometry::make_plate({0.5, 0.5}, 2), pose({0, 0, 0}, q_))},
        test_support::part_of(geometry::make_box(kBoxSize, 12)), X_WV,
        SlidingOptions{.metaphor = Metaphor::kRubberBandSpring,
                       .rules = {.friction = {.at_rest = kSlopeFriction, .sliding = kSlopeFriction}}});
    const Vector3d up = q_ * Vector3d::UnitZ();
    ode_ = std::make_unique<OdeHeldPart>(test_support::OdeWorld{.planes = {{up, ours_->margin()}},
                                                                .boxes = {},
                                                                .friction = kSlopeFriction,
                                                                .slip_W = q_ * Vector3d::UnitX()},
                                         test_support::OdePart{.size = kBoxSize}, ours_->stiffness(), X_WV);
  }

  /// Leads both ghosts to this place in world axes, their boxes parallel to the plane, in so many milliseconds; then
  /// both have a second to come to rest.
  void lead_to(const Vector3d& p_W, int milliseconds) {
    const Isometry3d X_from = ours_->result().X_WG;
    const Isometry3d X_to = pose(p_W, q_);
    test_support::lead(*ours_, X_to, milliseconds);
    for (int i = 1; i <= milliseconds; ++i)
      ode_->step(test_support::between(X_from, X_to, static_cast<double>(i) / milliseconds));
    test_support::hold_until_rest(*ours_);
    for (int i = 0; i < 1000; ++i)
      ode_->step(X_to);
  }

  Vector3d on_plane(const Vector3d& p_W) const { return q_.conjugate() * p_W; }
  Vector3d from_plane(const Vector3d& p) const { return q_ * p; }
  Vector3d ours() const { return on_plane(ours_->result().X_WV.translation()); }
  Vector3d ode() const { return on_plane(ode_->X_WV().translation()); }
  Vector3d ghost() const { return on_plane(ours_->result().X_WG.translation()); }

  /// Of the spring, in newtons: along the plane and against it.
  double pull() const { return ours_->stiffness().translational * (ghost() - ours()).x(); }
  double press() const { return ours_->stiffness().translational * (ours() - ghost()).z(); }
  double ode_pull() const { return ours_->stiffness().translational * (ghost() - ode()).x(); }

  /// Where the middle is when the box lies on the plane.
  double height() const { return 0.5 * kBoxSize.z() + ours_->margin(); }

 private:
  Eigen::Quaterniond q_;
  std::unique_ptr<Sliding> ours_;
  std::unique_ptr<OdeHeldPart> ode_;
};

TEST(FrictionReference, StickLimitOnAPlaneMatchesOde) {
  for (const double depth : {1e-3, 3e-3}) {
    BoxOnSlope box(0.0);
    box.lead_to({0.0, 0.0, box.height() - depth}, 100);
    const double reach = kSlopeFriction * depth;  // of the ghost, when the spring pulls as much as friction holds
    box.lead_to({0.99 * reach, 0.0, box.height() - depth}, 100);
    EXPECT_NEAR(box.ours().x(), 0.0, 1e-9);
    EXPECT_NEAR(box.ode().x(), 0.0, kSlopePosition_m);
    box.lead_to({1.02 * reach, 0.0, box.height() - depth}, 100);
    EXPECT_NEAR(box.ours().x(), 0.02 * reach, kSlopePosition_m);
    EXPECT_NEAR(box.ode().x(), 0.02 * reach, kSlopePosition_m);
  }
}

TEST(FrictionReference, SlidingForceOnAPlaneMatchesOde) {
  BoxOnSlope box(0.0);
  box.lead_to({0.0, 0.0, box.height() - 2e-3}, 100);
  for (const double x : {0.05, 0.0, -0.03}) {
    box.lead_to({x, 0.0, box.height() - 2e-3}, 400);
    EXPECT_LE((box.ours() - box.ode()).norm(), kSlopePosition_m);
    EXPECT_NEAR(std::abs(box.pull()), kSlopeFriction * box.press(), kSlopeForceRatio * box.press());
    EXPECT_NEAR(box.pull(), box.ode_pull(), kSlopeForceRatio * std::abs(box.ode_pull()));
  }
}

TEST(FrictionReference, BoxSticksOnASlopeBelowTheFrictionAngle) {
  const double slope = 0.95 * std::atan(kSlopeFriction);
  BoxOnSlope box(slope);
  const Vector3d touching = box.from_plane({0.0, 0.0, box.height()});
  box.lead_to(touching, 50);
  box.lead_to(touching - Vector3d(0.0, 0.0, 3e-3), 100);
  EXPECT_NEAR(box.ours().x(), 0.0, kSlopePosition_m);
  EXPECT_NEAR(box.ode().x(), 0.0, kSlopePosition_m);
}

TEST(FrictionReference, BoxSlidesDownASteeperSlopeUntilFrictionBalances) {
  const double slope = 0.5;
  ASSERT_GT(std::tan(slope), kSlopeFriction);
  BoxOnSlope box(slope);
  const Vector3d touching = box.from_plane({0.0, 0.0, box.height()});
  const double way = 3e-3;
  box.lead_to(touching, 50);
  box.lead_to(touching - Vector3d(0.0, 0.0, way), 100);
  // The ghost is way · sin down the slope and way · cos inside it.
  const double expected = way * (std::sin(slope) - kSlopeFriction * std::cos(slope));
  EXPECT_NEAR(box.ours().x(), expected, kSlopePosition_m);
  EXPECT_NEAR(box.ode().x(), expected, kSlopePosition_m);
  EXPECT_NEAR(box.pull(), kSlopeFriction * box.press(), kSlopeForceRatio * box.press());
}

}  // namespace
}  // namespace glissade::contact
