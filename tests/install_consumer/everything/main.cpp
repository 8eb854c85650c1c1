// Uses something of every installed component, and checks that it works there as it does in the tree.

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <memory>

#include <glissade/collision/dop_query.h>
#include <glissade/contact/sliding.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/grasping/kinematic_chain.h>
#include <glissade/realtime/triple_buffer.h>
#include <glissade/simulation/scene.h>

namespace {

using namespace glissade;

std::shared_ptr<const geometry::TriangleMesh> box(double edge) {
  return std::make_shared<geometry::TriangleMesh>(geometry::make_box({edge, edge, edge}, 300));
}

Eigen::Isometry3d at(double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, z));
}

void expect(bool truth, const char* what) {
  if (truth) return;
  std::cerr << "not so: " << what << '\n';
  std::exit(1);
}

}  // namespace

int main() {
  const auto table_W = std::make_shared<contact::ContactBody>(box(0.2));
  const auto cube_V = std::make_shared<contact::SlidingPart>(box(0.05));
  collision::QueryWorkspace workspace;
  expect(collision::intersects(table_W->tree, cube_V->tree, at(0.12), workspace), "overlapping boxes intersect");
  expect(!collision::intersects(table_W->tree, cube_V->tree, at(0.13), workspace), "boxes apart do not intersect");

  contact::Sliding sliding({{table_W}}, cube_V, at(0.13));
  for (int millisecond = 0; millisecond < 100; ++millisecond)
    sliding.advance(at(0.12));
  expect(sliding.result().state == contact::SlidingState::kResting, "the cube comes to rest on the table");
  expect(!collision::intersects(table_W->tree, cube_V->tree, sliding.result().X_WV, workspace), "it rests outside");

  simulation::Scene scene{.objects = {{.name = "cube", .mesh = box(0.05), .X_WB = at(0.13)}}};
  scene.objects.push_back({.name = "nut", .mesh = simulation::SceneMesh::of_shape("nut")});
  simulation::write_scene(scene, "scene.yaml");
  expect(simulation::read_scene("scene.yaml").find("cube").X_WB.isApprox(at(0.13), 0.0), "a scene comes back");

  devices::GloveCommand command;
  command.f_H_W = {0.0, 0.0, 1e6};
  devices::SafetyEnvelope envelope(devices::simulated_glove_descriptor());
  realtime::TripleBuffer<devices::SafeCommand> buffer;
  buffer.publish(envelope.limit(command, devices::GloveState{}, std::chrono::milliseconds(1)));
  expect(buffer.latest().reasons().force_limited, "a glove is not sent a million newtons");

  std::ofstream("wheel.urdf")
      << "<robot name='r'><link name='a'/><link name='b'/><joint name='wheel' type='continuous'>"
         "<parent link='a'/><child link='b'/></joint></robot>";
  const grasping::KinematicChain wheel = grasping::read_urdf("wheel.urdf").chain;
  expect(wheel.values().size() == 1, "a chain is read from a URDF file");
  expect(grasping::make_hand().chain.moves(0, 4), "the thumb rolls");
  std::cout << "The installed package works.\n";
}
