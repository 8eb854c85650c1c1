#include "jam_check.h"

#include <algorithm>
#include <array>

#include <glissade/contact/spring.h>
#include <glissade/geometry/displacement.h>

#include "features/contact_search.h"

namespace glissade::bench {
namespace {

using Eigen::Isometry3d;
using geometry::Displacement;

constexpr double kGreatestReach_m = 0.1e-3;
constexpr double kTolerance_m = 1e-6;            // of local minima of the distance
constexpr std::array<double, 1> kMargins{1e-6};  // not used

double energy(const geometry::Displacement& d, const contact::CouplingStiffness& k) {
  return 0.5 * (k.translational * d.v.squaredNorm() + k.rotational * d.w.squaredNorm());
}

}  // namespace

JamCheck::JamCheck(const test_support::SlidingScene& scene)
    : scene_(scene), bodies_(scene.obstacles, {scene.part_V}, kMargins), candidates_(bodies_, kGreatestReach_m) {}

bool JamCheck::could_move(const Isometry3d& X_WV, const geometry::Displacement& wanted,
                          const contact::CouplingStiffness& stiffness, double hold) {
  const double radius = scene_.part_V->radius();
  geometry::Displacement step = allowed(X_WV, wanted, stiffness, hold);
  if (geometry::motion_bound(step, radius) < kTrialStep_m) return false;
  step = step.scaled(geometry::fraction_within(step, radius, kTrialStep_m));
  const Isometry3d X_WV_next = geometry::displaced(X_WV, scene_.part_V->p_Vref(), step);
  const geometry::Displacement wanted_next{wanted.v - step.v, wanted.w - step.w};
  return energy(wanted_next, stiffness) < energy(wanted, stiffness) && !collides(X_WV_next);
}

geometry::Displacement JamCheck::allowed(const Isometry3d& X_WV, const geometry::Displacement& wanted,
                                         const contact::CouplingStiffness& stiffness, double hold) {
  const double reach = hold + 2.0 * kTrialStep_m;
  bodies_.place(0, X_WV);
  candidates_.clear();
  candidates_.look(reach, 0.0, {});
  candidates_.pairs().within(reach, pairs_);
  find_contacts(bodies_.bodies(), bodies_.body_of_mover(0), pairs_, reach, kTolerance_m, contacts_);
  const Eigen::Vector3d p_Wref = X_WV * scene_.part_V->p_Vref();
  rows_.clear();
  for (const contact::Contact& contact : contacts_)
    rows_.push_back({contact.n_W, contact.p_W - p_Wref, std::min(0.0, hold - contact.gap)});
  const contact::Projection<1> projection = solver_.project(wanted, stiffness, rows_);
  return projection.status == contact::ProjectionStatus::kSolved ? projection.displacement() : geometry::Displacement{};
}

bool JamCheck::collides(const Isometry3d& X_WV) {
  return std::any_of(scene_.obstacles.begin(), scene_.obstacles.end(), [&](const contact::Obstacle& obstacle) {
    return collision::intersects(obstacle.body->tree, scene_.part_V->tree,
                                 obstacle.X_WO.inverse(Eigen::Isometry) * X_WV, workspace_);
  });
}

}  // namespace glissade::bench
