#include "certificate/lasting_separation.h"

#include <utility>

#include <glissade/base/assert.h>

namespace glissade::contact {
namespace {

/// A direction that serves for so many more paths is good enough.
constexpr double kEnoughPaths = 1.0;

/// A rotation by no more than this, in rad, is rounding: the part does not turn.
constexpr double kNoTurn = 1e-13;

}  // namespace

void LastingSeparations::start(const CornerMap& begin, const CornerMap& end, double gap, double gap_turning) {
  path_ = {.begin = begin, .end = end, .gap = gap, .gap_turning = gap_turning};
  path_.turns = (end.A - begin.A).norm() > kNoTurn;
  if (path_.turns) path_.turn = end.A.inverse().transpose() * begin.A.transpose();
  clear();
}

void LastingSeparations::clear() {
  count_ = 0;
}

void LastingSeparations::add(const geometry::TrianglePoints& obstacle_O, const geometry::TrianglePoints& part_V,
                             bool may_turn_with_part) {
  GLISSADE_ASSERT(!is_full());
  geometry::put_triangle(obstacle_O, count_, triangles_.a);
  geometry::put_triangle(part_V, count_, triangles_.b);
  on_path_.may_turn_with_part[count_] = may_turn_with_part ? 1.0 : 0.0;
  ++count_;
}

std::span<const Separation> LastingSeparations::find(bool may_turn) {
  if (count_ == 0) return {};
  separate_by_normals(triangles_, path_, on_path_);
  if (!all_pairs_last(kEnoughPaths)) {
    geometry::ClosestPoints at_begin;
    geometry::find_closest_points(on_path_.begin, at_begin);
    separate_by_points(at_begin, path_, kEnoughPaths, on_path_);
    if (!all_pairs_last(0.0)) {
      geometry::ClosestPoints at_end;
      geometry::find_closest_points(on_path_.end, at_end);
      separate_by_points(at_end, path_, 0.0, on_path_);
      if (may_turn && !all_pairs_last(0.0)) separate_by_turning(at_begin, at_end, on_path_);
    }
  }
  const std::size_t count = std::exchange(count_, 0);
  for (std::size_t i = 0; i < count; ++i)
    found_[i] = {geometry::vector_of_pair(on_path_.n, i), on_path_.turns_with_part[i] > 0.0, on_path_.gap_at_begin[i],
                 on_path_.gap_at_end[i], on_path_.turning[i]};
  return std::span(found_).first(count);
}

bool LastingSeparations::all_pairs_last(double paths) const {
  return std::all_of(on_path_.paths.begin(), on_path_.paths.begin() + static_cast<std::ptrdiff_t>(count_),
                     [&](double of_pair) { return of_pair >= paths; });
}

}  // namespace glissade::contact
