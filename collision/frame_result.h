#pragma once

/// What the collision pipeline finds out in one frame, and where the time went.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glissade/collision/convex_hull.h>
#include <glissade/collision/query_types.h>
#include <glissade/collision/world.h>

namespace glissade::collision {

/// What is to be known of objects that meet.
enum class PairQuery : std::uint8_t {
  kVerdict,        ///< that they do
  kTrianglePairs,  ///< and in which pairs of triangles
  kClosePairs,     ///< and where these are closest; of objects with selections, by selected triangles only
};

struct PipelineOptions {
  PairQuery query = PairQuery::kVerdict;
  HullTest hull_test = HullTest::kExact;
  /// Metres. Objects meet when they are not further apart than what `step` is told, which is no more than this.
  double greatest_distance = 0.0;
  /// That work on a frame, the caller's among them. 0: as many as the machine has.
  int threads = 0;
};

/// Two objects of a world, the one of lower index first: that is A of the query, the other B.
struct ObjectPair {
  ObjectId object_A;
  ObjectId object_B;

  auto operator<=>(const ObjectPair&) const = default;
};

/// How many pairs came to a stage of the pipeline and how many it passed on, and what that took.
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

/// The account of one frame. Objects that rest cost nothing, so the stages see only pairs with an object that moved.
struct FrameReport {
  std::int64_t objects = 0;       ///< in the world
  std::int64_t neighbors = 0;     ///< pairs of them whose fat boxes overlap, at rest or not
  StageReport queue;              ///< objects that somebody moved, added or removed; the objects that have a new pose
  StageReport neighbor_finding;   ///< those; pairs whose fat boxes overlap, and which are of interest
  StageReport separating_planes;  ///< those that may have come together since their gap was last known; not separated
  StageReport exact;              ///< those; pairs that meet
  StageReport result;             ///< pairs that have met or parted; all pairs that meet
  std::chrono::nanoseconds total{0};

  /// The account of both: divide by the number of frames for means.
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

/// One frame: which objects meet. What else there is depends on the pipeline's `PairQuery`.
struct FrameResult {
  std::uint64_t frame = 0;                    ///< number of the frame, from 1; 0: none yet
  std::chrono::nanoseconds time_of_poses{0};  ///< when the poses were taken, by the pipeline's clock

  /// How old the poses are at the time `now` of that clock. What the frame took is in the report.
  std::chrono::nanoseconds age(std::chrono::nanoseconds now) const { return now - time_of_poses; }

  std::vector<ObjectPair> meeting;  ///< ascending

  /// Of `meeting[i]`, in ascending order of triangles.
  std::span<const TrianglePair> triangle_pairs(std::size_t i) const { return part_of(all_triangle_pairs, i); }
  std::span<const ClosePair> close_pairs(std::size_t i) const { return part_of(all_close_pairs, i); }

  std::vector<TrianglePair> all_triangle_pairs;  ///< of PairQuery::kTrianglePairs
  std::vector<ClosePair> all_close_pairs;        ///< of PairQuery::kClosePairs
  std::vector<std::size_t> ends;  ///< where those of `meeting[i]` end, unless only verdicts are asked for

  FrameReport report;

 private:
  template <typename Pair>
  std::span<const Pair> part_of(const std::vector<Pair>& all, std::size_t i) const {
    if (all.empty()) return {};
    const std::size_t begin = i == 0 ? 0 : ends[i - 1];
    return std::span(all).subspan(begin, ends[i] - begin);
  }
};

/// The pose of B in the frame of A as the pipeline computes it, for who wants to compare bit for bit.
Eigen::Isometry3d relative_pose(const WorldObject& object_A, const WorldObject& object_B);

}  // namespace glissade::collision
