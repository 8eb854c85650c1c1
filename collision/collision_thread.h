#pragma once

/// The collision thread (paper §2.3): a pipeline that computes frame after frame beside its users, who move objects and
/// read results without ever waiting for it.

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
  /// Metres, as in `CollisionPipeline::step`; no more than the pipeline's greatest distance.
  double distance = 0.0;
  /// From the beginning of a frame to that of the next. A frame that takes longer makes the next begin at the next
  /// multiple after its end.
  std::chrono::nanoseconds period{std::chrono::milliseconds(1)};
  /// Threads that read results.
  int readers = 1;
};

/// One end of the hand-over, for one thread at a time. All is wait-free and allocates nothing.
class FrameReader {
 public:
  /// Takes the newest frame. Returns whether there is one that was not taken before.
  bool update() noexcept { return frames_.update(); }

  /// The frame last taken, number 0 if none was. It stays as it is until the next `update`.
  const FrameResult& frame() const noexcept { return frames_.value(); }

 private:
  friend class CollisionThread;
  realtime::TripleBuffer<FrameResult> frames_;
};

/// Runs from its construction to `stop` or its destruction. Thread-safety: one thread owns the object; each reader is
/// for a thread of its own; the world is for all.
class CollisionThread {
 public:
  /// World and clock must outlive the thread, which is the one consumer of the world. Throws std::invalid_argument for
  /// options that make no sense, std::system_error when there is no thread to be had.
  CollisionThread(World& world, realtime::Clock& clock, const CollisionThreadOptions& options = {});
  CollisionThread(const CollisionThread&) = delete;
  CollisionThread& operator=(const CollisionThread&) = delete;
  ~CollisionThread() { stop(); }

  /// Number 0 to `readers` − 1 of the options.
  FrameReader& reader(int number = 0) { return *readers_.at(static_cast<std::size_t>(number)); }

  /// Waits for the frame that is under way, which is still published.
  void stop() { thread_->stop(); }

  /// The account of the frames, once `stop` has returned.
  const realtime::PeriodicStatistics& statistics() const { return thread_->statistics(); }

 private:
  void publish(const FrameResult& frame);

  CollisionPipeline pipeline_;
  std::vector<std::unique_ptr<FrameReader>> readers_;
  std::unique_ptr<realtime::PeriodicThread> thread_;
};

}  // namespace glissade::collision
