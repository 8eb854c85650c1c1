#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_topology.h>
#include <glissade/grasping/kinematic_chain.h>

#include "enclosed_volume.h"
#include "expect_bad_input.h"
#include "random_chain.h"
#include "temporary_folder.h"

namespace glissade::grasping {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using test_support::expect_bad_input;
using test_support::poses_of;
using test_support::TemporaryFolder;

const std::string kTetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

/// A finger of a gripper that turns with `close`, 120 degrees apart from the last one; its tip turns half as much.
std::string finger(int number, const std::string& mimic) {
  const std::string n = std::to_string(number);
  return "<link name='inner_" + n +
         "'><collision><origin xyz='0 0 0.02'/><geometry><box size='0.01 0.01 0.04'/></geometry>"
         "</collision></link>"
         "<link name='tip_" +
         n +
         "'><collision><geometry><sphere radius='0.01'/></geometry></collision></link>"
         "<joint name='finger_" +
         n + "' type='revolute'><parent link='hand'/><child link='inner_" + n +
         "'/>"
         "<origin rpy='0 0 " +
         std::to_string(number * 2.0 * pi / 3.0) +
         "' xyz='0 0 0.1'/><axis xyz='0 2 0'/>"
         "<limit lower='-0.1' upper='1.2' effort='1' velocity='1'/>" +
         mimic +
         "</joint>"
         "<joint name='tip_joint_" +
         n + "' type='revolute'><parent link='inner_" + n + "'/><child link='tip_" + n +
         "'/>"
         "<origin xyz='0 0 0.04'/><axis xyz='0 1 0'/><limit lower='0' upper='1' effort='1' velocity='1'/>"
         "<mimic joint='finger_" +
         n + "' multiplier='0.5' offset='0.2'/></joint>";
}

/// Fingers 1 and 2 mimic finger 0; so the tips mimic mimics.
std::string gripper() {
  return "<robot name='gripper'><link name='hand'><collision><origin xyz='0 0 0.05'/><geometry>"
         "<cylinder radius='0.03' length='0.1'/></geometry></collision></link>" +
         finger(0, "") + finger(1, "<mimic joint='finger_0'/>") +
         finger(2, "<mimic joint='finger_0' multiplier='1' offset='0.1'/>") + "</robot>";
}

std::size_t number_of(const KinematicChain& chain, const std::string& link) {
  const auto at = std::ranges::find(chain.links(), link, &ChainLink::name);
  EXPECT_NE(at, chain.links().end()) << link;
  return static_cast<std::size_t>(at - chain.links().begin());
}

TEST(UrdfChain, MimicJointsFollowOneFlexValue) {
  const TemporaryFolder folder;
  const KinematicChain chain = read_urdf(folder.write("gripper.urdf", gripper())).chain;
  ASSERT_EQ(chain.values().size(), 1U);
  EXPECT_EQ(chain.values()[0].name, "finger_0");
  EXPECT_EQ(chain.values()[0].lower, -0.1);
  EXPECT_EQ(chain.values()[0].upper, 1.2);
  ASSERT_EQ(chain.links().size(), 7U);
  EXPECT_EQ(chain.links()[0].name, "hand");

  const double bend = 0.6;
  const std::vector<Eigen::Isometry3d> X_RL = poses_of(chain, {bend});
  const auto tip = [&](const char* name) { return X_RL[number_of(chain, name)]; };
  // The inner segment leans outwards by `bend`, finger 2 by 0.1 more; the tip by half of it and 0.2 in addition.
  EXPECT_TRUE(
      tip("tip_0").translation().isApprox(Vector3d(0.04 * std::sin(bend), 0.0, 0.1 + 0.04 * std::cos(bend)), 1e-12));
  EXPECT_NEAR(tip("tip_0").linear().col(2).z(), std::cos(1.5 * bend + 0.2), 1e-12);
  EXPECT_NEAR(tip("tip_1").linear().col(2).z(), std::cos(1.5 * bend + 0.2), 1e-12);
  EXPECT_NEAR(tip("tip_2").linear().col(2).z(), std::cos(1.5 * (bend + 0.1) + 0.2), 1e-12);
  EXPECT_NEAR(std::atan2(tip("tip_1").translation().y(), tip("tip_1").translation().x()), 2.0 * pi / 3.0, 1e-6);
}

TEST(UrdfChain, HasClosedMeshesOfItsPrimitives) {
  const TemporaryFolder folder;
  const KinematicChain chain = read_urdf(folder.write("gripper.urdf", gripper())).chain;
  const auto volume = [&](const char* link) {
    const geometry::TriangleMesh& mesh = *chain.links()[number_of(chain, link)].mesh;
    EXPECT_TRUE(geometry::report(mesh).is_watertight) << link;
    return test_support::enclosed_volume(mesh);
  };
  EXPECT_NEAR(volume("inner_0"), 0.01 * 0.01 * 0.04, 1e-15);
  EXPECT_NEAR(volume("hand"), pi * 0.03 * 0.03 * 0.1, 0.02 * volume("hand"));
  EXPECT_NEAR(volume("tip_0"), 4.0 / 3.0 * pi * 1e-6, 0.1 * volume("tip_0"));
  for (const Vector3d& p : chain.links()[0].mesh->vertices)
    EXPECT_LE(std::abs(p.z() - 0.05), 0.05 + 1e-15) << "placed by its origin";
}

std::string robot(const std::string& inside) {
  return "<robot name='r'>" + inside + "</robot>";
}

std::string with_mesh(const std::string& file, const std::string& scale = "1 1 1") {
  return robot("<link name='a'><collision><geometry><mesh filename='" + file + "' scale='" + scale +
               "'/></geometry></collision></link>");
}

TEST(UrdfChain, FindsMeshesBesideItselfAndInPackages) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path("arm_description/urdf"));
  std::filesystem::create_directories(folder.path("arm_description/meshes"));
  std::filesystem::create_directories(folder.path("hand_description"));
  folder.write("arm_description/meshes/arm.obj", kTetrahedron);
  folder.write("hand_description/hand.obj", kTetrahedron);
  const std::string absolute = folder.path("hand_description/hand.obj");
  for (const std::string& name :
       {std::string("../meshes/arm.obj"), std::string("package://arm_description/meshes/arm.obj"),
        std::string("package://hand_description/hand.obj"), absolute, "file://" + absolute}) {
    const KinematicChain chain = read_urdf(folder.write("arm_description/urdf/arm.urdf", with_mesh(name))).chain;
    EXPECT_EQ(chain.links()[0].mesh->triangles.size(), 4U) << name;
  }
}

