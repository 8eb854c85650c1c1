// The output of a session: text, JSON, and a page.

#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include <glissade/apps/html_report.h>
#include <glissade/apps/session.h>

namespace glissade::apps {

namespace {

template <typename... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 200> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

double microseconds(std::chrono::nanoseconds duration) {
  return 1e-3 * static_cast<double>(duration.count());
}

std::string hash_text(std::uint64_t hash) {
  return formatted("%016llx", static_cast<unsigned long long>(hash));
}

using Rows = std::vector<std::pair<std::string, std::string>>;

std::string p50_p99(const realtime::LatencyHistogram& histogram) {
  return formatted("%.1f / %.1f us", microseconds(histogram.quantile(0.5)), microseconds(histogram.quantile(0.99)));
}

void add_real_time_rows(const RealTimeFigures& figures, Rows& rows) {
  const realtime::PeriodicStatistics& loop = figures.server.haptic;
  rows.emplace_back("late ticks", formatted("%llu of %llu", static_cast<unsigned long long>(loop.late_ticks),
                                            static_cast<unsigned long long>(loop.ticks)));
  rows.emplace_back("tick time p50 / p99", p50_p99(loop.duration));
  rows.emplace_back("wake-up lateness p50 / p99", p50_p99(loop.lateness));
  rows.emplace_back("the same of a bare timer", p50_p99(figures.bare_timer.lateness));
  rows.emplace_back("simulation step p50 / p99", p50_p99(figures.server.simulation));
  rows.emplace_back("age of contacts p50 / p99", p50_p99(figures.server.contact_set_age));
  rows.emplace_back("scheduling", figures.server.has_fifo_scheduling ? "real-time (SCHED_FIFO)"
                                                                     : "ordinary (SCHED_FIFO was refused)");
}

std::string stage_text(const collision::StageReport& stage, std::int64_t frames) {
  const auto each = [&](auto sum) { return static_cast<double>(sum) / static_cast<double>(frames); };
  return formatted("%.1f in, %.1f out, %.1f us", each(stage.in), each(stage.out), each(microseconds(stage.time)));
}

// Cost of the searches for contacts, one frame of the collision pipeline each.
void add_collision_rows(const Session& session, Rows& rows) {
  const std::int64_t frames = session.collision_frames;
  const collision::FrameReport& sum = session.collision;
  rows.emplace_back("collision frames", formatted("%lld, %.1f us each", static_cast<long long>(frames),
                                                  microseconds(sum.total) / static_cast<double>(frames)));
  rows.emplace_back("  moved objects", stage_text(sum.queue, frames));
  rows.emplace_back("  neighboring pairs", stage_text(sum.neighbor_finding, frames));
  rows.emplace_back("  pairs at hull planes", stage_text(sum.separating_planes, frames));
  rows.emplace_back("  pairs at DOP-trees", stage_text(sum.exact, frames));
  rows.emplace_back("  pairs that met or parted", stage_text(sum.result, frames));
}

std::string name_of_state(std::size_t number) {
  return std::string(devices::name_of(devices::part_state_from_number(static_cast<std::int32_t>(number))));
}

std::string states_text(const SessionSummary& summary) {
  std::string text;
  for (std::size_t i = 0; i < summary.state_ticks.size(); ++i) {
    if (summary.state_ticks[i] == 0) continue;
    const double share = static_cast<double>(summary.state_ticks[i]) / static_cast<double>(summary.samples);
    text += formatted("%s %.1f %%, ", name_of_state(i).c_str(), 100.0 * share);
  }
  return text + formatted("%lld changes", static_cast<long long>(summary.state_changes));
}

double tick_seconds(const Session& session) {
  return std::chrono::duration<double>(session.period).count();
}

std::string limits_text(const SessionSummary& summary, double tick_s) {
  std::string text;
  for (std::size_t i = 0; i < summary.limited_ticks.size(); ++i) {
    if (summary.limited_ticks[i] == 0) continue;
    text += formatted("%s%s %.3f s", text.empty() ? "" : ", ", std::string(devices::kLimitReasons[i].name).c_str(),
                      tick_s * static_cast<double>(summary.limited_ticks[i]));
  }
  return text.empty() ? "none" : text;
}

Rows rows_of(const SessionSummary& summary, const Session& session) {
  Rows rows;
  rows.emplace_back("objects", std::to_string(session.objects));
  rows.emplace_back("ticks", std::to_string(summary.ticks));
  if (session.real_time) add_real_time_rows(*session.real_time, rows);
  rows.emplace_back("colliding poses",
                    formatted("%lld of %lld, by brute force", static_cast<long long>(summary.colliding_poses),
                              static_cast<long long>(summary.samples)));
  rows.emplace_back("time in contact",
                    formatted("%.1f %%, up to %d contacts", 100.0 * summary.contact_fraction, summary.contacts_max));
  rows.emplace_back("states of the part", states_text(summary));
  rows.emplace_back("greatest force", formatted("%.2f N", summary.force_max_N));
  rows.emplace_back("greatest step of it", formatted("%.2f N in a tick", summary.force_step_max_N));
  rows.emplace_back("time with reduced force", limits_text(summary, tick_seconds(session)));
  if (summary.seat_reached) {
    rows.emplace_back("seat reached", formatted("%s, %.3f mm from it", *summary.seat_reached ? "yes" : "no",
                                                1e3 * summary.seat_distance_m));
  }
  add_collision_rows(session, rows);
  rows.emplace_back("hash", hash_text(summary.hash));
  return rows;
}

PlotSeries series_of(const std::vector<devices::HapticState>& samples, const std::string& name,
                     double (*value)(const devices::HapticState&)) {
  PlotSeries series{name, {}, {}};
  const std::chrono::nanoseconds start = samples.empty() ? std::chrono::nanoseconds(0) : samples.front().time;
  for (const devices::HapticState& sample : samples) {
    series.x.push_back(std::chrono::duration<double>(sample.time - start).count());
    series.y.push_back(value(sample));
  }
  return series;
}

/// The share of each state in each stretch of the run: a state may last a millisecond, which is less than a pixel.
Plot plot_of_states(const std::vector<devices::HapticState>& samples) {
  constexpr std::size_t kMostStretches = 300;
  const std::size_t stretch = std::max<std::size_t>(1, (samples.size() + kMostStretches - 1) / kMostStretches);
  Plot plot{"States of the part", "time [s]", "share of the time [%]", {}};
  for (std::size_t state = 0; state < static_cast<std::size_t>(devices::kPartStates); ++state) {
    PlotSeries series{name_of_state(state), {}, {}};
    bool occurs = false;
    for (std::size_t first = 0; first < samples.size(); first += stretch) {
      const std::size_t end = std::min(first + stretch, samples.size());
      const auto count = std::count_if(samples.data() + first, samples.data() + end, [&](const auto& sample) {
        return static_cast<std::size_t>(sample.part_state) == state;
      });
      occurs = occurs || count > 0;
      const auto middle = (samples[first].time + samples[end - 1].time) / 2 - samples.front().time;
      series.x.push_back(std::chrono::duration<double>(middle).count());
      series.y.push_back(100.0 * static_cast<double>(count) / static_cast<double>(end - first));
    }
    if (occurs) plot.series.push_back(std::move(series));
  }
  return plot;
}

std::vector<Plot> plots_of(const std::vector<devices::HapticState>& samples) {
  using devices::HapticState;
  const auto line = [&](const char* name, double (*value)(const HapticState&)) {
    return series_of(samples, name, value);
  };
  return {
      {"Force on the hand",
       "time [s]",
       "force [N]",
       {line("magnitude", [](const HapticState& s) { return s.force_on_hand_W.norm(); }),
        line("x", [](const HapticState& s) { return s.force_on_hand_W.x(); }),
        line("y", [](const HapticState& s) { return s.force_on_hand_W.y(); }),
        line("z", [](const HapticState& s) { return s.force_on_hand_W.z(); })}},
      {"Lag of the visible part behind the ghost",
       "time [s]",
       "lag [mm]",
       {line("lag", [](const HapticState& s) { return 1e3 * (s.X_WG.translation() - s.X_WV.translation()).norm(); })}},
      {"Contacts that push",
       "time [s]",
       "contacts",
       {line("contacts", [](const HapticState& s) { return static_cast<double>(s.contact_count); })}},
      plot_of_states(samples),
      {"Age of the contact set", "time [s]", "age [ms]", {line("age", [](const HapticState& s) {
         return 1e-6 * static_cast<double>(s.contact_set_age.count());
       })}}};
}

}  // namespace

nlohmann::json to_json(const SessionSummary& summary, const Session& session) {
  const auto stage = [&](const collision::StageReport& sum) {
    const auto each = [&](auto value) {
      return static_cast<double>(value) / static_cast<double>(session.collision_frames);
    };
    return nlohmann::json{{"in", each(sum.in)}, {"out", each(sum.out)}, {"us", each(microseconds(sum.time))}};
  };
  const double tick_s = tick_seconds(session);
  nlohmann::json states;
  for (std::size_t i = 0; i < summary.state_ticks.size(); ++i)
    states[name_of_state(i)] = tick_s * static_cast<double>(summary.state_ticks[i]);
  nlohmann::json limits;
  for (std::size_t i = 0; i < summary.limited_ticks.size(); ++i)
    limits[std::string(devices::kLimitReasons[i].name)] = tick_s * static_cast<double>(summary.limited_ticks[i]);
  nlohmann::json json = {{"ticks", summary.ticks},
                         {"objects", session.objects},
                         {"collision_frames", session.collision_frames},
                         {"collision_stages",
                          {{"queue", stage(session.collision.queue)},
                           {"neighbor_finding", stage(session.collision.neighbor_finding)},
                           {"separating_planes", stage(session.collision.separating_planes)},
                           {"exact", stage(session.collision.exact)},
                           {"result", stage(session.collision.result)}}},
                         {"late_ticks", 0},
                         {"colliding_poses", summary.colliding_poses},
                         {"checked_poses", summary.samples},
                         {"contact_fraction", summary.contact_fraction},
                         {"contacts_max", summary.contacts_max},
                         {"state_s", states},
                         {"state_changes", summary.state_changes},
                         {"seat_reached", nullptr},
                         {"seat_distance_m", nullptr},
                         {"force_max_N", summary.force_max_N},
                         {"force_step_max_N", summary.force_step_max_N},
                         {"limited_s", limits},
                         {"lagging_s", tick_s * static_cast<double>(summary.lagging_ticks)},
                         {"unsolved_s", tick_s * static_cast<double>(summary.unsolved_ticks)},
                         {"tick_us_p50", nullptr},
                         {"tick_us_p99", nullptr},
                         {"lateness_us_p50", nullptr},
                         {"bare_lateness_us_p50", nullptr},
                         {"simulation_us_p50", nullptr},
                         {"simulation_us_p99", nullptr},
                         {"contact_set_age_us_p50", nullptr},
                         {"hash", hash_text(summary.hash)}};
  if (summary.seat_reached) {
    json["seat_reached"] = *summary.seat_reached;
    json["seat_distance_m"] = summary.seat_distance_m;
  }
  if (session.real_time) {
    const haptics::HapticServerStatistics& server = session.real_time->server;
    json["late_ticks"] = server.haptic.late_ticks;
    json["tick_us_p50"] = microseconds(server.haptic.duration.quantile(0.5));
    json["tick_us_p99"] = microseconds(server.haptic.duration.quantile(0.99));
    json["lateness_us_p50"] = microseconds(server.haptic.lateness.quantile(0.5));
    json["bare_lateness_us_p50"] = microseconds(session.real_time->bare_timer.lateness.quantile(0.5));
    json["simulation_us_p50"] = microseconds(server.simulation.quantile(0.5));
    json["simulation_us_p99"] = microseconds(server.simulation.quantile(0.99));
    json["contact_set_age_us_p50"] = microseconds(server.contact_set_age.quantile(0.5));
  }
  return json;
}

std::string to_text(const SessionSummary& summary, const Session& session) {
  std::string text;
  for (const auto& [name, value] : rows_of(summary, session))
    text += formatted("  %-28s %s\n", name.c_str(), value.c_str());
  return text;
}

std::string write_session_report(const SessionSummary& summary, const Session& session, const std::string& title,
                                 const std::string& folder) {
  return write_html_report({title, rows_of(summary, session), plots_of(session.samples)}, folder);
}

void conclude(const Session& session, const HapticScene& scene, const std::string& title, bool as_json,
              const std::string& report_folder) {
  const SessionSummary summary = summarize(session, scene);
  if (as_json) {
    std::cout << to_json(summary, session).dump(2) << '\n';
  } else {
    std::cout << title << '\n' << to_text(summary, session);
  }
  if (!report_folder.empty()) {
    const std::string page = write_session_report(summary, session, title, report_folder);
    if (!as_json) std::cout << "  report                       " << page << '\n';
  }
  std::cout.flush();
  if (summary.colliding_poses > 0) {
    throw std::runtime_error(std::to_string(summary.colliding_poses) + " visible poses collide");
  }
}

}  // namespace glissade::apps
