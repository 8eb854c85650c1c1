// A part from an STL file, a world of twenty objects, and a force-feedback device of one's own on the haptic server.

#include <exception>
#include <iomanip>
#include <iostream>

#include <glissade/collision/collision_pipeline.h>
#include <glissade/contact/sliding.h>
#include <glissade/contact/spring.h>
#include <glissade/contact/tracked_contacts.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/mesh_import.h>
#include <glissade/haptics/haptic_server.h>

using namespace glissade;

const auto at = [](double x, double y, double z) { return Eigen::Isometry3d(Eigen::Translation3d(x, y, z)); };

// A driver, called once a millisecond; it must not wait. This one moves the hand down by 4 mm.
class MyGlove final : public devices::GloveDevice {
 public:
  const devices::DeviceDescriptor& descriptor() const noexcept override { return descriptor_; }
  bool read(devices::GloveState& newest) noexcept override {
    const double depth = std::min(4e-3, 20e-6 * static_cast<double>(state_.sequence++));
    state_.X_WH = at(0.0, 0.0, 0.002 - depth);
    state_.time = realtime::SteadyClock().now();  // when the pose was measured
    newest = state_;
    return true;
  }
  void command(const devices::SafeCommand& safe) noexcept override {
    greatest_ = std::max(greatest_, safe.values().f_H_W.z());
  }
  double greatest() const { return greatest_; }  // once the server has stopped

 private:
  devices::DeviceDescriptor descriptor_{.name = "my glove",
                                        .max_force = 20.0,
                                        .max_torque = 2.0,
                                        .max_stiffness = 1000.0,
                                        .max_rotational_stiffness = 5.0,
                                        .damping = 5.0,               // of the device itself: the more, the
                                        .rotational_damping = 0.02};  // stiffer a link or a long part may be
  devices::GloveState state_;
  double greatest_ = 0.0;
};

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::cerr << "usage: own_device PART.stl, in millimetres\n";
    return 2;
  }
  const auto part_V = contact::load_part(argv[1], 1e-3);
  const auto block = std::make_shared<contact::ContactBody>(
      std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.1, 0.1, 0.02}, 300)));

  // Twenty objects: nineteen blocks side by side, their upper faces at z = 0, and the part 2 mm above the first.
  collision::World world(20);
  std::vector<contact::Obstacle> obstacles;
  for (int i = 0; i < 19; ++i) {
    obstacles.push_back({.body = block, .X_WO = at(0.11 * i, 0.0, -0.01), .name = "block " + std::to_string(i)});
    world.add({.tree = {block, &block->tree}, .X_WO = obstacles.back().X_WO});
  }
  world.add({.tree = {part_V, &part_V->tree}, .X_WO = at(0.0, 0.0, 0.002)});
  realtime::SteadyClock clock;
  collision::CollisionPipeline pipeline(world, clock, {.greatest_distance = 0.005});
  std::cout << pipeline.step(0.005).meeting.size() << " pair of objects is closer than 5 mm\n" << std::fixed;

  // Slide: the ghost goes 2 mm into the block and along it; the visible part stays on the surface.
  contact::Sliding sliding(obstacles, part_V, at(0.0, 0.0, 0.002));
  contact::ContactTracker tracker(sliding.margin());
  for (int ms = 1; ms <= 200; ++ms)
    sliding.advance(at(2e-5 * ms, 0.0, std::max(-0.002, 0.002 - 1e-4 * ms)));
  for (const contact::TrackedContact& contact : tracker.update(sliding.result()))
    std::cout << "contact " << contact.id << " with "
              << obstacles[static_cast<std::size_t>(contact.contact.obstacle)].name << ": " << std::setprecision(2)
              << contact.contact.force << " N\n";
  const contact::Wrench wrench = contact::spring_wrench(sliding.stiffness(), sliding.error());
  std::cout << "wrench on the hand: " << wrench.f.transpose() << " N, " << wrench.t.transpose() << " Nm\n";
  MyGlove glove;  // the same part on the device, in real time for two seconds
  contact::MultiPartSliding live(obstacles, {{.part_V = part_V, .X_WV_start = at(0.0, 0.0, 0.002)}},
                                 contact::real_time_rules());
  haptics::HapticServer server({{&glove}}, live, clock, [](const devices::HapticState&) {}, {.ticks = 2000});
  while (!server.is_done())
    clock.sleep_until(clock.now() + std::chrono::milliseconds(10));
  server.stop();
  std::cout << "my glove pushes back with up to " << glove.greatest() << " N\n";
} catch (const std::exception& error) {
  std::cerr << "own_device: " << error.what() << '\n';
  return 1;
}