TEST(UrdfChain, ScalesMeshesAndKeepsThemFacingOutward) {
  const TemporaryFolder folder;
  folder.write("t.obj", kTetrahedron);
  for (const char* scale : {"0.1 0.2 0.3", "0.1 -0.2 0.3"}) {
    const KinematicChain chain = read_urdf(folder.write("a.urdf", with_mesh("t.obj", scale))).chain;
    EXPECT_NEAR(test_support::enclosed_volume(*chain.links()[0].mesh), 0.006 / 6.0, 1e-9) << scale;
  }
}

TEST(UrdfChain, PassesOnTheWarningsOfItsMeshFilesOnce) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("t.obj", std::string(kTetrahedron) + "f 1 2\n");
  const std::string twice = "<collision><geometry><mesh filename='t.obj'/></geometry></collision>";
  const UrdfChain read = read_urdf(folder.write("a.urdf", robot("<link name='a'>" + twice + twice + "</link>")));
  EXPECT_EQ(read.chain.links()[0].mesh->triangles.size(), 8U);
  ASSERT_EQ(read.warnings.size(), 1U);
  EXPECT_EQ(read.warnings[0].find(mesh + ": 1 face has fewer than 3 corners and is left out (line "), 0U);
  folder.write("t.obj", kTetrahedron);
  EXPECT_TRUE(read_urdf(folder.path("a.urdf")).warnings.empty());
}

std::string joint(const std::string& type, const std::string& inside, const std::string& name = "j") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='a'/><child link='b'/>" + inside + "</joint>";
}

const std::string kTwoLinks = "<link name='a'/><link name='b'/>";
const std::string kLimit = "<limit lower='0' upper='1' effort='1' velocity='1'/>";

TEST(UrdfChain, TurnsContinuousJointsByHalfATurnEachWayAndFixedOnesNotAtAll) {
  const TemporaryFolder folder;
  const KinematicChain wheel = read_urdf(folder.write("w.urdf", robot(kTwoLinks + joint("continuous", "")))).chain;
  ASSERT_EQ(wheel.values().size(), 1U);
  EXPECT_DOUBLE_EQ(wheel.values()[0].lower, -pi);
  EXPECT_DOUBLE_EQ(wheel.values()[0].upper, pi);
  const KinematicChain plate =
      read_urdf(folder.write("f.urdf", robot(kTwoLinks + joint("fixed", "<origin xyz='1 2 3'/>")))).chain;
  EXPECT_TRUE(plate.values().empty());
  EXPECT_TRUE(poses_of(plate, {})[1].translation().isApprox(Vector3d(1.0, 2.0, 3.0), 0.0));
  EXPECT_EQ(plate.links()[1].mesh, nullptr);
}

