#include <stdexcept>
#include <string>

#include <glissade/collision/collision_pipeline.h>

namespace glissade::collision {
namespace {

const CollisionThreadOptions& checked(const CollisionThreadOptions& options) {
  if (!(options.distance >= 0.0 && options.distance <= options.pipeline.greatest_distance)) {
    throw std::invalid_argument("a collision thread cannot look for distances of " + std::to_string(options.distance) +
                                " m with a pipeline for 0 to " + std::to_string(options.pipeline.greatest_distance) +
                                " m");
  }
  if (options.readers < 1) {
    throw std::invalid_argument("a collision thread must have a reader, not " + std::to_string(options.readers));
  }
  return options;
}

}  // namespace

CollisionThread::CollisionThread(World& world, realtime::Clock& clock, const CollisionThreadOptions& options)
    : pipeline_(world, clock, checked(options).pipeline) {
  for (int i = 0; i < options.readers; ++i)
    readers_.push_back(std::make_unique<FrameReader>());
  thread_ = std::make_unique<realtime::PeriodicThread>(
      clock, realtime::PeriodicThreadOptions{.period = options.period, .name = "collision"},
      [this, distance = options.distance](const realtime::PeriodicTick&) {
        publish(pipeline_.step(distance));
        return true;
      });
}

void CollisionThread::publish(const FrameResult& frame) {
  for (const std::unique_ptr<FrameReader>& reader : readers_)
    reader->frames_.publish(frame);
}

}  // namespace glissade::collision
