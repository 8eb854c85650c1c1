#pragma once

/// Result of one frame of the collision pipeline, with the work and duration of each stage.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glissade/base/export.h>
#include <glissade/collision/convex_hull.h>
#include <glissade/collision/query_types.h>
#include <glissade/collision/world.h>

namespace glissade::collision {

/// The details that a pipeline computes for pairs of objects that meet.
enum class PairQuery : std::uint8_t {
  kVerdict,        ///< only that two objects meet
  kTrianglePairs,  ///< also the triangle pairs within the distance given to the step
  /// Also the closest points of each triangle pair. If both objects have a selection (`ObjectDescription`), only
  /// selected triangle pairs count.
  kClosePairs,
};

struct PipelineOptions {
  PairQuery query = PairQuery::kVerdict;
  /// The test of convex hulls in the stage of separating planes. The choice affects only the duration of a frame, not
  /// the result.
  HullTest hull_test = HullTest::kExact;
  /// Upper limit (metres) of the distance given to `CollisionPipeline::step`.
  double greatest_distance = 0.0;
  /// Number of threads that work on a frame, including the calling thread. 0 means one thread for each processor.
  int threads = 0;
  /// The meter that receives the work of the exact queries; null: no meter. The meter must outlive the pipeline. A
  /// pipeline with several threads ignores the meter.
  WorkMeter* meter = nullptr;
};

/// Two objects of a world. In queries, the object with the lower index is A, and the other object is B.
struct ObjectPair {
  ObjectId object_A;
  ObjectId object_B;

  auto operator<=>(const ObjectPair&) const = default;
};

/// The number of items that entered a stage of the pipeline, the number of items that left the stage, and the duration
/// of the stage.
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

/// Work of one frame. Neighbors are objects whose fattened boxes overlap. A fattened box is an axis-aligned bounding
/// box, enlarged to leave the object some room to move. The stages process a pair only if it has just been enabled, or
/// if one of its objects is new or has moved. So objects at rest cost nothing. However, if the distance given to the
/// step has changed, the stages process all pairs of neighbors.
struct FrameReport {
  std::int64_t objects = 0;    ///< objects in the world
  std::int64_t neighbors = 0;  ///< pairs of neighbors, including pairs at rest
  /// In: objects that were added, moved or removed since the last frame. Out: objects that were added or moved.
  StageReport queue;
  /// In: objects that were added or moved. Out: enabled pairs of neighbors with at least one of these objects.
  StageReport neighbor_finding;
  /// In: pairs whose objects may have approached by more than the gap found in an earlier frame. Out: pairs for which
  /// no separating plane was found. Pairs that met in the last frame count as Out without a test.
  StageReport separating_planes;
  /// In: the pairs that left the stage of separating planes. Out: the pairs that meet.
  StageReport exact;
  /// In: pairs that have begun or ceased to meet. Out: all pairs that meet, including pairs at rest.
  StageReport result;
  std::chrono::nanoseconds total{0};

  /// Adds the work of another frame. For mean values, divide the sums by the number of frames.
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

/// The pairs of objects that meet in one frame, with the detail that the `PairQuery` of the pipeline requires.
struct FrameResult {
  std::uint64_t frame = 0;                    ///< number of the frame, from 1; 0: no frame yet
  std::chrono::nanoseconds time_of_poses{0};  ///< time at which the poses were taken, on the pipeline's clock

  /// Age of the poses at the time `now` on the pipeline's clock.
  std::chrono::nanoseconds age(std::chrono::nanoseconds now) const { return now - time_of_poses; }

  std::vector<ObjectPair> meeting;  ///< in ascending order

  /// Triangle pairs of `meeting[i]`, in ascending order of the triangle indices. `triangle_pairs` is empty unless the
  /// `PairQuery` of the pipeline is kTrianglePairs. `close_pairs` is empty unless the `PairQuery` is kClosePairs.
  std::span<const TrianglePair> triangle_pairs(std::size_t i) const { return part_of(all_triangle_pairs, i); }
  std::span<const ClosePair> close_pairs(std::size_t i) const { return part_of(all_close_pairs, i); }

  std::vector<TrianglePair> all_triangle_pairs;  ///< with PairQuery::kTrianglePairs
  std::vector<ClosePair> all_close_pairs;        ///< with PairQuery::kClosePairs
  /// The triangle pairs of `meeting[i]` are the entries `ends[i - 1]` (0 for i = 0) to `ends[i]` − 1 of
  /// `all_triangle_pairs` or `all_close_pairs`, depending on the `PairQuery`. `ends` is empty with PairQuery::kVerdict.
  std::vector<std::size_t> ends;

  FrameReport report;

 private:
  template <typename Pair>
  std::span<const Pair> part_of(const std::vector<Pair>& all, std::size_t i) const {
    if (all.empty()) return {};
    const std::size_t begin = i == 0 ? 0 : ends[i - 1];
    return std::span(all).subspan(begin, ends[i] - begin);
  }
};

/// The pose X_AB of object B in the frame of object A. The pipeline calls this function too, so results can be compared
/// bit for bit.
GLISSADE_EXPORT Eigen::Isometry3d relative_pose(const WorldObject& object_A, const WorldObject& object_B);

}  // namespace glissade::collision
