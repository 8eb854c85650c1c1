#include <algorithm>
#include <cmath>
#include <optional>

#include <glissade/collision/separating_plane.h>

#include "gjk_simplex.h"

namespace glissade::collision {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kPerceptronLoops = 300;  // paper §2.2
constexpr int kLearningSteps = 12;     // before GJK, after a large movement
constexpr int kWideningSteps = 2;
constexpr double kWideningTurn = 0.12;  // radians, about
constexpr double kGoodGap = 0.7;        // of the distance of two corners
constexpr std::int8_t kPlanesToLeave = 15;
constexpr int kGjkRounds = 128;
constexpr int kGjkAttempts = 3;

// Radians, about. A pair that moves little has its new plane within the first of the old one; what three old points
// span is worth a look within the second.
constexpr double kFirstTurn = 0.06;
constexpr double kSmallTurn = 0.02;

// Of the radii: how far hulls reach beyond the old plane when it has turned by some degrees, and what GJK had in hand
// is of no use.
constexpr double kLargeMovement = 1e-3;

// Of all coordinates that take part: each is rounded a few times.
constexpr double kRoundingOfGap = 1e-14;

// One question about two hulls.
class HullQuery {
 public:
  HullQuery(const ConvexHull& hull_A, const ConvexHull& hull_B, const Isometry3d& X_AB, HullMemory& memory)
      : hull_A_(hull_A),
        hull_B_(hull_B),
        R_AB_(X_AB.linear()),
        p_AB_(X_AB.translation()),
        memory_(memory),
        n_guess_(memory.n_A) {
    const double reach = hull_A.reach() + hull_B.reach() + p_AB_.lpNorm<1>();
    margin_ = hull_A.outside() + hull_B.outside() + kRoundingOfGap * reach;
    climbing_margin_ = margin_ + hull_A.climbing_error() + hull_B.climbing_error();
    memory_.gap = 0.0;
    memory_.loops = 0;
  }

  // The plane as it is fixed to A, then to B: only the other hull has to be looked at.
  bool old_plane_separates() {
    if (!memory_.has_plane) return false;
    const Vector3d against_B = -(R_AB_.transpose() * memory_.n_A);
    memory_.corner_B = hull_B_.support(against_B, memory_.corner_B);
    const double gap_A = memory_.n_A.dot(p_AB_) - against_B.dot(vertex_B(memory_.corner_B)) - memory_.reach_A;
    if (gap_A > climbing_margin_) {
      memory_.gap = gap_A - climbing_margin_;
      memory_.n_gap_A = memory_.n_A;
      return true;
    }
    const Vector3d n = R_AB_ * memory_.n_B;
    memory_.corner_A = hull_A_.support(n, memory_.corner_A);
    const double gap_B = n.dot(p_AB_) - memory_.reach_B - n.dot(vertex_A(memory_.corner_A));
    moved_far_ = -gap_B > kLargeMovement * (hull_A_.radius() + hull_B_.radius());
    // What B reaches along n differs if R is not quite a rotation.
    const double margin = climbing_margin_ + (R_AB_.transpose() * n - memory_.n_B).lpNorm<1>() * hull_B_.reach();
    if (!(gap_B > margin)) return false;
    memory_.gap = gap_B - margin;
    memory_.n_gap_A = n;
    return true;
  }

  // The corners that GJK enclosed the origin with last time.
  bool old_corners_meet() const {
    if (memory_.simplex_count < 4) return false;
    return simplex_of_memory().encloses_origin();
  }

  // From the centres, if nothing is remembered.
  Vector3d first_normal() const {
    if (memory_.has_plane) return memory_.n_A;
    const Vector3d between = R_AB_ * hull_B_.center() + p_AB_ - hull_A_.center();
    const double length = between.norm();
    return length > 0.0 ? Vector3d(between / length) : Vector3d::UnitX();
  }

  // Begins anew if what is remembered is too old to help.
  bool gjk_after_movement() {
    if (memory_.has_plane && !moved_far_) return gjk();
    memory_.simplex_count = 0;
    const Vector3d n = first_normal();
    memory_.corner_A = hull_A_.start_toward(n);
    memory_.corner_B = hull_B_.start_toward(-(R_AB_.transpose() * n));
    return learn(kLearningSteps) || gjk();
  }

