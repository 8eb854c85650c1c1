#include <filesystem>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include <glissade/apps/record/recorded_session.h>
#include <glissade/haptics/haptic_server.h>

namespace glissade::apps {

namespace {

constexpr int kVersion = 2;

nlohmann::json json_of(const std::optional<grasping::HandShape>& shape) {
  if (!shape) return nullptr;
  return {{"side", shape->side == hands::HandSide::kLeft ? "left" : "right"},
          {"length_m", shape->length_m},
          {"breadth_m", shape->breadth_m}};
}

grasping::HandShape shape_of(const nlohmann::json& fingers) {
  const std::string side = fingers.at("side");
  return {.length_m = fingers.at("length_m"),
          .breadth_m = fingers.at("breadth_m"),
          .side = side == "left" ? hands::HandSide::kLeft : hands::HandSide::kRight};
}

devices::LogEvent event_of(const RecordedSession& session) {
  nlohmann::json hands = nlohmann::json::array();
  for (const RecordedHand& hand : session.hands) {
    const nlohmann::json part = hand.part ? nlohmann::json(*hand.part) : nlohmann::json(nullptr);
    hands.push_back({{"device", hand.glove.device}, {"part", part}, {"fingers", json_of(hand.fingers)}});
  }
  const std::optional<std::int64_t>& budget = session.rules.work_budget;
  const std::optional<double>& stiffness = session.choice.stiffness_N_per_m;
  const nlohmann::json rules{{"max_cycles", session.rules.max_cycles},
                             {"contacts_ahead_ms", session.rules.contacts_ahead_ms},
                             {"affordable_pairs", session.rules.affordable_pairs},
                             {"work_budget", budget ? nlohmann::json(*budget) : nlohmann::json(nullptr)}};
  const nlohmann::json text{{"version", kVersion},
                            {"scene_file", session.scene_file},
                            {"scene_hash", hexadecimal(session.scene_hash)},
                            {"rules", rules},
                            {"metaphor", session.choice.metaphor},
                            {"stiffness_N_per_m", stiffness ? nlohmann::json(*stiffness) : nlohmann::json(nullptr)},
                            {"friction", session.choice.friction},
                            {"spiral_search", session.choice.spiral_search},
                            {"depenetrate", session.choice.depenetrate},
                            {"period_ns", session.period.count()},
                            {"hands", hands}};
  const std::string bytes = text.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return devices::to_event(std::chrono::nanoseconds(0), kHapticSessionChannel, {bytes.begin(), bytes.end()});
}

/// Throws what the JSON library and the standard library throw.
RecordedSession session_of(const devices::LogEvent& event) {
  const nlohmann::json text = nlohmann::json::parse(event.message.begin(), event.message.end());
  if (text.at("version") != kVersion) throw std::invalid_argument("another version");
  RecordedSession session;
  session.scene_file = text.at("scene_file");
  session.scene_hash = std::stoull(text.at("scene_hash").get<std::string>(), nullptr, 16);
  const nlohmann::json& rules = text.at("rules");
  session.rules.max_cycles = rules.at("max_cycles");
  session.rules.contacts_ahead_ms = rules.at("contacts_ahead_ms");
  session.rules.affordable_pairs = rules.at("affordable_pairs");
  if (!rules.at("work_budget").is_null()) session.rules.work_budget = rules.at("work_budget").get<std::int64_t>();
  session.choice.metaphor = text.at("metaphor");
  if (text.contains("stiffness_N_per_m") && !text.at("stiffness_N_per_m").is_null())  // older recordings have no choice
    session.choice.stiffness_N_per_m = text.at("stiffness_N_per_m").get<double>();
  session.choice.friction = text.at("friction").get<std::vector<double>>();
  session.choice.spiral_search = text.at("spiral_search");
  session.choice.depenetrate = text.at("depenetrate");
  session.period = std::chrono::nanoseconds(text.at("period_ns").get<std::int64_t>());
  haptics::validate_tick_period(session.period);
  if (text.at("hands").size() > hands::kMaxHands) throw std::invalid_argument("too many hands");
  for (const nlohmann::json& hand : text.at("hands")) {
    RecordedHand& recorded = session.hands.emplace_back();
    recorded.glove.device = hand.at("device");
    if (!hand.at("part").is_null()) recorded.part = hand.at("part").get<std::size_t>();
    if (!hand.at("fingers").is_null()) recorded.fingers = shape_of(hand.at("fingers"));
  }
  return session;
}

std::invalid_argument unreadable(const LogFile& log, const std::string& channel) {
  return std::invalid_argument(log.path() + ": the event on " + channel +
                               " cannot be read: its bytes were changed, or another version wrote it");
}

}  // namespace

std::string recorded_path(const std::string& scene_file) {
  return scene_file.empty() ? "" : std::filesystem::absolute(scene_file).lexically_normal().string();
}

haptics::RecordingHead head_of(const RecordedSession& session) {
  haptics::RecordingHead head;
  head.events.push_back(event_of(session));
  for (const RecordedHand& hand : session.hands) {
    head.gloves.push_back(hand.glove);
    head.events.push_back(devices::to_event(std::chrono::nanoseconds(0), hand.glove));
  }
  return head;
}

RecordedSession read_session(const devices::LogEvent& event, LogFile& log) {
  RecordedSession session;
  try {
    session = session_of(event);
  } catch (const std::exception&) {
    throw unreadable(log, kHapticSessionChannel);
  }
  for (RecordedHand& hand : session.hands) {
    const std::optional<devices::LogEvent> announcement = log.next();
    const std::optional<devices::GloveInfo> glove = announcement ? devices::glove_info_of(*announcement) : std::nullopt;
    if (!announcement && !log.damage().empty()) throw std::runtime_error(log.damage());
    if (announcement && !glove && announcement->channel == "GLOVE_INFO") throw unreadable(log, announcement->channel);
    if (!glove || glove->device != hand.glove.device) {
      throw std::invalid_argument(log.path() + ": the announcement of glove " + std::to_string(hand.glove.device) +
                                  " is missing at the beginning of the run");
    }
    hand.glove = *glove;
  }
  return session;
}

RecordedSession first_session(LogFile& log) {
  while (const std::optional<devices::LogEvent> event = log.next()) {
    if (event->channel == kHapticSessionChannel) return read_session(*event, log);
  }
  if (!log.damage().empty()) throw std::runtime_error(log.damage());
  throw std::invalid_argument(log.path() + ": has nothing on the channel " + kHapticSessionChannel +
                              ", so it cannot be repeated; 'glissade record' and 'glissade demo --record' write what "
                              "can");
}

}  // namespace glissade::apps
