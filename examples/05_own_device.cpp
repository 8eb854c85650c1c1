// A force-feedback device of one's own presses a box on a plate, in real time for two seconds.
#include <iostream>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/haptics/haptic_server.h>
#include <glissade/simulation/simulation.h>

using namespace glissade;

// A driver, called once a millisecond; it must not wait. This one moves the hand down by 4 mm.
class MyGlove final : public devices::GloveDevice {
 public:
  const devices::DeviceDescriptor& descriptor() const noexcept override { return descriptor_; }
  bool read(devices::GloveState& newest) noexcept override {
    state_.X_WH.translation().z() = 0.002 - std::min(4e-3, 20e-6 * static_cast<double>(state_.sequence++));
    state_.time = realtime::SteadyClock().now();  // when the pose was measured
    newest = state_;
    return true;
  }
  void command(const devices::SafeCommand& safe) noexcept override {
    greatest_N_ = std::max(greatest_N_, safe.values().f_H_W.z());
  }
  double greatest_N() const { return greatest_N_; }  // once the server has stopped

 private:
  devices::DeviceDescriptor descriptor_{.name = "my glove",
                                        .max_force = 20.0,
                                        .max_torque = 2.0,
                                        .max_stiffness = 1000.0,
                                        .max_rotational_stiffness = 5.0,
                                        .damping = 5.0};
  devices::GloveState state_;
  double greatest_N_ = 0.0;
};

int main() {
  const Eigen::Isometry3d X_WBox(Eigen::Translation3d(0.0, 0.0, 0.022));  // 2 mm above the plate
  simulation::Simulation simulation({.objects = {{"plate", geometry::make_plate({0.4, 0.4}, 200)},
                                                 {"box", geometry::make_box({0.04, 0.04, 0.04}, 12), X_WBox, true}},
                                     .rules = contact::real_time_rules()});
  MyGlove glove;
  haptics::HapticServer server({{&glove}}, simulation);
  server.run_for(std::chrono::seconds(2));
  std::cout << "my glove pushes back with up to " << glove.greatest_N() << " N\n";
}