  // The learning rule of the perceptron, for the two corners that are most on the wrong side: both are added to the
  // plane at once, which leaves its distance from the origin out of account. Steps get smaller, so that it settles.
  bool learn(int most_loops) {
    Vector3d n = first_normal();
    for (int loop = 0; loop < most_loops; ++loop) {
      ++memory_.loops;
      const Vector3d w = extreme(n);
      const double gap = n.dot(w);
      if (gap > margin_) return separated_by(n, gap);
      const double square = w.squaredNorm();
      if (!(square > 0.0)) return false;
      // Far enough to put these two on their sides, and a share of the step beyond.
      const double temperature = 1.0 - static_cast<double>(loop) / most_loops;
      n += (1.0 + temperature) * ((margin_ - gap) / square) * w;
      const double length = n.norm();
      if (!(length > 1e-6)) return false;
      n /= length;
    }
    n_guess_ = n;
    return false;
  }

  // Turns a new plane a little toward where the two corners are that it met first, while that makes the gap larger: so
  // it holds for longer. They are no nearer to each other than the hulls, so most of their distance is good enough.
  // Where hulls nearly touch there is little to be won, so after a try in vain some planes are left as they are.
  void widen() {
    if (memory_.planes_to_leave > 0) {
      --memory_.planes_to_leave;
      return;
    }
    for (int step = 0; step < kWideningSteps; ++step) {
      const Vector3d w = point(memory_.corner_A, memory_.corner_B).w;
      const double distance = w.norm();
      if (!(memory_.gap < kGoodGap * distance)) return;
      const Vector3d difference = w / distance - memory_.n_A;
      const double angle = difference.norm();
      const Vector3d n = (memory_.n_A + std::min(1.0, kWideningTurn / angle) * difference).normalized();
      const HullMemory before = memory_;
      const double gap = n.dot(extreme(n));
      if (!(gap - climbing_margin_ > memory_.gap)) {
        memory_ = before;
        if (step == 0) memory_.planes_to_leave = kPlanesToLeave;
        return;
      }
      separated_by(n, gap);
    }
  }

  // To the end, from what it had in hand last time. What rounding has led astray begins anew.
  bool gjk() {
    GjkSimplex simplex = simplex_of_memory();
    for (int attempt = 0; attempt < kGjkAttempts; ++attempt) {
      if (simplex.count() == 0) simplex.add(point(memory_.corner_A, memory_.corner_B));
      const bool apart = run_gjk(simplex);
      remember(simplex);
      if (apart || simplex.encloses_origin()) return apart;
      simplex = GjkSimplex();
    }
    return false;
  }

 private:
  const Vector3d& vertex_A(std::int32_t corner) const { return hull_A_.vertices()[static_cast<std::size_t>(corner)]; }
  const Vector3d& vertex_B(std::int32_t corner) const { return hull_B_.vertices()[static_cast<std::size_t>(corner)]; }

  GjkPoint point(std::int32_t corner_A, std::int32_t corner_B) const {
    return {R_AB_ * vertex_B(corner_B) + p_AB_ - vertex_A(corner_A), corner_A, corner_B};
  }

  // Whether a plane separates them; if not, the simplex encloses the origin, or rounding prevents a decision.
  bool run_gjk(GjkSimplex& simplex) {
    double turn = kFirstTurn;
    if (old_points_separate(simplex)) return true;
    for (int round = 0; round < kGjkRounds && !simplex.encloses_origin(); ++round) {
      ++memory_.loops;
      const Vector3d nearest = simplex.reduce_to_nearest();
      const double length = nearest.norm();
      if (!(length > margin_)) return false;
      const Vector3d n = nearest / length;
      Step step = Step::kStuck;
      if (const std::optional<Vector3d> on_the_way = turned_toward(n, turn)) {
        turn *= 4.0;
        step = look_along(*on_the_way, nearest, simplex);
      }
      if (step == Step::kStuck) step = look_along(n, nearest, simplex);
      if (step != Step::kNearer) return step == Step::kApart;
    }
    return false;
  }

  // Three points that were nearest to the origin last time mostly still span the plane that it needs, even if the
  // nearest point of that plane is now a little beside them.
  bool old_points_separate(GjkSimplex& simplex) {
    if (simplex.count() != 3 || !memory_.has_plane) return false;
    const Vector3d nearest = simplex.nearest_of_plane();
    const Vector3d n = nearest.normalized();
    if (!((n - n_guess_).squaredNorm() < kSmallTurn * kSmallTurn)) return false;
    ++memory_.loops;
    return look_along(n, nearest, simplex) == Step::kApart;
  }

