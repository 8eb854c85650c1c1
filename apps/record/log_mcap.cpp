#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include <glissade/apps/durations.h>
#include <glissade/apps/record/log_file.h>
#include <glissade/apps/record/log_mcap.h>
#include <glissade/apps/record/mcap_entities.h>
#include <glissade/apps/record/mcap_schemas.h>
#include <glissade/apps/record/mcap_values.h>
#include <glissade/apps/record/mcap_writer.h>
#include <glissade/apps/record/recorded_scene.h>
#include <glissade/apps/record/recorded_session.h>
#include <glissade/apps/run/force_reason.h>
#include <glissade/apps/text.h>
#include <glissade/apps/view/say_if_simplified.h>
#include <glissade/devices/event_log.h>
#include <glissade/files/file_checks.h>
#include <glissade/grasping/grasp_analysis.h>
#include <glissade/haptics/recording.h>
#include <glissade/viewer/view_scene.h>

namespace glissade::apps {

namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostLoggedTriangles = 100'000;
constexpr std::chrono::nanoseconds kContactsPeriod(16'666'667);  // no more than screens show

Json loop_message(const haptics::TickRecord& tick) {
  return {{"tick", tick.number},
          {"lateness_s", in_seconds(tick.time - tick.deadline)},
          {"duration_s", in_seconds(tick.duration)},
          {"contact_set", tick.set_sequence},
          {"requests", std::ssize(tick.requests.all())},
          {"stopped", tick.is_stopped}};
}

Json part_message(const devices::HapticState& state, const devices::HapticPartState& part) {
  const Eigen::Isometry3d X_VG = part.X_WV.inverse() * part.X_WG;
  return {{"tick", state.sequence},
          {"state", devices::name_of(part.state)},
          {"contacts", part.contact_count},
          {"position_m", vector_json(part.X_WV.translation())},
          {"ghost_position_m", vector_json(part.X_WG.translation())},
          {"lag_m", X_VG.translation().norm()},
          {"lag_rad", Eigen::AngleAxisd(X_VG.linear()).angle()},
          {"age_s", in_seconds(state.contact_set_age)}};
}

Json joints_of(const hands::JointValues& values, const std::string& ending) {
  Json joints = Json::object();
  for (std::size_t j = 0; j < values.size(); ++j)
    joints[std::string(hands::kJointNames[j]) + ending] = values[j];
  return joints;
}

Json hand_message(const devices::HapticState& state, std::size_t number) {
  const devices::HapticHandState& hand = state.hands[number];
  Json message{{"tick", state.sequence},
               {"part", hand.part},
               {"force_N", vector_json(hand.force_W)},
               {"torque_Nm", vector_json(hand.torque_V_W)},
               {"contact_share", hand.contact_share},
               {"state_age_s", in_seconds(hand.state_age)},
               {"command_age_s", in_seconds(hand.command_age)},
               {"energy_J", devices::energy_left(hand)},
               {"reason", to_text(recorded_reason(state, number))},
               {"activity", hands::name_of(hand.visible.activity)},
               {"grasp", hands::name_of(hand.visible.grasp)}};
  if (hand.visible.activity == hands::HandActivity::kNone) return message;
  message["grasp_reason"] = grasping::reason_of(grasping::grasp_of(hand.visible));
  message["angles_rad"] = joints_of(hand.visible.angles, "_rad");
  message["torques_Nm"] = joints_of(hand.joint_torques, "_Nm");
  return message;
}

/// Adds the poses of the segments of a hand that is present.
void add_segments(const hands::VisibleHand& visible, const grasping::KinematicChain& chain, std::size_t hand,
                  std::chrono::nanoseconds time, Json& transforms) {
  const std::span<const grasping::ChainLink> links = chain.links();
  std::vector<Eigen::Isometry3d> X_WL(links.size());
  chain.poses(visible.X_WH, visible.angles, X_WL);
  for (std::size_t l = 0; l < links.size(); ++l) {
    if (links[l].mesh) transforms.push_back(transform_json(time, segment_frame(hand, links[l].name), X_WL[l]));
  }
}

/// A file that begins with the first message.
class McapLog {
 public:
  explicit McapLog(std::string path) : path_(std::move(path)) {}

  /// What follows is of a run in this scene. Its clock may have begun anew.
  void begin_run(viewer::ViewScene scene) {
    scene_ = std::move(scene);
    hands_ = scene_->hands;
    X_WH_.fill(std::nullopt);
    if (newest_) earliest_ = *newest_ + std::chrono::seconds(1);
  }

  /// Returns false for an event that should be a message and cannot be read.
  bool add(const devices::LogEvent& event) {
    if (auto tick = haptics::consumed_by_tick(event)) {
      const std::chrono::nanoseconds time = shifted(tick->time);
      tick->deadline += time - tick->time;
      tick->time = time;
      add(*tick);
    } else if (auto state = devices::haptic_state_of(event)) {
      state->time = shifted(state->time);
      add(*state);
    } else {
      return event.channel != "HAPTIC_TICK" && event.channel != "HAPTIC_STATE";
    }
    return true;
  }

