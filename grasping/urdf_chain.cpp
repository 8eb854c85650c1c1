#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <glissade/grasping/kinematic_chain.h>

#include "urdf/urdf_document.h"
#include "urdf/urdf_geometry.h"

namespace glissade::grasping {
namespace {

/// A joint's angle as a multiple of the angle of a joint that mimics no other.
struct Leader {
  const urdf::Joint* joint;
  double factor;
  double offset;
};

/// Walks over a robot from its root and collects links and flex values.
class ChainMaker {
 public:
  ChainMaker(const urdf::ModelInterface& model, std::filesystem::path file) : model_(model), file_(std::move(file)) {}

  UrdfChain make() {
    const urdf::Link& root = *model_.getRoot();
    links_.push_back({.name = root.name, .mesh = collision_mesh(root, file_, warnings_)});
    add_children(root, 0);
    add_terms();
    return {KinematicChain(std::move(values_), std::move(links_)), std::move(warnings_)};
  }

 private:
  void require(bool holds, const urdf::Joint& joint, const std::string& what) const {
    if (!holds) throw std::invalid_argument(file_.string() + ": joint '" + joint.name + "' " + what + ".");
  }

  void add_children(const urdf::Link& parent, std::size_t number) {
    for (std::size_t i = 0; i < parent.child_links.size(); ++i) {
      const urdf::Joint& joint = *parent.child_joints[i];
      const urdf::Link& child = *parent.child_links[i];
      check_type(joint);
      const Eigen::Isometry3d X_PJ = to_pose(joint.parent_to_joint_origin_transform);
      require(X_PJ.matrix().allFinite(), joint, "has an origin that is not finite");
      links_.push_back(
          {.name = child.name, .parent = number, .X_PJ = X_PJ, .mesh = collision_mesh(child, file_, warnings_)});
      joints_.push_back(&joint);
      if (turns(joint)) {
        links_.back().axis_J = axis_of(joint);
        if (!joint.mimic) add_value(joint);
      }
      add_children(child, links_.size() - 1);
    }
  }

  static bool turns(const urdf::Joint& joint) {
    return joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS;
  }

  void check_type(const urdf::Joint& joint) const {
    require(joint.type != urdf::Joint::PRISMATIC, joint, "is prismatic; joints must turn or be fixed");
    require(joint.type != urdf::Joint::FLOATING, joint, "is floating; joints must turn or be fixed");
    require(joint.type != urdf::Joint::PLANAR, joint, "is planar; joints must turn or be fixed");
    require(turns(joint) || joint.type == urdf::Joint::FIXED, joint, "is of an unknown type");
  }

  Eigen::Vector3d axis_of(const urdf::Joint& joint) const {
    const Eigen::Vector3d axis = to_vector(joint.axis);
    require(axis.allFinite() && axis.norm() > 1e-6, joint, "has an axis without a direction");
    return axis.normalized();
  }

  void add_value(const urdf::Joint& joint) {
    double lower = -std::numbers::pi;
    double upper = std::numbers::pi;
    if (joint.type == urdf::Joint::REVOLUTE) {
      require(joint.limits != nullptr, joint, "is revolute and has no limits");
      lower = joint.limits->lower;
      upper = joint.limits->upper;
    }
    require(std::isfinite(lower) && std::isfinite(upper), joint, "has limits that are not finite");
    require(lower <= upper, joint, "has a lower limit above the upper one");
    numbers_[joint.name] = values_.size();
    values_.push_back({joint.name, lower, upper});
  }

  /// Follows the mimics of a joint to their end.
  Leader leader_of(const urdf::Joint& first) const {
    Leader leader{&first, 1.0, 0.0};
    for (std::size_t steps = 0; leader.joint->mimic; ++steps) {
      require(steps <= joints_.size(), first, "mimics in a circle");
      const urdf::JointMimic& mimic = *leader.joint->mimic;
      require(std::isfinite(mimic.multiplier) && std::isfinite(mimic.offset), *leader.joint,
              "has a mimic with numbers that are not finite");
      leader.offset += leader.factor * mimic.offset;
      leader.factor *= mimic.multiplier;
      const auto next = model_.joints_.find(mimic.joint_name);
      require(next != model_.joints_.end(), *leader.joint, "mimics '" + mimic.joint_name + "', which does not exist");
      leader.joint = next->second.get();
      require(turns(*leader.joint), first, "mimics '" + leader.joint->name + "', which does not turn");
    }
    return leader;
  }

  void add_terms() {
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      if (!turns(*joints_[i])) continue;
      const Leader leader = leader_of(*joints_[i]);
      links_[i + 1].offset = leader.offset;
      links_[i + 1].terms = {{numbers_.at(leader.joint->name), leader.factor}};
    }
  }

  const urdf::ModelInterface& model_;
  std::filesystem::path file_;
  std::vector<ChainLink> links_;
  std::vector<const urdf::Joint*> joints_;  ///< of all links but the root
  std::vector<FlexValue> values_;
  std::map<std::string, std::size_t> numbers_;  ///< of flex values
  std::vector<std::string> warnings_;           ///< of mesh files
};

}  // namespace

UrdfChain read_urdf(const std::filesystem::path& path) {
  const urdf::ModelInterfaceSharedPtr model = read_urdf_document(path);
  try {
    return ChainMaker(*model, path).make();
  } catch (const std::filesystem::filesystem_error& error) {
    throw std::invalid_argument(path.string() + ": " + error.code().message() + ".");
  }
}

}  // namespace glissade::grasping
