#pragma once

/// Directions that separate triangles for as long as possible while they slide past each other. Each is fixed to one of
/// the two bodies: where a part turns, those that turn with it may last longer than those that stand still.

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <Eigen/Core>

#include <glissade/geometry/triangle_pair.h>

#include "certificate/fixed_direction.h"
#include "certificate/separation_kernel.h"

namespace glissade::contact {

/// A direction, from the obstacle to the part, and how far it separates two triangles at both ends of a path; metres.
struct Separation {
  Eigen::Vector3d n_O;  ///< at the beginning, in the axes of the obstacle; unit, or zero where none is known
  bool turns_with_part;
  double begin;
  double end;
  /// By how much a direction that turns separates them on the whole path, metres, if this was sought: it falls short by
  /// the curvature of the path only. Minus infinity otherwise.
  double turning;

  double least() const { return std::min(begin, end); }
};

/// The separations of pairs of triangles of two bodies, found for up to eight pairs at once. Not thread-safe.
class LastingSeparations {
 public:
  /// Begins with no pair. The corners of the part go from `begin` to `end` in the frame of the obstacle, which stays.
  /// `gap` (metres) for directions fixed to the obstacle, `gap_turning` for those that turn with the part. At the end,
  /// such a direction may be shorter than a unit, if that map is not a rotation.
  void start(const CornerMap& begin, const CornerMap& end, double gap, double gap_turning);
  /// Forgets the pairs that were added.
  void clear();

  std::size_t count() const { return count_; }
  bool is_full() const { return count_ == geometry::kPairsToMeasure; }
  /// Adds a pair: a triangle of the obstacle and one of the part, each in its own frame, and whether its direction may
  /// turn with the part. There must be room.
  void add(const geometry::TrianglePoints& obstacle_O, const geometry::TrianglePoints& part_V, bool may_turn_with_part);

  /// For each pair added since the last call, in order: of a few directions the one that would keep the triangles apart
  /// by its gap for the most paths like this one, or else one that separates them by as much as any at both ends. The
  /// directions are the normals of both triangles, one between both, and these across the motion. Where none serves for
  /// this path and another one, the direction of the closest points at the beginning is tried, and where this one
  /// fails, that at the end. They separate the most, but where triangles slide towards each other they serve for a
  /// short way only. Valid until the next call.
  std::span<const Separation> find() { return find(false); }
  /// The same. Where none of these separates by its gap, a direction that turns from the one of the closest points to
  /// the other is tried: long edges that cross turn past each other so.
  std::span<const Separation> find_or_turn() { return find(true); }

  /// The direction of a separation that was found on the present path.
  FixedDirection direction(const Separation& separation) const {
    if (!separation.turns_with_part) return {separation.n_O, false};
    return {path_.begin.A.transpose() * separation.n_O, true};
  }

 private:
  std::span<const Separation> find(bool may_turn);
  bool all_pairs_last(double paths) const;

  PathOfPart path_{};
  std::size_t count_ = 0;
  geometry::TrianglesToMeasure triangles_{};
  PairsOnPath on_path_{};
  std::array<Separation, geometry::kPairsToMeasure> found_;
};

}  // namespace glissade::contact
