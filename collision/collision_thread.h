#pragma once

/// The collision thread (paper §2.3): runs a pipeline frame after frame. Other threads move objects and read results
/// without ever waiting for it.

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
  /// Metres, as in `CollisionPipeline::step`; at most the greatest distance of the pipeline.
  double distance = 0.0;
  /// Time from the beginning of one frame to that of the next. After a frame that takes longer, the next one begins at
  /// the next multiple of the period.
  std::chrono::nanoseconds period{std::chrono::milliseconds(1)};
  /// Number of threads that read results.
  int readers = 1;
};

/// Reads the frames of a `CollisionThread`, for one thread at a time. All functions are wait-free and allocate nothing.
class FrameReader {
 public:
  /// Takes the newest frame. Returns whether it is newer than the last one taken.
  bool update() noexcept { return frames_.update(); }

  /// The frame taken last; its number is 0 if there is none. It does not change until the next `update`.
  const FrameResult& frame() const noexcept { return frames_.value(); }

 private:
  friend class CollisionThread;
  realtime::TripleBuffer<FrameResult> frames_;
};

/// Runs from construction to `stop` or destruction. Thread-safety: one thread owns the object, each reader serves one
/// thread, and any thread may use the world.
class CollisionThread {
 public:
  /// World and clock must outlive the thread, which is the only consumer of the world. Throws std::invalid_argument for
  /// options out of range, and std::system_error if no thread can be started.
  CollisionThread(World& world, realtime::Clock& clock, const CollisionThreadOptions& options = {});
  CollisionThread(const CollisionThread&) = delete;
  CollisionThread& operator=(const CollisionThread&) = delete;
  ~CollisionThread() { stop(); }

  /// The reader of that number, 0 to `readers` − 1 of the options. Throws std::out_of_range for any other.
  FrameReader& reader(int number = 0) { return *readers_.at(static_cast<std::size_t>(number)); }

  /// Ends the thread after the current frame, which is still published. Blocks until then.
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
