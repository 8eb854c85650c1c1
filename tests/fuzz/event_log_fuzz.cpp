// Event logs, read and repeated. Whatever they hold, what was recorded is repeated to the bit, or a sentence says why
// it is not.

#include <chrono>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <glissade/base/byte_order.h>
#include <glissade/contact/spring.h>
#include <glissade/devices/event_log.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/haptics/offline_run.h>
#include <glissade/haptics/recording.h>

#include "fuzz_target.h"
#include "held_part.h"
#include "poses.h"
#include "record/message_bytes.h"
#include "temporary_folder.h"

namespace glissade::fuzz {
namespace {

using haptics::kTickPeriod;
using std::chrono::milliseconds;
using test_support::at;

constexpr std::size_t kHeaderBytes = 28;

devices::SimulatedGlove hand() {
  return devices::SimulatedGlove(
      geometry::PoseTrajectory({{milliseconds(0), at(0.0, 0.0, 0.0)}, {milliseconds(8), at(0.012, 0.0, 0.0)}}));
}

grasping::GraspSimulation parts() {
  return {{test_support::wall(0.03)},
          {{.part_V = test_support::cube(0.04), .stiffness = contact::CouplingStiffness{1000.0, 1.0}}}};
}

haptics::RecordingHead head() {
  return {.gloves = {{.device = 1, .session = 1, .descriptor = hand().descriptor()}},
          .events = {devices::to_event(milliseconds(0), "HEAD", {1, 2, 3})}};
}

std::string log_path() {
  static const test_support::TemporaryFolder folder;
  return folder.path("input.lcmlog");
}

std::string recorded(std::int64_t ticks) {
  haptics::LogRecorder recorder(log_path(), head());
  devices::SimulatedGlove glove = hand();
  grasping::GraspSimulation sliding = parts();
  haptics::run_offline({{&glove}}, sliding, ticks, [](const devices::HapticState&) {},
                       {.before_tick =
                            [](std::int64_t tick, haptics::HoldRequests& requests) {
                              if (tick == 3) requests.release(0);
                              if (tick == 4) requests.grasp(0, 0);
                            },
                        .observer = &recorder});
  recorder.close();
  std::ifstream file(log_path(), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

bool is_known(const devices::LogEvent& event) {
  return haptics::consumed_by_tick(event) || devices::glove_info_of(event) || devices::glove_state_of(event) ||
         devices::haptic_state_of(event);
}

bool try_log(devices::EventLogReader& log) {
  grasping::GraspSimulation sliding = parts();
  haptics::Replay replay(sliding, {{.device = hand().descriptor(), .part = 0}}, kTickPeriod, head());
  bool goes_on = true;
  while (const std::optional<devices::LogEvent> event = log.next()) {
    is_known(*event);
    goes_on = goes_on && replay.take(*event);
    require(goes_on == replay.difference().empty(), "a difference without a sentence");
  }
  return log.damage().empty() && replay.finish();
}

}  // namespace

bool try_input(std::string_view bytes) {
  std::ofstream(log_path(), std::ios::binary) << bytes;
  try {
    devices::EventLogReader log(log_path());
    return try_log(log);
  } catch (const std::invalid_argument&) {
    return false;  // no event log at all
  }
}

std::vector<Seed> seeds() {
  return {{"run", recorded(8)}, {"tick", recorded(1)}};
}

std::vector<std::string> dictionary() {
  return {std::string("\xED\xA1\xDA\x01", 4),
          "HAPTIC_TICK",
          "CONTACT_SET",
          "GLOVE_STATE",
          "HAPTIC_STATE",
          "GLOVE_INFO",
          std::string("\x7f\xf8\0\0\0\0\0\0", 8),  // NaN
          std::string("\x7f\xff\xff\xff\xff\xff\xff\xff", 8)};
}

// The checksums of messages that have one.
void repair(std::string& bytes) {
  for (std::size_t at = 0; at + kHeaderBytes <= bytes.size();) {
    const auto channel = base::number_at<std::uint32_t>(bytes, at + 20, std::endian::big);
    const auto message = base::number_at<std::uint32_t>(bytes, at + 24, std::endian::big);
    const std::size_t begin = at + kHeaderBytes + channel;
    if (begin + message > bytes.size()) return;
    const std::string name = bytes.substr(at + kHeaderBytes, channel);
    if ((name == "HAPTIC_TICK" || name == "CONTACT_SET") && message > haptics::kTypeBytes + haptics::kChecksumBytes) {
      const std::span<const std::uint8_t> whole(reinterpret_cast<const std::uint8_t*>(bytes.data()) + begin, message);
      std::string checksum;
      base::append_number(checksum, haptics::fnv_1a(haptics::checked_part(whole)), std::endian::big);
      bytes.replace(begin + message - haptics::kChecksumBytes, haptics::kChecksumBytes, checksum);
    }
    at = begin + message;
  }
}

}  // namespace glissade::fuzz
