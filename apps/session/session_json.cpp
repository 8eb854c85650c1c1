// The summary of a session as JSON.

#include <chrono>
#include <cstddef>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include <glissade/apps/durations.h>
#include <glissade/apps/run/session.h>
#include <glissade/apps/text.h>

namespace glissade::apps {

namespace {

nlohmann::json to_json(const PartSummary& part, double tick_s) {
  nlohmann::json states;
  for (std::size_t i = 0; i < part.state_ticks.size(); ++i)
    states[name_of_state(i)] = tick_s * static_cast<double>(part.state_ticks[i]);
  return {{"name", part.name},
          {"colliding_poses", part.colliding_poses},
          {"contact_fraction", part.contact_fraction},
          {"contacts_max", part.contacts_max},
          {"state_s", states},
          {"state_changes", part.state_changes}};
}

nlohmann::json to_json(const HandSummary& hand, double tick_s) {
  nlohmann::json limits;
  for (std::size_t i = 0; i < hand.limited_ticks.size(); ++i)
    limits[std::string(devices::kLimitReasons[i].name)] = tick_s * static_cast<double>(hand.limited_ticks[i]);
  return {{"device", hand.device},
          {"grasps", hand.grasps},
          {"holding_s", tick_s * static_cast<double>(hand.holding_ticks)},
          {"missed_grasp", hand.missed_grasp.empty() ? nlohmann::json() : nlohmann::json(hand.missed_grasp)},
          {"has_fingers", hand.has_fingers},
          {"colliding_postures", hand.colliding_postures},
          {"joint_torque_max_Nm", hand.joint_torque_max_Nm},
          {"force_max_N", hand.force_max_N},
          {"force_step_max_N", hand.force_step_max_N},
          {"limited_s", limits},
          {"lagging_s", tick_s * static_cast<double>(hand.lagging_ticks)},
          {"unsolved_s", tick_s * static_cast<double>(hand.unsolved_ticks)}};
}

nlohmann::json to_json(const LinkSummary& link) {
  return {{"states", link.states},
          {"states_lost", link.states_lost},
          {"states_refused", link.states_refused},
          {"commands", link.commands},
          {"commands_dropped", link.commands_dropped}};
}

nlohmann::json stages_json(const Session& session) {
  const auto stage = [&](const collision::StageReport& sum) {
    const auto each = [&](auto value) -> nlohmann::json {
      if (session.collision_frames == 0) return nullptr;
      return static_cast<double>(value) / static_cast<double>(session.collision_frames);
    };
    return nlohmann::json{{"in", each(sum.in)}, {"out", each(sum.out)}, {"us", each(in_microseconds(sum.time))}};
  };
  return {{"queue", stage(session.collision.queue)},
          {"neighbor_finding", stage(session.collision.neighbor_finding)},
          {"separating_planes", stage(session.collision.separating_planes)},
          {"exact", stage(session.collision.exact)},
          {"result", stage(session.collision.result)}};
}

/// Of a run in real time; null of another.
void add_real_time(const std::optional<RealTimeFigures>& real_time, nlohmann::json& json) {
  for (const char* name :
       {"tick_us_p50", "tick_us_p99", "lateness_us_p50", "lateness_us_p99", "lateness_us_max", "bare_lateness_us_p50",
        "bare_lateness_us_p99", "bare_lateness_us_max", "page_faults", "has_fifo_scheduling", "has_locked_memory",
        "simulation_us_p50", "simulation_us_p99", "contact_set_age_us_p50", "contact_set_age_us_p99"})
    json[name] = nullptr;
  if (!real_time) return;
  const RealTimeFigures& figures = *real_time;
  const haptics::HapticServerStatistics& server = figures.server;
  json["late_ticks"] = server.haptic.late_ticks;
  json["page_faults"] = server.page_faults;
  json["has_fifo_scheduling"] = server.scheduling.is_fifo;
  json["has_locked_memory"] = server.scheduling.has_locked_memory;
  json["tick_us_p50"] = in_microseconds(server.haptic.duration.quantile(0.5));
  json["tick_us_p99"] = in_microseconds(server.haptic.duration.quantile(0.99));
  for (const auto& [name, lateness] : {std::pair("lateness_us", &server.haptic.lateness),
                                       std::pair("bare_lateness_us", &figures.bare_timer.lateness)}) {
    json[std::string(name) + "_p50"] = in_microseconds(lateness->quantile(0.5));
    json[std::string(name) + "_p99"] = in_microseconds(lateness->quantile(0.99));
    json[std::string(name) + "_max"] = in_microseconds(lateness->max());
  }
  json["simulation_us_p50"] = in_microseconds(server.simulation.quantile(0.5));
  json["simulation_us_p99"] = in_microseconds(server.simulation.quantile(0.99));
  json["contact_set_age_us_p50"] = in_microseconds(server.contact_set_age.quantile(0.5));
  json["contact_set_age_us_p99"] = in_microseconds(server.contact_set_age.quantile(0.99));
}

}  // namespace

nlohmann::json to_json(const SessionSummary& summary, const Session& session) {
  const double tick_s = std::chrono::duration<double>(session.period).count();
  nlohmann::json parts = nlohmann::json::array();
  for (const PartSummary& part : summary.parts)
    parts.push_back(to_json(part, tick_s));
  nlohmann::json hands = nlohmann::json::array();
  for (std::size_t h = 0; h < summary.hands.size(); ++h) {
    hands.push_back(to_json(summary.hands[h], tick_s));
    hands.back()["link"] = h < session.links.size() ? to_json(session.links[h]) : nlohmann::json();
  }
  nlohmann::json json = {{"ticks", summary.ticks},
                         {"objects", session.objects},
                         {"calls", session.calls.calls},
                         {"calls_ended_early", session.calls.ended_early},
                         {"unsettled_friction", session.calls.unsettled_friction},
                         {"collision_frames", session.collision_frames},
                         {"collision_stages", stages_json(session)},
                         {"late_ticks", 0},
                         {"colliding_poses", summary.colliding_poses()},
                         {"parts", parts},
                         {"hands", hands},
                         {"checked_poses", summary.checked},
                         {"goal_reached", nullptr},
                         {"goal_distance_m", nullptr},
                         {"stops", nullptr},
                         {"hash", hexadecimal(summary.hash)}};
  if (session.stops.joints > 0)
    json["stops"] = {{"joints", session.stops.joints},
                     {"error_mean_deg", session.stops.mean_deg},
                     {"error_greatest_deg", session.stops.greatest_deg}};
  if (summary.goal_reached) {
    json["goal_reached"] = *summary.goal_reached;
    json["goal_distance_m"] = summary.goal_distance_m;
  }
  add_real_time(session.real_time, json);
  return json;
}

}  // namespace glissade::apps
