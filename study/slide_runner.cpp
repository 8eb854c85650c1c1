#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <glissade/study/slide_runner.h>

#include "variant/variant.h"

namespace glissade::study {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

/// The ghost of a slide over time.
class GhostPath {
 public:
  GhostPath(const geometry::PoseTrajectory& trajectory, const Variant& variant, const Eigen::Vector3d& p_Vref)
      : trajectory_(trajectory), variant_(variant), p_Vref_(p_Vref) {}

  /// At a time since the start.
  Eigen::Isometry3d X_WG(nanoseconds time) const {
    const double duration = std::chrono::duration<double>(trajectory_.duration()).count();
    const double share = duration > 0.0 ? std::chrono::duration<double>(time).count() / duration : 0.0;
    return displaced(trajectory_.pose_at(trajectory_.first_time() + time), variant_.of_path(share), p_Vref_);
  }
  std::int64_t ticks() const { return trajectory_.duration() / milliseconds(1); }

 private:
  const geometry::PoseTrajectory& trajectory_;
  const Variant& variant_;
  Eigen::Vector3d p_Vref_;
};

contact::Sliding start_sliding(const simulation::SceneBodies& bodies, const Variant& variant,
                               const Eigen::Isometry3d& X_WG_start, nanoseconds script_start) {
  const auto& part = bodies.parts.front().part_V;
  std::vector<contact::ScriptedPart> moving = bodies.moving;
  for (contact::ScriptedPart& scripted : moving)
    scripted.start = script_start;
  return {bodies.obstacles,
          part,
          X_WG_start,
          {.metaphor = variant.metaphor,
           .stiffness = contact::stiffness_of_part(part->radius(), variant.stiffness_N_per_m),
           .rules = variant.rules},
          moving};
}

std::vector<simulation::SceneBodies> known_bodies(const Study& study) {
  std::vector<simulation::SceneBodies> known{simulation::bodies_of(study.scene, {study.part})};
  for (const Parameter& parameter : study.parameters) {
    for (const simulation::SceneMesh& mesh : parameter.meshes) {
      simulation::Scene scene = study.scene;
      scene.objects[parameter.targets.front().object].mesh = mesh;
      known.push_back(simulation::bodies_of(scene, {study.part}, known));
    }
  }
  return known;
}

}  // namespace

SlideRunner::SlideRunner(const Study& study)
    : study_(study), sampler_(study), known_(known_bodies(study)), study_hash_(hash_of(study, known_)) {}

std::vector<double> SlideRunner::values(std::int64_t number) const {
  if (number >= 0 && number < study_.slides) return sampler_.values(number);
  throw std::out_of_range("slide " + std::to_string(number) + ": the study has " + std::to_string(study_.slides));
}

simulation::Scene SlideRunner::scene(std::int64_t number) const {
  return variant_of(study_, values(number)).scene;
}

SlideRow SlideRunner::run(std::int64_t number, const SlideWatch& watch) const {
  SlideRow row{.slide = number, .values = values(number)};
  row.input_hash = input_hash(study_hash_, row.values);
  try {
    row.measures = slide(row.values, watch);
    row.outcome = outcome_of(row.measures);
  } catch (const std::invalid_argument& error) {
    row.outcome = "problem";
    row.problem = error.what();
  }
  return row;
}

SlideRow SlideRunner::not_run(std::int64_t number, const std::string& problem) const {
  SlideRow row{.slide = number, .values = sampler_.values(number), .outcome = kNotRun, .problem = problem};
  row.input_hash = input_hash(study_hash_, row.values);
  return row;
}

SlideMeasures SlideRunner::slide(const std::vector<double>& values, const SlideWatch& watch) const {
  const Variant variant = variant_of(study_, values);
  const simulation::SceneBodies bodies = simulation::bodies_of(variant.scene, {study_.part}, known_);
  const geometry::PoseTrajectory& trajectory = study_.trajectories_X_WG[variant.trajectory];
  const GhostPath path(trajectory, variant, bodies.parts.front().part_V->p_Vref());
  contact::Sliding sliding = start_sliding(bodies, variant, path.X_WG(nanoseconds(0)), trajectory.first_time());
  const Eigen::Isometry3d X_WGoal = bodies.X_WGoal.value_or(trajectory.pose_at(trajectory.last_time()));
  SlideMeter meter(bodies, {X_WGoal, study_.success.distance_m, study_.success.angle_deg},
                   study_.has(Record::kClearance));
  for (std::int64_t tick = 0; tick <= path.ticks(); ++tick) {
    const nanoseconds time = tick * milliseconds(1);
    // The first tick is the start: no time has passed yet.
    const contact::SlidingResult& result = sliding.advance(path.X_WG(time), tick == 0 ? 0.0 : 1.0);
    meter.note(time, result, sliding.scripted_X_WB());
    if (watch) watch(time, sliding);
  }
  const SlideMeasures measures = meter.finish();
  if (!std::isfinite(measures.force_max_N + measures.torque_max_Nm + measures.work_J))
    throw std::invalid_argument("the forces exceed the range of numbers");
  return measures;
}

std::string SlideRunner::outcome_of(const SlideMeasures& measures) const {
  const Success& success = study_.success;
  if (!measures.goal_reached) {
    if (measures.jams()) return "jammed";
    return measures.p_Wpushed ? "still moving" : "goal missed";
  }
  if (measures.force_max_N > success.force_N) return "force exceeded";
  if (measures.torque_max_Nm > success.torque_Nm) return "torque exceeded";
  if (measures.clearance_min_m < success.clearance_m) return "too near";
  return "success";
}

}  // namespace glissade::study
