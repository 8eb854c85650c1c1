#include "variant/variant.h"

#include <memory>
#include <stdexcept>

#include <glissade/files/pose_rules.h>
#include <glissade/files/text.h>
#include <glissade/geometry/triangle_mesh.h>

namespace glissade::study {
namespace {

/// The changes of a mesh by several parameters: the shape is made first, and scaled then.
struct MeshChange {
  std::map<std::string, double> shape_parameters{};
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
};

simulation::SceneMesh changed(const simulation::SceneMesh& mesh, const MeshChange& change) {
  simulation::SceneMesh result = mesh;
  if (!change.shape_parameters.empty()) {
    std::map<std::string, double> parameters = mesh.origin().parameters;
    for (const auto& [name, value] : change.shape_parameters)
      parameters[name] = value;
    result = simulation::SceneMesh::of_shape(mesh.origin().shape, parameters);
  }
  if (change.scale == Eigen::Vector3d::Ones()) return result;
  auto scaled = std::make_shared<geometry::TriangleMesh>(*result);
  for (Eigen::Vector3d& vertex : scaled->vertices)
    vertex = vertex.cwiseProduct(change.scale);
  return {std::shared_ptr<const geometry::TriangleMesh>(std::move(scaled))};
}

/// Collects what the parameters change, because several may change one object.
class VariantMaker {
 public:
  explicit VariantMaker(const Study& study) : study_(study) {
    variant_.scene = study.scene;
    variant_.metaphor = study.metaphor;
    variant_.stiffness_N_per_m = study.stiffness_N_per_m;
    variant_.rules = study.rules;
  }

  void apply(const Parameter& parameter, const Target& target, double value) {
    switch (target.kind) {
      case TargetKind::kPath:
        variant_.path[target.axis] += value;
        break;
      case TargetKind::kStart:
        variant_.start[target.axis] += value;
        break;
      case TargetKind::kEnd:
        variant_.end[target.axis] += value;
        break;
      case TargetKind::kGoal:
        goal_[target.axis] += value;
        break;
      case TargetKind::kPose:
        poses_.try_emplace(target.object, DisplacementValues::Zero()).first->second[target.axis] += value;
        break;
      case TargetKind::kScale:
        scale(target, value);
        break;
      case TargetKind::kShape:
        meshes_[target.object].shape_parameters[target.shape_parameter] = value;
        break;
      case TargetKind::kMesh:
        variant_.scene.objects[target.object].mesh = parameter.meshes[static_cast<std::size_t>(value)];
        break;
      case TargetKind::kCompliance:
        compliance_[target.axis] = value;
        break;
      case TargetKind::kFriction:
        variant_.rules.friction = {value, value};
        break;
      case TargetKind::kStiffness:
        variant_.stiffness_N_per_m = value;
        break;
      case TargetKind::kMetaphor:
        variant_.metaphor = metaphor_of(parameter, value);
        break;
      case TargetKind::kTrajectory:
        variant_.trajectory = static_cast<std::size_t>(value);
        break;
    }
  }

  Variant finish() {
    for (const auto& [number, change] : meshes_) {
      simulation::SceneObject& object = variant_.scene.objects[number];
      try {
        object.mesh = changed(object.mesh, change);
      } catch (const std::invalid_argument& error) {
        throw std::invalid_argument("object " + files::in_quotes(object.name) + ": " + error.what());
      }
    }
    for (const auto& [number, by] : poses_) {
      simulation::SceneObject& object = variant_.scene.objects[number];
      object.X_WB = displaced(object.X_WB, by, Eigen::Vector3d::Zero());
    }
    for (simulation::SceneObject& object : variant_.scene.objects) {
      if (object.name == study_.part) choose_compliance_point(object);
    }
    if (variant_.scene.X_WGoal)
      variant_.scene.X_WGoal = displaced(*variant_.scene.X_WGoal, goal_, Eigen::Vector3d::Zero());
    return std::move(variant_);
  }

 private:
  static contact::Metaphor metaphor_of(const Parameter& parameter, double value) {
    return *contact::metaphor_from_name(parameter.distribution.as_one_of()->names[static_cast<std::size_t>(value)]);
  }

  void scale(const Target& target, double value) {
    Eigen::Vector3d& scale = meshes_[target.object].scale;
    if (target.axis == Target::kAllAxes) {
      scale *= value;
    } else {
      scale[target.axis] *= value;
    }
  }

  void choose_compliance_point(simulation::SceneObject& part) const {
    if (compliance_.empty()) return;
    Eigen::Vector3d point = part.compliance_point_B.value_or(geometry::bounds_of(*part.mesh).center());
    for (const auto& [axis, value] : compliance_)
      point[axis] = value;
    part.compliance_point_B = point;
  }

  const Study& study_;
  Variant variant_{};
  DisplacementValues goal_ = DisplacementValues::Zero();
  std::map<std::size_t, DisplacementValues> poses_{};
  std::map<std::size_t, MeshChange> meshes_{};
  std::map<int, double> compliance_{};
};

}  // namespace

Eigen::Isometry3d displaced(const Eigen::Isometry3d& X_WB, const DisplacementValues& by, const Eigen::Vector3d& p_B) {
  if (by.isZero(0.0)) return X_WB;
  const Eigen::Vector3d p_W = X_WB * p_B + by.head<3>();
  Eigen::Isometry3d result = X_WB;
  result.linear() = files::rotation_of(by[3], by[4], by[5]).toRotationMatrix() * X_WB.linear();
  result.translation() = p_W - result.linear() * p_B;
  return result;
}

Variant variant_of(const Study& study, const std::vector<double>& values) {
  VariantMaker maker(study);
  for (std::size_t p = 0; p < study.parameters.size(); ++p) {
    for (const Target& target : study.parameters[p].targets)
      maker.apply(study.parameters[p], target, values[p]);
  }
  return maker.finish();
}

}  // namespace glissade::study