class BadUrdf : public testing::Test {
 protected:
  void expect_error(const std::string& text, std::vector<std::string> parts) const {
    parts.emplace_back("bad.urdf");
    expect_bad_input([&] { read_urdf(folder.write("bad.urdf", text)); }, parts);
  }
  TemporaryFolder folder;
};

TEST_F(BadUrdf, NamesJointsThatDoNotTurn) {
  for (const char* type : {"prismatic", "floating", "planar"})
    expect_error(robot(kTwoLinks + joint(type, kLimit)), {"joint 'j'", type});
  expect_error(robot(kTwoLinks + joint("wobbly", kLimit)), {"wobbly"});
}

TEST_F(BadUrdf, NamesBadLimitsAndAxes) {
  expect_error(robot(kTwoLinks + joint("revolute", "")), {"limit"});
  expect_error(robot(kTwoLinks + joint("revolute", "<limit lower='1' upper='0' effort='1' velocity='1'/>")),
               {"joint 'j'", "lower limit above"});
  expect_error(robot(kTwoLinks + joint("revolute", "<limit lower='nan' upper='0' effort='1' velocity='1'/>")),
               {"joint [j]", "nan"});
  expect_error(robot(kTwoLinks + joint("revolute", "<limit lower='x' upper='0' effort='1' velocity='1'/>")),
               {"joint [j]", "(x)"});
  expect_error(robot(kTwoLinks + joint("revolute", "<axis xyz='0 0 0'/>" + kLimit)), {"joint 'j'", "axis"});
}

TEST_F(BadUrdf, NamesBadMimics) {
  expect_error(robot(kTwoLinks + joint("revolute", kLimit + "<mimic joint='k'/>")), {"joint 'j'", "'k'", "not exist"});
  expect_error(robot(kTwoLinks + joint("revolute", kLimit + "<mimic joint='j'/>")), {"joint 'j'", "circle"});
  expect_error(robot(kTwoLinks + "<link name='c'/>" + joint("revolute", kLimit + "<mimic joint='f'/>") +
                     "<joint name='f' type='fixed'><parent link='a'/><child link='c'/></joint>"),
               {"joint 'j'", "'f'", "does not turn"});
}

TEST_F(BadUrdf, NamesLinksThatFormNoTree) {
  expect_error(robot(kTwoLinks), {"root"});
  expect_error(robot(kTwoLinks + "<joint name='j' type='fixed'/>"), {"[j]", "missing a parent"});
  expect_error(robot(kTwoLinks + joint("fixed", "", "j") + joint("fixed", "", "k")), {"link 'b'", "several joints"});
  const std::string loop =
      "<link name='c'/><link name='d'/>"
      "<joint name='cd' type='fixed'><parent link='c'/><child link='d'/></joint>"
      "<joint name='dc' type='fixed'><parent link='d'/><child link='c'/></joint>";
  expect_error(robot(loop), {"link 'c'", "loop"});
  expect_error(robot(kTwoLinks + joint("fixed", "") + loop), {"link 'c'", "loop"});
}

TEST_F(BadUrdf, NamesMeshesThatAreMissingOrBroken) {
  folder.write("broken.obj", "v 0 0\n");
  expect_error(with_mesh("missing.obj"), {"link 'a'", "missing.obj"});
  expect_error(with_mesh("broken.obj"), {"link 'a'", "broken.obj"});
  expect_error(with_mesh("package://nowhere/m.obj"), {"link 'a'", "package 'nowhere'"});
  expect_error(with_mesh("package://nowhere"), {"link 'a'", "package://nowhere"});
  folder.write("t.obj", kTetrahedron);
  expect_error(with_mesh("t.obj", "0 1 1"), {"link 'a'", "scale"});
  const auto shape = [](const std::string& geometry) {
    return robot("<link name='a'><collision><geometry>" + geometry + "</geometry></collision></link>");
  };
  expect_error(shape("<box size='1 0 1'/>"), {"link 'a'", "size"});
  expect_error(shape("<sphere radius='-1'/>"), {"link 'a'", "radius"});
  expect_error(shape("<cylinder radius='1' length='0'/>"), {"link 'a'", "cylinder"});
}

TEST_F(BadUrdf, NamesFilesThatAreNoUrdf) {
  expect_error("", {"no valid URDF"});
  expect_error("<robot name='r'><link", {"no valid URDF"});
  expect_error("<html/>", {"no valid URDF"});
  expect_bad_input([&] { read_urdf(folder.path("none.urdf")); }, {"none.urdf: there is no such file"});
  expect_bad_input([&] { read_urdf(folder.path("")); }, {"no such file"});
}

}  // namespace
}  // namespace glissade::grasping
