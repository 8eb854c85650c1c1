#pragma once

/// Visitors that test the triangle pairs of a query exactly.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glissade/collision/query_types.h>
#include <glissade/geometry/triangle_pair.h>

#include "query/placed_trees.h"
#include "query/triangle_visitor.h"

namespace glissade::collision {

/// Whether two triangles are within a tolerance, and their distance; negative if it was not computed.
struct Nearness {
  bool near;
  double distance;
};

inline Nearness nearness(const geometry::TrianglePoints& a, const geometry::TrianglePoints& b, double tolerance) {
  if (tolerance == 0.0) {
    const bool meet = geometry::triangles_intersect(a, b);
    return {meet, meet ? 0.0 : -1.0};
  }
  const double distance = geometry::triangle_distance(a, b).distance;
  return {distance <= tolerance, distance};
}

/// Looks up the triangles of a visit.
class PlacedVisitor : public TriangleVisitor {
 public:
  double distance(std::uint32_t leaf_M, std::uint32_t leaf_N, int pair) override {
    const TrianglePair triangles = placed_.triangles(leaf_M, leaf_N, pair);
    return geometry::triangle_distance(placed_.points_A(triangles), placed_.points_B(triangles)).distance;
  }

 protected:
  explicit PlacedVisitor(const PlacedTrees& placed) : placed_(placed) {}
  ~PlacedVisitor() = default;

  const PlacedTrees& placed_;
};

/// Stops at the first pair within the tolerance.
class AnyPair final : public PlacedVisitor {
 public:
  AnyPair(const PlacedTrees& placed, double tolerance) : PlacedVisitor(placed), tolerance_(tolerance) {}

  PairOutcome visit(std::uint32_t leaf_M, std::uint32_t leaf_N, int pair) override {
    const TrianglePair triangles = placed_.triangles(leaf_M, leaf_N, pair);
    const Nearness found = nearness(placed_.points_A(triangles), placed_.points_B(triangles), tolerance_);
    return {found.near, found.distance};
  }
  PairOutcome found(std::uint32_t, std::uint32_t, int) override { return {true, 0.0}; }

 private:
  double tolerance_;
};

/// Triangle pairs to be measured at once in vector code.
class WaitingPairs {
 public:
  /// Adds a pair. Returns whether there is no room for another one.
  bool add(const TrianglePair& triangles) {
    waiting_[count_++] = triangles;
    return count_ == waiting_.size();
  }
  /// Measures the pairs added since the last call. Where they intersect, the distance is 0 and no points are set. Valid
  /// until the next call.
  std::span<const ClosePair> measure(const PlacedTrees& placed);

 private:
  std::array<TrianglePair, geometry::kPairsToMeasure> waiting_;
  std::array<ClosePair, geometry::kPairsToMeasure> measured_;
  std::size_t count_ = 0;
};

/// Collects every pair within the tolerance, as triangle indices or with closest points. All are there once `finish` is
/// called; their order is arbitrary.
template <typename Pair>
class PairCollector final : public PlacedVisitor {
 public:
  PairCollector(const PlacedTrees& placed, double tolerance, std::vector<Pair>& pairs)
      : PlacedVisitor(placed), tolerance_(tolerance), pairs_(pairs) {}

  PairOutcome visit(std::uint32_t leaf_M, std::uint32_t leaf_N, int pair) override {
    return note(placed_.triangles(leaf_M, leaf_N, pair), false);
  }
  PairOutcome found(std::uint32_t leaf_M, std::uint32_t leaf_N, int pair) override {
    return note(placed_.triangles(leaf_M, leaf_N, pair), true);
  }
  bool visit_each(std::uint32_t leaf_M, std::uint32_t leaf_N, PairMask pairs) override {
    return PlacedVisitor::visit_each(leaf_M, leaf_N, pairs);
  }
  void finish() { measure_waiting(); }

 private:
  PairOutcome note(const TrianglePair& triangles, bool intersect);
  void measure_waiting();

  double tolerance_;
  std::vector<Pair>& pairs_;
  WaitingPairs waiting_;
};

template <>
inline void PairCollector<TrianglePair>::measure_waiting() {}

template <>
inline PairOutcome PairCollector<TrianglePair>::note(const TrianglePair& triangles, bool intersect) {
  const Nearness found =
      intersect ? Nearness{true, 0.0} : nearness(placed_.points_A(triangles), placed_.points_B(triangles), tolerance_);
  if (found.near) pairs_.push_back(triangles);
  return {false, found.distance};
}

template <>
inline PairOutcome PairCollector<ClosePair>::note(const TrianglePair& triangles, bool /*intersect*/) {
  const geometry::TriangleDistance closest =
      geometry::triangle_distance(placed_.points_A(triangles), placed_.points_B(triangles));
  if (closest.distance <= tolerance_) pairs_.push_back({triangles, closest.distance, closest.p_a, closest.p_b});
  return {false, closest.distance};
}

template <>
inline void PairCollector<ClosePair>::measure_waiting() {
  for (const ClosePair& close : waiting_.measure(placed_)) {
    if (close.distance == 0.0) {
      note(close.triangles, true);
    } else if (close.distance <= tolerance_) {
      pairs_.push_back(close);
    }
  }
}

template <>
inline bool PairCollector<ClosePair>::visit_each(std::uint32_t leaf_M, std::uint32_t leaf_N, PairMask pairs) {
  for (; pairs != 0; pairs &= pairs - 1) {
    if (waiting_.add(placed_.triangles(leaf_M, leaf_N, std::countr_zero(pairs)))) measure_waiting();
  }
  return false;
}

}  // namespace glissade::collision
