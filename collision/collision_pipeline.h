#pragma once

/// The collision pipeline (paper §2): finds the pairs of objects of a world that meet, frame by frame. The cost of a
/// frame grows with the number of near pairs that moved, not with the number of objects.
///
///   queue → interest matrix → neighbor finding → separating planes → DOP-trees
///
/// Use a `CollisionPipeline` to compute frames in a thread of your own, or a `CollisionThread` to compute them
/// concurrently.

#include <memory>

#include <glissade/collision/frame_result.h>
#include <glissade/collision/world.h>
#include <glissade/realtime/clock.h>

namespace glissade::collision {

/// Deterministic: the answers of a frame depend only on the objects, their poses, the enabled pairs and the distance of
/// the frame, not on the number of threads or on earlier frames. Not thread-safe, but other threads may edit the world
/// and move its objects at any time. If memory runs out in a frame that several threads share, the program ends.
class CollisionPipeline {
 public:
  /// Becomes the consumer of `world`, that is, the caller of `World::take_changes`. The world must have no other
  /// consumer. World and clock must outlive the pipeline. The clock serves measurement only. Throws
  /// std::invalid_argument if `options` has a `greatest_distance` that is negative or not finite, or a negative number
  /// of threads.
  CollisionPipeline(World& world, const realtime::Clock& clock, const PipelineOptions& options = {});
  ~CollisionPipeline();
  CollisionPipeline(const CollisionPipeline&) = delete;
  CollisionPipeline& operator=(const CollisionPipeline&) = delete;

  /// Computes a frame with the newest poses: finds all enabled pairs of objects that meet, that is, whose distance is
  /// at most `distance` (metres). With `distance` 0, objects meet if their surfaces touch or intersect. The answers are
  /// exact: they are the answers of the queries of `dop_query.h` at the pose X_AB given by `relative_pose`. An object
  /// may have a selection of its triangles (`ObjectDescription`). With PairQuery::kClosePairs, two objects that both
  /// have a selection meet only if two of their triangles, at least one of them selected, are within the distance. The
  /// other values of `PairQuery` (`frame_result.h`) ignore selections. The next call overwrites the result. Throws
  /// std::invalid_argument for a distance that is negative, not a number, or greater than
  /// `PipelineOptions::greatest_distance`. Cost: see `FrameReport`.
  const FrameResult& step(double distance = 0.0);

  /// The result of the last `step`. Before the first `step`, its frame number is 0.
  const FrameResult& result() const;

 private:
  class Frame;
  std::unique_ptr<Frame> frame_;
};

}  // namespace glissade::collision
