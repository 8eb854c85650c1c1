#include "hull/gjk_search.h"

#include <cstdint>
#include <optional>

#include "hull/gjk_simplex.h"

namespace glissade::collision {
namespace {

using Eigen::Vector3d;

constexpr int kRounds = 128;
constexpr int kAttempts = 3;

// Radians, approximately. The new plane of a pair that moves little lies within the first angle of the old one. A plane
// spanned by three old points is worth a test within the second.
constexpr double kFirstTurn = 0.06;
constexpr double kSmallTurn = 0.02;

GjkSimplex simplex_of_memory(const HullPair& hulls) {
  GjkSimplex simplex;
  for (int i = 0; i < hulls.memory().simplex_count; ++i) {
    const auto& corners = hulls.memory().simplex[static_cast<std::size_t>(i)];
    simplex.add(hulls.point(corners[0], corners[1]));
  }
  return simplex;
}

class GjkSearch {
 public:
  GjkSearch(HullPair& hulls, const Vector3d& n_guess) : hulls_(hulls), memory_(hulls.memory()), n_guess_(n_guess) {}

  // Runs to the end, starting from the last simplex. Starts anew if rounding has misled the search.
  bool run() {
    GjkSimplex simplex = simplex_of_memory(hulls_);
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      if (simplex.count() == 0) simplex.add(hulls_.point(memory_.corner_A, memory_.corner_B));
      const bool apart = attempt_from(simplex);
      remember(simplex);
      if (apart || simplex.encloses_origin()) return apart;
      simplex = GjkSimplex();
    }
    return false;
  }

 private:
  // Returns whether a plane separates the hulls. If not, the simplex encloses the origin, or rounding prevents a
  // decision.
  bool attempt_from(GjkSimplex& simplex) {
    double turn = kFirstTurn;
    if (old_points_separate(simplex)) return true;
    for (int round = 0; round < kRounds && !simplex.encloses_origin(); ++round) {
      ++memory_.loops;
      const Vector3d nearest = simplex.reduce_to_nearest();
      const double length = nearest.norm();
      if (!(length > hulls_.margin())) return false;
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

  // Three points that were nearest to the origin last time mostly still span the right plane, even if the point of that
  // plane nearest to the origin now lies slightly outside of their triangle.
  bool old_points_separate(GjkSimplex& simplex) {
    if (simplex.count() != 3 || !memory_.has_plane) return false;
    const Vector3d nearest = simplex.nearest_of_plane();
    const Vector3d n = nearest.normalized();
    if (!((n - n_guess_).squaredNorm() < kSmallTurn * kSmallTurn)) return false;
    ++memory_.loops;
    return look_along(n, nearest, simplex) == Step::kApart;
  }

  // The old normal turned toward n by the angle `turn`; nothing if n lies within that angle. Where hulls nearly touch,
  // the nearest point of a few corners lies in a direction far from the normal, and climbing there and back over
  // thousands of corners takes long.
  std::optional<Vector3d> turned_toward(const Vector3d& n, double turn) const {
    if (!memory_.has_plane || turn > 1.0) return std::nullopt;
    const Vector3d difference = n - n_guess_;
    const double angle = difference.norm();
    if (!(angle > turn)) return std::nullopt;
    return (n_guess_ + turn / angle * difference).normalized();
  }

  enum class Step : std::uint8_t { kApart, kNearer, kStuck };

  // Tests the plane with normal n. If it does not separate, adds the extreme point to the simplex if that brings the
  // simplex nearer to the origin.
  Step look_along(const Vector3d& n, const Vector3d& nearest, GjkSimplex& simplex) {
    const Vector3d w = hulls_.extreme(n);
    const double gap = n.dot(w);
    if (gap > hulls_.margin()) {
      hulls_.remember_plane(n, gap);
      return Step::kApart;
    }
    if (!(nearest.dot(w) < nearest.squaredNorm())) return Step::kStuck;
    if (simplex.has(memory_.corner_A, memory_.corner_B)) return Step::kStuck;
    simplex.add(hulls_.point(memory_.corner_A, memory_.corner_B));
    return Step::kNearer;
  }

  void remember(const GjkSimplex& simplex) {
    memory_.simplex_count = static_cast<std::int8_t>(simplex.count());
    for (int i = 0; i < simplex.count(); ++i)
      memory_.simplex[static_cast<std::size_t>(i)] = {simplex[i].corner_A, simplex[i].corner_B};
  }

  HullPair& hulls_;
  HullMemory& memory_;
  const Vector3d n_guess_;
};

}  // namespace

bool old_corners_meet(const HullPair& hulls) {
  if (hulls.memory().simplex_count < 4) return false;
  return simplex_of_memory(hulls).encloses_origin();
}

bool gjk_separates(HullPair& hulls, const Vector3d& n_guess) {
  return GjkSearch(hulls, n_guess).run();
}

}  // namespace glissade::collision
