// URDF files. Whatever they hold, they give a chain that can be posed, or a sentence says why not.

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <glissade/grasping/kinematic_chain.h>

#include "fuzz_target.h"
#include "temporary_folder.h"

namespace glissade::fuzz {
namespace {

std::string urdf_path() {
  static const test_support::TemporaryFolder folder;
  return folder.path("input.urdf");
}

const std::string kArm =
    "<robot name='arm'><link name='a'><collision><geometry><box size='1 2 3'/></geometry></collision></link>"
    "<link name='b'><collision><origin xyz='0 0 1' rpy='0 1 0'/><geometry><sphere radius='0.1'/></geometry></collision>"
    "<collision><geometry><cylinder radius='1' length='2'/></geometry></collision></link><link name='c'/>"
    "<joint name='ab' type='revolute'><parent link='a'/><child link='b'/><origin xyz='1 2 3' rpy='0 0 1'/>"
    "<axis xyz='0 1 0'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint>"
    "<joint name='bc' type='continuous'><parent link='b'/><child link='c'/><mimic joint='ab' multiplier='2' "
    "offset='1'/>"
    "</joint></robot>";

}  // namespace

bool try_input(std::string_view bytes) {
  std::ofstream(urdf_path(), std::ios::binary) << bytes;
  try {
    const grasping::KinematicChain chain = grasping::read_urdf(urdf_path()).chain;
    std::vector<double> values(chain.values().size(), 0.0);
    chain.clamp(values);
    std::vector<Eigen::Isometry3d> X_RL(chain.links().size());
    chain.poses(Eigen::Isometry3d::Identity(), values, X_RL);
    for (const Eigen::Isometry3d& X : X_RL)
      if (!X.matrix().allFinite()) throw std::logic_error("a pose is not finite");
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

std::vector<Seed> seeds() {
  return {{"arm", kArm}, {"link", "<robot name='r'><link name='a'/></robot>"}};
}

std::vector<std::string> dictionary() {
  return {
      "<link name='",   "<joint name='", "type='fixed'",   "type='prismatic'", "type='revolute'",  "type='continuous'",
      "<mimic joint='", "<axis xyz='",   "<limit lower='", "<collision>",      "<mesh filename='", "package://",
      "scale='",        "nan",           "1e999",          "</joint>",         "</link>",          "<parent link='",
      "<child link='",  "<!--"};
}

// Nothing in a URDF file depends on the rest of it.
void repair(std::string&) {}

}  // namespace glissade::fuzz
