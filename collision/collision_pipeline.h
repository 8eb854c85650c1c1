#pragma once

/// The collision pipeline (paper §2). In each frame, the pipeline finds the pairs of objects of a world that meet. The
/// cost of a frame grows with the number of near pairs that contain a moved object, not with the number of all objects.
///
///   queue → interest matrix → neighbor finding → separating planes → DOP-trees
///
/// Use a `CollisionPipeline` to compute frames in your own thread. A `CollisionThread` (paper §2.3) computes frames
/// continually in a separate thread. Other threads move objects and read results without ever waiting for the
/// `CollisionThread`.

#include <chrono>
#include <memory>
#include <vector>

#include <glissade/base/export.h>
#include <glissade/collision/frame_result.h>
#include <glissade/collision/world.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/periodic_thread.h>
#include <glissade/realtime/triple_buffer.h>

namespace glissade::collision {

/// Deterministic: the pairs that a frame finds depend only on the objects, their poses, the enabled pairs and the
/// argument `distance` of `step`, not on the number of threads or on earlier frames. Not thread-safe, but other threads
/// may edit the world and move its objects at any time. If memory runs out in a frame that several threads share, the
/// program ends.
class GLISSADE_EXPORT CollisionPipeline {
 public:
  /// The pipeline becomes the only consumer of `world`: only the pipeline may call `World::take_changes`. World and
  /// clock must outlive the pipeline. The clock is used for measurements only. Throws std::invalid_argument if the
  /// `greatest_distance` of `options` is negative or not finite, or if the number of threads is not
  /// between 0 and 1024.
  CollisionPipeline(World& world, const realtime::Clock& clock, const PipelineOptions& options = {});
  ~CollisionPipeline();
  CollisionPipeline(const CollisionPipeline&) = delete;
  CollisionPipeline& operator=(const CollisionPipeline&) = delete;

  /// Computes a frame with the newest poses. Finds all enabled pairs of objects that meet. Two objects meet if their
  /// distance is at most `distance` (metres). With `distance` 0, objects meet if their surfaces touch or intersect. The
  /// result is exact: it equals the results of the exact queries of `dop_query.h` at the pose X_AB that `relative_pose`
  /// computes. With PairQuery::kClosePairs, two objects that both have a selection of triangles (see
  /// `ObjectDescription`) meet only if a selected pair of triangles is within `distance`. The other values of
  /// `PairQuery` ignore selections. The next call overwrites the result. Throws std::invalid_argument if `distance` is
  /// negative, not a number, or greater than `PipelineOptions::greatest_distance`. Cost: see `FrameReport`.
  const FrameResult& step(double distance = 0.0);

  /// The result of the last `step`. Before the first `step`, the frame number of the result is 0.
  const FrameResult& result() const;

 private:
  class Frame;
  std::unique_ptr<Frame> frame_;
};

struct CollisionThreadOptions {
  PipelineOptions pipeline;
  /// The argument `distance` (metres) of `CollisionPipeline::step`, at most `pipeline.greatest_distance`.
  double distance = 0.0;
  /// Time from the beginning of one frame (i.e. one call of `CollisionPipeline::step`) to the beginning of the next
  /// frame. If a frame takes longer than the period, the next frame begins at once. Missed frames are not computed
  /// later.
  std::chrono::nanoseconds period{std::chrono::milliseconds(1)};
  /// Number of readers, at least 1. Each thread that reads results needs its own reader.
  int readers = 1;
};

/// Reads the frames of a `CollisionThread`. Only one thread at a time may use a reader. All functions are wait-free and
/// allocate nothing.
class FrameReader {
 public:
  /// Takes the newest frame. Returns whether this frame is newer than the frame of the last `update`.
  bool update() noexcept { return frames_.update(); }

  /// The frame of the last `update`. The frame number is 0 until an `update` has taken a frame. The frame does not
  /// change until the next `update`.
  const FrameResult& frame() const noexcept { return frames_.value(); }

 private:
  friend class CollisionThread;
  realtime::TripleBuffer<FrameResult> frames_;
};

/// Computes frames from construction to `stop` or destruction. Thread-safety: one thread owns the object, only one
/// thread may use each reader, and any thread may use the world.
class GLISSADE_EXPORT CollisionThread {
 public:
  /// World and clock must outlive the thread. No other pipeline may use this world. Throws std::invalid_argument for
  /// options out of range. Throws std::system_error if no thread can be started.
  CollisionThread(World& world, realtime::Clock& clock, const CollisionThreadOptions& options = {});
  CollisionThread(const CollisionThread&) = delete;
  CollisionThread& operator=(const CollisionThread&) = delete;
  ~CollisionThread() { stop(); }

  /// The reader with this number, from 0 to `CollisionThreadOptions::readers` − 1. Throws std::out_of_range for other
  /// numbers.
  FrameReader& reader(int number = 0) { return *readers_.at(static_cast<std::size_t>(number)); }

  /// Completes and publishes the current frame, then ends the thread. Blocks until the thread has ended.
  void stop() { thread_->stop(); }

  /// Timing statistics of the frames, valid once `stop` has returned.
  const realtime::PeriodicStatistics& statistics() const { return thread_->statistics(); }

 private:
  void publish(const FrameResult& frame);

  CollisionPipeline pipeline_;
  std::vector<std::unique_ptr<FrameReader>> readers_;
  std::unique_ptr<realtime::PeriodicThread> thread_;
};

}  // namespace glissade::collision