  std::vector<McapTopic> close() {
    std::vector<McapTopic> topics;
    if (!writer_) return topics;
    writer_->close();
    for (const auto& [topic, channel] : channels_)
      topics.push_back({topic, writer_->count(channel)});
    return topics;
  }

 private:
  std::chrono::nanoseconds shifted(std::chrono::nanoseconds time) {
    if (earliest_) shift_ = std::max(*earliest_ - time, std::chrono::nanoseconds(0));
    earliest_.reset();
    return time + shift_;
  }

  void write(const std::string& topic, Json (*schema)(), std::chrono::nanoseconds time, const Json& message) {
    if (!writer_) writer_.emplace(path_);
    const auto [channel, is_new] = channels_.try_emplace(topic, 0);
    if (is_new) channel->second = writer_->add_channel(topic, schema().at("title"), schema().dump());
    writer_->write(channel->second, time, message.dump(-1, ' ', false, Json::error_handler_t::replace));
    newest_ = std::max(newest_.value_or(time), time);
  }

  void add(const haptics::TickRecord& tick) {
    for (std::size_t h = 0; h < X_WH_.size(); ++h) {
      if (tick.has_state[h]) X_WH_[h] = tick.states[h].X_WH;
    }
    write("/loop", &loop_schema, tick.time, loop_message(tick));
  }

  void add(const devices::HapticState& state) {
    if (scene_) {
      say_if_simplified(*scene_, kMostLoggedTriangles, path_);
      write("/scene", &scene_update_schema, state.time, scene_update(*scene_, kMostLoggedTriangles, state.time));
      scene_.reset();
    }
    Json transforms = Json::array();
    for (std::size_t p = 0; p < static_cast<std::size_t>(state.part_count); ++p) {
      transforms.push_back(transform_json(state.time, numbered("part", p), state.parts[p].X_WV));
      transforms.push_back(transform_json(state.time, numbered("ghost", p), state.parts[p].X_WG));
      write(numbered("/part", p), &part_schema, state.time, part_message(state, state.parts[p]));
    }
    for (std::size_t h = 0; h < static_cast<std::size_t>(state.hand_count); ++h) {
      const hands::VisibleHand& visible = state.hands[h].visible;
      if (visible.activity != hands::HandActivity::kNone) X_WH_[h] = visible.X_WH;
      if (X_WH_[h]) transforms.push_back(transform_json(state.time, numbered("hand", h), *X_WH_[h]));
      if (h < hands_.size() && hands_[h].model && hands::is_present(visible.activity))
        add_segments(visible, hands_[h].model->chain, h, state.time, transforms);
      write(numbered("/hand", h), &hand_schema, state.time, hand_message(state, h));
    }
    write("/tf", &frame_transforms_schema, state.time, {{"transforms", std::move(transforms)}});
    add_contacts(state);
  }

  void add_contacts(const devices::HapticState& state) {
    // The clock of a run whose beginning is not in the log may have begun anew.
    if (contacts_time_ && std::chrono::abs(state.time - *contacts_time_) < kContactsPeriod) return;
    contacts_time_ = state.time;
    write("/contacts", &scene_update_schema, state.time, contacts_update(state, X_WH_));
  }

  std::string path_;
  std::optional<viewer::ViewScene> scene_;                 // until it is written
  std::vector<viewer::ViewHand> hands_;                    // of the run
  std::optional<std::chrono::nanoseconds> contacts_time_;  // of the last /contacts
  std::optional<std::chrono::nanoseconds> newest_;         // time of a message
  std::optional<std::chrono::nanoseconds> earliest_;       // of the run's first message, until it is there
  std::chrono::nanoseconds shift_{0};                      // from the clock of the run to that of the file
  std::optional<McapWriter> writer_;
  std::map<std::string, std::uint16_t> channels_;
  std::array<std::optional<Eigen::Isometry3d>, devices::kHapticHands> X_WH_{};  // of a hand without fingers: its glove
};

}  // namespace

std::vector<McapTopic> write_log_mcap(const std::string& log_path, const std::string& mcap_path,
                                      const std::string& scene_file, std::string& damage) {
  if (!scene_file.empty()) {
    LogFile with_a_run(log_path, "log");
    first_session(with_a_run);
  }
  LogFile log(log_path, "mcap");
  check_output(mcap_path);
  McapLog mcap(mcap_path);
  while (const std::optional<devices::LogEvent> event = log.next()) {
    if (event->channel == kHapticSessionChannel) {
      mcap.begin_run(recorded_view(log_path, read_session(*event, log), scene_file));
    } else if (!mcap.add(*event)) {
      log.note_unreadable(*event);
    }
  }
  damage = log.damage();
  return mcap.close();
}

}  // namespace glissade::apps
