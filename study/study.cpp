#include <chrono>
#include <string_view>

#include <glissade/files/hash.h>
#include <glissade/study/study.h>

namespace glissade::study {
namespace {

void add(files::Hash& hash, std::string_view text) {
  hash.add(std::uint64_t{text.size()});
  for (const char c : text)
    hash.add(static_cast<std::uint64_t>(c));
}

void add(files::Hash& hash, const geometry::PoseTrajectory& trajectory) {
  hash.add(std::uint64_t{trajectory.rows().size()});
  for (const geometry::TimedPose& row : trajectory.rows()) {
    hash.add(static_cast<std::uint64_t>(row.time.count()));
    hash.add(row.X_WB);
  }
}

void add(files::Hash& hash, const Parameter& parameter) {
  add(hash, parameter.name);
  for (const Target& target : parameter.targets) {
    hash.add(static_cast<std::uint64_t>(target.kind));
    hash.add(std::uint64_t{target.object});
    hash.add(static_cast<std::uint64_t>(target.axis));
    add(hash, target.shape_parameter);
  }
  const OneOf* one_of = parameter.distribution.as_one_of();
  if (one_of == nullptr) return;
  for (const std::string& name : one_of->names)
    add(hash, name);
}

void add(files::Hash& hash, const Success& success) {
  for (const double limit :
       {success.distance_m, success.angle_deg, success.force_N, success.torque_Nm, success.clearance_m}) {
    hash.add(limit);
  }
}

void add_rules(files::Hash& hash, const Study& study) {
  hash.add(static_cast<std::uint64_t>(study.metaphor));
  hash.add(study.stiffness_N_per_m);
  hash.add(study.rules.friction.at_rest);
  hash.add(study.rules.friction.sliding);
  hash.add(std::uint64_t{study.rules.spiral_search});
  hash.add(static_cast<std::uint64_t>(study.rules.overlap));
}

void add(files::Hash& hash, const Strata& strata) {
  hash.add(strata.seed());
  for (const Stratum& stratum : strata.all()) {
    for (std::size_t p = 0; p < stratum.lower.size(); ++p) {
      hash.add(stratum.lower[p]);
      hash.add(stratum.upper[p]);
    }
    hash.add(static_cast<std::uint64_t>(stratum.slides));
  }
}

}  // namespace

std::uint64_t hash_of(const Study& study, std::span<const simulation::SceneBodies> bodies) {
  files::Hash hash;
  add(hash, GLISSADE_VERSION);
  for (const simulation::SceneBodies& of_scene : bodies) {
    hash.add(simulation::hash_of(of_scene));
    for (const std::string& name : of_scene.body_names)
      add(hash, name);
  }
  for (const simulation::SceneObject& object : study.scene.objects) {
    add(hash, object.mesh.origin().shape);
    for (const auto& [name, value] : object.mesh.origin().parameters) {
      add(hash, name);
      hash.add(value);
    }
  }
  if (study.scene.X_WGoal) hash.add(*study.scene.X_WGoal);
  add(hash, study.part);
  for (const geometry::PoseTrajectory& trajectory : study.trajectories_X_WG)
    add(hash, trajectory);
  for (const Parameter& parameter : study.parameters)
    add(hash, parameter);
  add(hash, study.success);
  add_rules(hash, study);
  for (const bool is_recorded : study.records)
    hash.add(std::uint64_t{is_recorded});
  if (study.strata != nullptr) add(hash, *study.strata);
  return hash.value();
}

}  // namespace glissade::study
