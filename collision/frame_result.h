#pragma once

/// Result of one frame of the collision pipeline, with the work and time of each stage.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glissade/collision/convex_hull.h>
#include <glissade/collision/query_types.h>
#include <glissade/collision/world.h>

namespace glissade::collision {

/// Detail that a pipeline computes for objects that meet.
enum class PairQuery : std::uint8_t {
  kVerdict,        ///< only that they meet
  kTrianglePairs,  ///< also the triangle pairs in which they meet
  kClosePairs,     ///< also their closest points; between objects with selections, pairs with a selected triangle only
};

struct PipelineOptions {
  PairQuery query = PairQuery::kVerdict;
  HullTest hull_test = HullTest::kExact;
  /// Upper limit of the distance given to `CollisionPipeline::step` (metres). Two objects meet if their distance is at
  /// most that of the step.
  double greatest_distance = 0.0;
  /// Number of threads that work on a frame, including the calling one. 0: as many as the machine has processors.
  int threads = 0;
};

/// Two objects of a world. The one of lower index is A of the query, the other is B.
struct ObjectPair {
  ObjectId object_A;
  ObjectId object_B;

  auto operator<=>(const ObjectPair&) const = default;
};

/// Number of items that entered a stage of the pipeline, number that it passed on, and its time.
struct StageReport {
  std::int64_t in = 0;
  std::int64_t out = 0;
  std::chrono::nanoseconds time{0};

  StageReport& operator+=(const StageReport& other) {
    in += other.in;
    out += other.out;
    time += other.time;
    return *this;
  }
};

/// Work of one frame. Stages see only pairs with an object that moved, because objects at rest cost nothing.
struct FrameReport {
  std::int64_t objects = 0;    ///< in the world
  std::int64_t neighbors = 0;  ///< pairs of objects whose fattened boxes overlap, at rest or not
  /// In: objects that were moved, added or removed. Out: objects that are new or have moved.
  StageReport queue;
  /// In: objects that are new or have moved. Out: their enabled pairs whose fattened boxes overlap.
  StageReport neighbor_finding;
  /// In: pairs that may have used up the gap known from an earlier frame. Out: pairs that no plane separates.
  StageReport separating_planes;
  /// In: pairs that no plane separates. Out: pairs among them that meet.
  StageReport exact;
  /// In: pairs that have begun or ceased to meet. Out: all pairs that meet, at rest or not.
  StageReport result;
  std::chrono::nanoseconds total{0};

  /// Adds the work of another frame. For means, divide by the number of frames.
  FrameReport& operator+=(const FrameReport& other) {
    objects += other.objects;
    neighbors += other.neighbors;
    queue += other.queue;
    neighbor_finding += other.neighbor_finding;
    separating_planes += other.separating_planes;
    exact += other.exact;
    result += other.result;
    total += other.total;
    return *this;
  }
};

/// The pairs of objects that meet in one frame, with the detail that the pipeline's `PairQuery` requires.
struct FrameResult {
  std::uint64_t frame = 0;                    ///< number of the frame, from 1; 0: none yet
  std::chrono::nanoseconds time_of_poses{0};  ///< when the poses were taken, by the pipeline's clock

  /// Age of the poses at the time `now` of that clock. The duration of the frame is in the report.
  std::chrono::nanoseconds age(std::chrono::nanoseconds now) const { return now - time_of_poses; }

  std::vector<ObjectPair> meeting;  ///< ascending

  /// Triangle pairs of `meeting[i]`, in ascending order of the triangle indices. Empty unless the `PairQuery` of the
  /// pipeline is kTrianglePairs or kClosePairs, respectively.
  std::span<const TrianglePair> triangle_pairs(std::size_t i) const { return part_of(all_triangle_pairs, i); }
  std::span<const ClosePair> close_pairs(std::size_t i) const { return part_of(all_close_pairs, i); }

  std::vector<TrianglePair> all_triangle_pairs;  ///< with PairQuery::kTrianglePairs
  std::vector<ClosePair> all_close_pairs;        ///< with PairQuery::kClosePairs
  std::vector<std::size_t> ends;                 ///< end of the pairs of `meeting[i]`; unused for verdicts

  FrameReport report;

 private:
  template <typename Pair>
  std::span<const Pair> part_of(const std::vector<Pair>& all, std::size_t i) const {
    if (all.empty()) return {};
    const std::size_t begin = i == 0 ? 0 : ends[i - 1];
    return std::span(all).subspan(begin, ends[i] - begin);
  }
};

/// The pose X_AB of object B in the frame of object A, as the pipeline computes it, for comparison to the bit.
Eigen::Isometry3d relative_pose(const WorldObject& object_A, const WorldObject& object_B);

}  // namespace glissade::collision
