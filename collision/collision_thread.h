#pragma once

/// The collision thread (paper §2.3): runs a pipeline frame after frame. Other threads move objects and read results
/// without ever waiting for the collision thread.

#include <chrono>
#include <memory>
#include <vector>

#include <glissade/collision/collision_pipeline.h>
#include <glissade/collision/frame_result.h>
#include <glissade/collision/world.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/periodic_thread.h>
#include <glissade/realtime/triple_buffer.h>

namespace glissade::collision {

struct CollisionThreadOptions {
  PipelineOptions pipeline;
  /// Two objects meet if their distance is at most this (metres), as in `CollisionPipeline::step`. At most
  /// `pipeline.greatest_distance`.
  double distance = 0.0;
  /// Time from the beginning of one frame (one `CollisionPipeline::step`) to the beginning of the next. If a frame
  /// takes longer than the period, the next frame begins at once, and missed frames are not made up for.
  std::chrono::nanoseconds period{std::chrono::milliseconds(1)};
  /// Number of readers, one for each thread that reads results. At least 1.
  int readers = 1;
};

/// Reads the frames of a `CollisionThread`. One thread at a time may use a reader. All functions are wait-free and
/// allocate nothing.
class FrameReader {
 public:
  /// Takes the newest frame. Returns whether this frame is newer than the frame taken before.
  bool update() noexcept { return frames_.update(); }

  /// The frame taken last. The frame number is 0 until a frame has been taken. The frame does not change until the next
  /// `update`.
  const FrameResult& frame() const noexcept { return frames_.value(); }

 private:
  friend class CollisionThread;
  realtime::TripleBuffer<FrameResult> frames_;
};

/// The thread runs from construction to `stop` or destruction. Thread-safety: one thread owns the object, each reader
/// serves one thread, and any thread may use the world.
class CollisionThread {
 public:
  /// World and clock must outlive the thread. No other pipeline may work on this world, but any thread may edit the
  /// world and move its objects. Throws std::invalid_argument for options out of range, and std::system_error if no
  /// thread can be started.
  CollisionThread(World& world, realtime::Clock& clock, const CollisionThreadOptions& options = {});
  CollisionThread(const CollisionThread&) = delete;
  CollisionThread& operator=(const CollisionThread&) = delete;
  ~CollisionThread() { stop(); }

  /// The reader with this number, from 0 to `CollisionThreadOptions::readers` − 1. Throws std::out_of_range for any
  /// other number.
  FrameReader& reader(int number = 0) { return *readers_.at(static_cast<std::size_t>(number)); }

  /// Ends the thread after the current frame, which is still published. Blocks until the thread has ended.
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
