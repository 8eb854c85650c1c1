#include <algorithm>
#include <cmath>

#include <glissade/base/assert.h>
#include <glissade/collision/convex_hull.h>

#include "hull/gjk_search.h"
#include "hull/hull_pair.h"

namespace glissade::collision {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kPerceptronLoops = 300;  // paper §2.2
constexpr int kLearningSteps = 12;     // before GJK, after a large movement
constexpr int kWideningSteps = 2;
constexpr double kWideningTurn = 0.12;  // radians, about
constexpr double kGoodGap = 0.7;        // as a fraction of the distance of two corners
constexpr std::int8_t kPlanesToLeave = 15;

// As a fraction of the radii: the least gap of bounding spheres that is an answer. A smaller one says little about
// hulls that are no balls, and would have to be looked at again soon.
constexpr double kGoodGapOfSpheres = 0.005;

// Radians: about. A plane between the centres that has turned by less will serve the next time too.
constexpr double kTurnThatLasts = 0.02;

// As a fraction of the radii: if hulls reach farther beyond the old plane, it has turned by some degrees, and the last
// simplex of GJK is of no use.
constexpr double kLargeMovement = 1e-3;

// Whether the remembered corners can be corners of these hulls.
[[maybe_unused]] bool belongs_to(const HullMemory& memory, const ConvexHull& hull_A, const ConvexHull& hull_B) {
  const auto has = [](const ConvexHull& hull, std::int32_t corner) {
    return corner >= 0 && static_cast<std::size_t>(corner) < hull.vertices().size();
  };
  if (memory.simplex_count < 0 || memory.simplex_count > 4) return false;
  for (int i = 0; i < memory.simplex_count; ++i) {
    const auto& corners = memory.simplex[static_cast<std::size_t>(i)];
    if (!has(hull_A, corners[0]) || !has(hull_B, corners[1])) return false;
  }
  return has(hull_A, memory.corner_A) && has(hull_B, memory.corner_B);
}

// The search for a separating plane: the old one, if it still separates, or a new one.
class PlaneSearch {
 public:
  explicit PlaneSearch(HullPair& hulls)
      : hulls_(hulls), memory_(hulls.memory()), n_guess_(memory_.n_A), was_by_centers_(memory_.by_centers) {}

  // Tests the bounding spheres.
  bool spheres_are_apart() {
    const ConvexHull& hull_A = hulls_.hull_A();
    const ConvexHull& hull_B = hulls_.hull_B();
    const Vector3d between = between_centers();
    const double square = between.squaredNorm();
    const double radii = hull_A.radius() + hull_B.radius() + hulls_.margin();
    memory_.by_centers = false;
    if (!(square > radii * radii)) return false;
    // B is larger if R is not exactly a rotation: |R x| is at most 1 + |R' R - 1| / 2 times |x|.
    const Eigen::Matrix3d difference = hulls_.R_AB().transpose() * hulls_.R_AB() - Eigen::Matrix3d::Identity();
    const double distance = std::sqrt(square);
    const double gap = distance - radii - 0.5 * difference.lpNorm<1>() * hull_B.radius();
    if (!(gap > kGoodGapOfSpheres * radii)) return false;
    memory_.by_centers = true;
    memory_.gap = gap;
    memory_.n_gap_A = between / distance;
    return true;
  }

  // Tests the plane across the line between the centres.
  bool plane_between_centers_separates() {
    memory_.by_centers = false;
    const Vector3d between = between_centers();
    const double distance = between.norm();
    if (!(distance > 0.0)) return false;
    const Vector3d n = between / distance;
    const double gap = n.dot(hulls_.extreme(n));
    if (!(gap > hulls_.margin())) return false;
    memory_.by_centers = !memory_.has_plane || (n - memory_.n_A).squaredNorm() > kTurnThatLasts * kTurnThatLasts;
    hulls_.remember_plane(n, gap);
    has_new_plane_ = !(was_by_centers_ && memory_.by_centers);  // while large movements go on, no plane will last
    return true;
  }

  // Whether a plane was found, which may be widened.
  bool has_new_plane() const { return has_new_plane_ || memory_.loops > 0; }

  // What is plainly apart is so along the line between the centres. It is where searches after a large movement begin,
  // and the next query too, as long as large movements go on.
  bool centers_separate() { return spheres_are_apart() || plane_between_centers_separates(); }

  // Whether the last plane has turned by some degrees, as far as the tests of it have told.
  bool has_moved_far() const { return moved_far_; }

  // Tests the plane fixed to A, then the plane fixed to B. Only the other hull has to be examined.
  bool old_plane_separates() {
    if (!memory_.has_plane) return false;
    const Vector3d against_B = -(hulls_.R_AB().transpose() * memory_.n_A);
    memory_.corner_B = hulls_.hull_B().support(against_B, memory_.corner_B);
    const double gap_A =
        memory_.n_A.dot(hulls_.p_AB()) - against_B.dot(hulls_.vertex_B(memory_.corner_B)) - memory_.reach_A;
    if (gap_A > hulls_.climbing_margin()) {
      memory_.gap = gap_A - hulls_.climbing_margin();
      memory_.n_gap_A = memory_.n_A;
      return true;
    }
    const Vector3d n = hulls_.R_AB() * memory_.n_B;
    memory_.corner_A = hulls_.hull_A().support(n, memory_.corner_A);
    const double gap_B = n.dot(hulls_.p_AB()) - memory_.reach_B - n.dot(hulls_.vertex_A(memory_.corner_A));
    moved_far_ = -gap_B > kLargeMovement * (hulls_.hull_A().radius() + hulls_.hull_B().radius());
    // The extent of B along n changes if R is not exactly a rotation.
    const double margin =
        hulls_.climbing_margin() + (hulls_.R_AB().transpose() * n - memory_.n_B).lpNorm<1>() * hulls_.hull_B().reach();
    if (!(gap_B > margin)) return false;
    memory_.gap = gap_B - margin;
    memory_.n_gap_A = n;
    return true;
  }

