/// Gloves of four presets, with their own rates, delays and losses, on one server.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/devices/glove_model.h>
#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/simulated_glove_service.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/haptics/haptic_server.h>

namespace glissade::haptics {
namespace {

using std::chrono::milliseconds;

/// A glove, and its two ends of the link.
struct GloveOnServer {
  GloveOnServer(const std::shared_ptr<devices::LcmBus>& bus, const devices::GloveModel& model, std::int64_t number)
      : server_end(bus, devices::descriptor_of(model), {.device = number}),
        glove(bus, devices::SimulatedGlove(geometry::PoseTrajectory({geometry::TimedPose{}}), {}, model), clock,
              {.device = number}) {}

  realtime::SteadyClock clock;
  devices::LcmGlove server_end;
  devices::SimulatedGloveService glove;
};

// What the links of the models lose is counted at both ends. Nothing else is lost but what is dropped, and counted.
TEST(FourGloves, LoseNoMessageButOnTheLinksOfTheirModels) {
  const auto bus = std::make_shared<devices::LcmBus>("memq://");
  std::vector<std::unique_ptr<GloveOnServer>> gloves;
  std::vector<HandInLoop<devices::GloveDevice>> hands;
  for (const char* preset : {"sense_glove_r1", "dynamixel", "opengloves", "brake"}) {
    devices::GloveModel model = devices::read_glove_model(preset);
    if (std::string(preset) == "brake") model.link.loss = 0.2;
    gloves.push_back(std::make_unique<GloveOnServer>(bus, model, std::ssize(gloves) + 1));
    hands.emplace_back(&gloves.back()->server_end, std::nullopt);
  }
  const auto box = std::make_shared<const geometry::TriangleMesh>(geometry::make_box({0.1, 0.1, 0.1}, 12));
  grasping::GraspSimulation simulation(
      {{std::make_shared<const contact::ContactBody>(box), Eigen::Isometry3d(Eigen::Translation3d(1.0, 0.0, 0.0))}},
      {{.part_V = std::make_shared<const contact::SlidingPart>(box)}},
      std::vector<std::shared_ptr<const grasping::HandModel>>{});
  HapticServer server(hands, simulation, {.sink = [](const devices::HapticState&) {}});
  const auto have_exchanged_enough = [&] {  // however slow the machine is
    return std::all_of(gloves.begin(), gloves.end(), [](const std::unique_ptr<GloveOnServer>& on_server) {
      return on_server->server_end.statistics().accepted > 60 && on_server->glove.link_statistics().accepted > 100;
    });
  };
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!have_exchanged_enough() && !server.has_failed() && std::chrono::steady_clock::now() < give_up)
    std::this_thread::sleep_for(milliseconds(10));
  EXPECT_TRUE(have_exchanged_enough());
  server.stop();
  for (const std::unique_ptr<GloveOnServer>& on_server : gloves) {
    on_server->glove.stop();
    const std::string name = on_server->server_end.descriptor().name;
    const devices::LinkStatistics states = on_server->server_end.statistics();
    const devices::LinkStatistics commands = on_server->glove.link_statistics();
    const devices::LinkLosses losses = on_server->glove.link_losses();
    EXPECT_EQ(states.rejected(), states.other_receiver) << name;
    // A busy machine may drop commands before they are sent. After many at once, the glove refuses the next few, and
    // their numbers are then missing too. What was lost before the first message is not noticed.
    EXPECT_LE(commands.lost, on_server->server_end.commands_dropped() + commands.out_of_sequence) << name;
    EXPECT_LE(states.lost, static_cast<std::uint64_t>(losses.states)) << name;
    if (name == "brake glove") EXPECT_GT(states.lost, 3U) << "a fifth of sixty a second";
  }
}

}  // namespace
}  // namespace glissade::haptics
