#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <glissade/collision/collision_pipeline.h>

#include "pipeline/broad_phase.h"
#include "pipeline/exact_stage.h"
#include "pipeline/meeting_list.h"
#include "pipeline/neighbor_stage.h"
#include "pipeline/pair_table.h"
#include "pipeline/placed_objects.h"
#include "pipeline/plane_stage.h"
#include "pipeline/queue_stage.h"
#include "pipeline/thread_pool.h"

namespace glissade::collision {
namespace {

constexpr int kMostThreads = 1024;

const PipelineOptions& checked(const PipelineOptions& options) {
  if (!(options.greatest_distance >= 0.0 && std::isfinite(options.greatest_distance))) {
    throw std::invalid_argument("the greatest distance of a collision pipeline must be finite and not negative, not " +
                                std::to_string(options.greatest_distance) + " m");
  }
  if (options.threads < 0 || options.threads > kMostThreads) {
    throw std::invalid_argument("a collision pipeline cannot have " + std::to_string(options.threads) +
                                " threads, but 0 to 1024");
  }
  return options;
}

}  // namespace

// The data shared by the stages, and the stages in their order.
class CollisionPipeline::Frame {
 public:
  Frame(World& world, const realtime::Clock& clock, const PipelineOptions& options)
      : world_(world),
        clock_(clock),
        options_(checked(options)),
        pool_(options.threads),
        placed_(static_cast<std::size_t>(world.capacity())),
        broad_phase_(static_cast<std::size_t>(world.capacity()), certain_distance(options.greatest_distance)),
        queue_(world, placed_, broad_phase_),
        neighbors_(world, placed_, broad_phase_, pairs_, meetings_),
        planes_(world, placed_, options_, pairs_, pool_),
        exact_(world, options_, pairs_, meetings_, pool_) {}

  const FrameResult& step(double distance) {
    check_distance(distance);
    FrameReport& report = result_.report;
    report = {};
    ++result_.frame;
    result_.time_of_poses = clock_.now();
    lap_ = result_.time_of_poses;
    if (exact_.was_shared()) pool_.wake();

    queue_.take_changes(report.queue);
    end_stage(report.queue);
    neighbors_.find(queue_, result_.frame, distance, candidates_, report.neighbor_finding);
    end_stage(report.neighbor_finding);
    planes_.filter(candidates_, distance, near_, report.separating_planes);
    end_stage(report.separating_planes);
    exact_.query(near_, distance, report.exact);
    end_stage(report.exact);
    update_result();
    end_stage(report.result);
    report.neighbors = static_cast<std::int64_t>(pairs_.size());
    report.objects = queue_.objects();
    report.total = clock_.now() - result_.time_of_poses;
    return result_;
  }

  const FrameResult& result() const { return result_; }

 private:
  void check_distance(double distance) const {
    if (distance >= 0.0 && distance <= options_.greatest_distance) return;
    throw std::invalid_argument("the distance of a frame must be 0 to the greatest of the pipeline, " +
                                std::to_string(options_.greatest_distance) + " m, not " + std::to_string(distance));
  }

  void end_stage(StageReport& stage) {
    const std::chrono::nanoseconds now = clock_.now();
    stage.time = now - lap_;
    lap_ = now;
  }

  void update_result() {
    const bool has_changed = meetings_.update(world_, result_);
    const bool has_details = options_.query != PairQuery::kVerdict;
    if (has_details && (has_changed || !near_.empty())) meetings_.copy_details(pairs_, result_);
  }

  World& world_;
  const realtime::Clock& clock_;
  const PipelineOptions options_;
  ThreadPool pool_;

  PlacedObjects placed_;
  BroadPhase broad_phase_;
  PairTable pairs_;
  MeetingList meetings_;

  QueueStage queue_;
  NeighborStage neighbors_;
  PlaneStage planes_;
  ExactStage exact_;

  std::vector<PairTable::Number> candidates_;  ///< from neighbor finding to separating planes
  std::vector<PairTable::Number> near_;        ///< from there to the exact queries
  std::chrono::nanoseconds lap_{0};            ///< the end of the last stage
  FrameResult result_;
};

CollisionPipeline::CollisionPipeline(World& world, const realtime::Clock& clock, const PipelineOptions& options)
    : frame_(std::make_unique<Frame>(world, clock, options)) {}

CollisionPipeline::~CollisionPipeline() = default;

const FrameResult& CollisionPipeline::step(double distance) {
  return frame_->step(distance);
}

const FrameResult& CollisionPipeline::result() const {
  return frame_->result();
}

}  // namespace glissade::collision