  // The remembered normal, or the direction between the centres.
  Vector3d first_normal() const {
    if (memory_.has_plane) return memory_.n_A;
    const Vector3d between = between_centers();
    const double length = between.norm();
    return length > 0.0 ? Vector3d(between / length) : Vector3d::UnitX();
  }

  // Starts anew if the memory is too old to help.
  bool gjk_after_movement() {
    if (memory_.has_plane && !moved_far_) return gjk_separates(hulls_, n_guess_);
    memory_.simplex_count = 0;
    const Vector3d n = first_normal();
    memory_.corner_A = hulls_.hull_A().start_toward(n);
    memory_.corner_B = hulls_.hull_B().start_toward(-(hulls_.R_AB().transpose() * n));
    return learn(kLearningSteps) || gjk_separates(hulls_, n_guess_);
  }

  // The learning rule of the perceptron for the two corners that violate the plane most. Adding both to the plane at
  // once eliminates its distance from the origin. Steps decrease, so that it converges.
  bool learn(int most_loops) {
    Vector3d n = first_normal();
    for (int loop = 0; loop < most_loops; ++loop) {
      ++memory_.loops;
      const Vector3d w = hulls_.extreme(n);
      const double gap = n.dot(w);
      if (gap > hulls_.margin()) {
        hulls_.remember_plane(n, gap);
        return true;
      }
      const double square = w.squaredNorm();
      if (!(square > 0.0)) return false;
      // The step brings these two corners to their sides, and a share of the step farther.
      const double temperature = 1.0 - static_cast<double>(loop) / most_loops;
      n += (1.0 + temperature) * ((hulls_.margin() - gap) / square) * w;
      const double length = n.norm();
      if (!(length > 1e-6)) return false;
      n /= length;
    }
    n_guess_ = n;
    return false;
  }

  // Turns a new plane slightly toward the direction between the two corners that it would meet first, while that
  // enlarges the gap: so it holds for longer. These corners are at least as far apart as the hulls, so a gap of most of
  // their distance is good enough. Where hulls nearly touch there is little to gain, so after a failed attempt some
  // planes are left as they are.
  void widen() {
    if (memory_.planes_to_leave > 0) {
      --memory_.planes_to_leave;
      return;
    }
    for (int step = 0; step < kWideningSteps; ++step) {
      const Vector3d w = hulls_.point(memory_.corner_A, memory_.corner_B).w;
      const double distance = w.norm();
      if (!(memory_.gap < kGoodGap * distance)) return;
      const Vector3d difference = w / distance - memory_.n_A;
      const double angle = difference.norm();
      const Vector3d n = (memory_.n_A + std::min(1.0, kWideningTurn / angle) * difference).normalized();
      const HullMemory before = memory_;
      const double gap = n.dot(hulls_.extreme(n));
      if (!(gap - hulls_.climbing_margin() > memory_.gap)) {
        memory_ = before;
        if (step == 0) memory_.planes_to_leave = kPlanesToLeave;
        return;
      }
      hulls_.remember_plane(n, gap);
    }
  }

 private:
  Vector3d between_centers() const {
    return hulls_.R_AB() * hulls_.hull_B().center() + hulls_.p_AB() - hulls_.hull_A().center();
  }

  HullPair& hulls_;
  HullMemory& memory_;
  Vector3d n_guess_;  ///< estimate of the normal, if there is a plane in memory
  bool moved_far_ = false;
  bool was_by_centers_;
  bool has_new_plane_ = false;
};

}  // namespace

bool hulls_apart(const ConvexHull& hull_A, const ConvexHull& hull_B, const Isometry3d& X_AB, HullMemory& memory,
                 HullTest test) noexcept {
  GLISSADE_ASSERT(belongs_to(memory, hull_A, hull_B));
  HullPair hulls(hull_A, hull_B, X_AB, memory);
  PlaneSearch search(hulls);
  bool apart = false;
  if (test == HullTest::kPerceptron) {
    apart = search.old_plane_separates() || search.learn(kPerceptronLoops);
  } else if (memory.met) {
    apart = !old_corners_meet(hulls) && gjk_separates(hulls, memory.n_A);
  } else if (memory.by_centers || !memory.has_plane) {
    apart = search.centers_separate() || search.old_plane_separates() || search.gjk_after_movement();
  } else {
    apart = search.old_plane_separates() || (search.has_moved_far() && search.centers_separate()) ||
            search.gjk_after_movement();
  }
  // A new plane has only the gap at which it was found; widening may enlarge it.
  if (apart && test == HullTest::kExact && search.has_new_plane()) search.widen();
  memory.met = !apart;
  return apart;
}

}  // namespace glissade::collision