  // The old normal turned so far toward n, if that is not far enough. Where hulls nearly touch, the nearest point of a
  // few corners lies in a direction far from the normal, and the way there and back over thousands of corners takes
  // long.
  std::optional<Vector3d> turned_toward(const Vector3d& n, double turn) const {
    if (!memory_.has_plane || turn > 1.0) return std::nullopt;
    const Vector3d difference = n - n_guess_;
    const double angle = difference.norm();
    if (!(angle > turn)) return std::nullopt;
    return (n_guess_ + turn / angle * difference).normalized();
  }

  enum class Step : std::uint8_t { kApart, kNearer, kStuck };

  // Whether the plane along n separates; else the simplex gets the extreme point, if that brings it nearer to the
  // origin.
  Step look_along(const Vector3d& n, const Vector3d& nearest, GjkSimplex& simplex) {
    const Vector3d w = extreme(n);
    const double gap = n.dot(w);
    if (gap > margin_) {
      separated_by(n, gap);
      return Step::kApart;
    }
    if (!(nearest.dot(w) < nearest.squaredNorm())) return Step::kStuck;
    if (simplex.has(memory_.corner_A, memory_.corner_B)) return Step::kStuck;
    simplex.add(point(memory_.corner_A, memory_.corner_B));
    return Step::kNearer;
  }

  // The point of B − A that is least along n: surely, if it lies beyond the margin. What climbing may have missed is
  // looked for only where it matters.
  Vector3d extreme(const Vector3d& n) {
    const Vector3d against_B = -(R_AB_.transpose() * n);
    memory_.corner_A = hull_A_.support(n, memory_.corner_A);
    memory_.corner_B = hull_B_.support(against_B, memory_.corner_B);
    const Vector3d w = point(memory_.corner_A, memory_.corner_B).w;
    const double gap = n.dot(w);
    if (!(gap > margin_) || gap > climbing_margin_) return w;
    memory_.corner_A = hull_A_.furthest(n);
    memory_.corner_B = hull_B_.furthest(against_B);
    return point(memory_.corner_A, memory_.corner_B).w;
  }

  bool separated_by(const Vector3d& n, double gap) {
    memory_.n_A = n;
    memory_.n_gap_A = n;
    memory_.n_B = R_AB_.transpose() * n;
    memory_.reach_A = n.dot(vertex_A(memory_.corner_A));
    memory_.reach_B = -memory_.n_B.dot(vertex_B(memory_.corner_B));
    memory_.has_plane = true;
    memory_.gap = gap > climbing_margin_ ? gap - climbing_margin_ : gap - margin_;
    return true;
  }

  GjkSimplex simplex_of_memory() const {
    GjkSimplex simplex;
    for (int i = 0; i < memory_.simplex_count; ++i) {
      const auto& corners = memory_.simplex[static_cast<std::size_t>(i)];
      simplex.add(point(corners[0], corners[1]));
    }
    return simplex;
  }

  void remember(const GjkSimplex& simplex) {
    memory_.simplex_count = static_cast<std::int8_t>(simplex.count());
    for (int i = 0; i < simplex.count(); ++i)
      memory_.simplex[static_cast<std::size_t>(i)] = {simplex[i].corner_A, simplex[i].corner_B};
  }

  const ConvexHull& hull_A_;
  const ConvexHull& hull_B_;
  const Eigen::Matrix3d R_AB_;
  const Vector3d p_AB_;
  HullMemory& memory_;
  Vector3d n_guess_;  ///< where the normal may be, if there is a plane in memory
  bool moved_far_ = false;
  double margin_;           ///< for what is certain but for rounding
  double climbing_margin_;  ///< the same, if climbing may have stopped too early
};

}  // namespace

bool hulls_apart(const ConvexHull& hull_A, const ConvexHull& hull_B, const Isometry3d& X_AB, HullMemory& memory,
                 HullTest test) noexcept {
  HullQuery query(hull_A, hull_B, X_AB, memory);
  bool apart = false;
  if (test == HullTest::kPerceptron) {
    apart = query.old_plane_separates() || query.learn(kPerceptronLoops);
  } else if (memory.met) {
    apart = !query.old_corners_meet() && query.gjk();
  } else {
    apart = query.old_plane_separates() || query.gjk_after_movement();
  }
  // A plane that is new has but the gap that it was found with.
  if (apart && test == HullTest::kExact && memory.loops > 0) query.widen();
  memory.met = !apart;
  return apart;
}

}  // namespace glissade::collision
