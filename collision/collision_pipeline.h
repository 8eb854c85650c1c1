#pragma once

/// The collision pipeline (paper §2): which objects of a world meet, frame by frame, at a cost that follows the pairs
/// that are near and moved, not the number of objects.
///
///   queue → interest matrix → neighbor finding → separating planes → DOP-trees
///
/// Take one of these to run it in a thread of your own, and a `CollisionThread` to have it run beside you.

#include <memory>

#include <glissade/collision/frame_result.h>
#include <glissade/collision/world.h>
#include <glissade/realtime/clock.h>

namespace glissade::collision {

/// Deterministic: the answers depend on the poses alone, not on threads or on what came before. Not thread-safe; the
/// world may be used by others all the time. Where memory runs out in a frame that several threads share, the program
/// ends.
class CollisionPipeline {
 public:
  /// Is the consumer of `world` from now on, and there must be no other. World and clock must outlive it; the clock
  /// only measures. Throws std::invalid_argument for a distance that is negative or not finite, and for less than 0
  /// threads.
  CollisionPipeline(World& world, const realtime::Clock& clock, const PipelineOptions& options = {});
  ~CollisionPipeline();
  CollisionPipeline(const CollisionPipeline&) = delete;
  CollisionPipeline& operator=(const CollisionPipeline&) = delete;

  /// Computes a frame with the newest poses: all pairs of objects of interest to each other that are not further apart
  /// than `distance` metres (0: that touch), exactly, by the queries of `dop_query.h` for the pose X_AB that
  /// `relative_pose` gives. Two objects that both have a selection (`ObjectDescription`) meet, where close pairs are
  /// asked for, if a pair with a selected triangle is that near; other queries know no selections. The result is
  /// overwritten by the next call. Throws std::invalid_argument for a distance that is negative, not a number or
  /// greater than that of the options. Cost: see `FrameReport`.
  const FrameResult& step(double distance = 0.0);

  const FrameResult& result() const;

 private:
  class Frame;
  std::unique_ptr<Frame> frame_;
};

}  // namespace glissade::collision
