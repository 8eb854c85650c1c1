// The output of a session: text and a page.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include <glissade/apps/durations.h>
#include <glissade/apps/report/html_report.h>
#include <glissade/apps/run/session.h>
#include <glissade/apps/run/stop_signal.h>
#include <glissade/apps/say.h>
#include <glissade/apps/text.h>
#include <glissade/apps/view/clearance_curve.h>
#include <glissade/apps/view/part_curves.h>
#include <glissade/apps/view/session_view.h>

namespace glissade::apps {

namespace {

template <typename... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 200> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

using Rows = std::vector<std::pair<std::string, std::string>>;

std::string p50_p99_max(const realtime::LatencyHistogram& histogram) {
  return formatted("%.1f / %.1f / %.1f us", in_microseconds(histogram.quantile(0.5)),
                   in_microseconds(histogram.quantile(0.99)), in_microseconds(histogram.max()));
}

std::string p50_p99(const realtime::LatencyHistogram& histogram) {
  return formatted("%.1f / %.1f us", in_microseconds(histogram.quantile(0.5)),
                   in_microseconds(histogram.quantile(0.99)));
}

void add_real_time_rows(const RealTimeFigures& figures, Rows& rows) {
  const realtime::PeriodicStatistics& loop = figures.server.haptic;
  rows.emplace_back("late ticks", formatted("%llu of %llu", static_cast<unsigned long long>(loop.late_ticks),
                                            static_cast<unsigned long long>(loop.ticks)));
  rows.emplace_back("tick time p50 / p99", p50_p99(loop.duration));
  rows.emplace_back("lateness p50 / p99 / max", p50_p99_max(loop.lateness));
  rows.emplace_back("the same of a bare timer", p50_p99_max(figures.bare_timer.lateness));
  rows.emplace_back("simulation step p50 / p99", p50_p99(figures.server.simulation));
  rows.emplace_back("age of contacts p50 / p99", p50_p99(figures.server.contact_set_age));
  rows.emplace_back("page faults of haptic loop", std::to_string(figures.server.page_faults));
  rows.emplace_back("scheduling",
                    figures.server.scheduling.is_fifo ? "real-time (SCHED_FIFO)" : "ordinary (SCHED_FIFO was refused)");
  rows.emplace_back("memory", figures.server.scheduling.has_locked_memory ? "locked" : "not locked");
}

std::string stage_text(const collision::StageReport& stage, std::int64_t frames) {
  const auto each = [&](auto sum) { return static_cast<double>(sum) / static_cast<double>(frames); };
  return formatted("%.1f in, %.1f out, %.1f us", each(stage.in), each(stage.out), each(in_microseconds(stage.time)));
}

// Cost of the searches for contacts. The stages are those of the collision pipeline, which finds the bodies that are
// near.
void add_collision_rows(const Session& session, Rows& rows) {
  const std::int64_t frames = session.collision_frames;
  if (frames == 0) return;
  const collision::FrameReport& sum = session.collision;
  rows.emplace_back("collision frames", formatted("%lld, %.1f us each", static_cast<long long>(frames),
                                                  in_microseconds(sum.total) / static_cast<double>(frames)));
  rows.emplace_back("  moved objects", stage_text(sum.queue, frames));
  rows.emplace_back("  neighboring pairs", stage_text(sum.neighbor_finding, frames));
  rows.emplace_back("  pairs at hull planes", stage_text(sum.separating_planes, frames));
  rows.emplace_back("  pairs at DOP-trees", stage_text(sum.exact, frames));
  rows.emplace_back("  pairs that met or parted", stage_text(sum.result, frames));
}

std::string states_text(const PartSummary& part, std::int64_t samples) {
  std::string text;
  for (std::size_t i = 0; i < part.state_ticks.size(); ++i) {
    if (part.state_ticks[i] == 0) continue;
    const double share = static_cast<double>(part.state_ticks[i]) / static_cast<double>(samples);
    text += formatted("%s %.1f %%, ", name_of_state(i).c_str(), 100.0 * share);
  }
  return text + formatted("%lld changes", static_cast<long long>(part.state_changes));
}

double tick_seconds(const Session& session) {
  return std::chrono::duration<double>(session.period).count();
}

std::string limits_text(const HandSummary& hand, double tick_s) {
  std::string text;
  const auto add = [&](std::string_view reason, std::int64_t ticks) {
    if (ticks == 0) return;
    text += formatted("%s%s %.3f s", text.empty() ? "" : ", ", std::string(reason).c_str(),
                      tick_s * static_cast<double>(ticks));
  };
  for (std::size_t i = 0; i < hand.limited_ticks.size(); ++i)
    add(devices::kLimitReasons[i].name, hand.limited_ticks[i]);
  add("contacts below half of their force", hand.lagging_ticks);
  add("contacts without a solution", hand.unsolved_ticks);
  return text.empty() ? "none" : text;
}

std::string name_of_hand(const Session& session, std::size_t hand) {
  return "hand of glove " + std::to_string(session.devices[hand]);
}

void add_part_rows(const PartSummary& part, const SessionSummary& summary, Rows& rows) {
  rows.emplace_back("part " + part.name,
                    formatted("%lld of %lld poses collide, by brute force",
                              static_cast<long long>(part.colliding_poses), static_cast<long long>(summary.checked)));
  rows.emplace_back("  time in contact",
                    formatted("%.1f %%, up to %d contacts", 100.0 * part.contact_fraction, part.contacts_max));
  rows.emplace_back("  states", states_text(part, summary.samples));
}

void add_hand_rows(const HandSummary& hand, const std::string& name, const SessionSummary& summary, double tick_s,
                   Rows& rows) {
  rows.emplace_back(name, formatted("greatest force %.2f N, greatest step of it %.2f N in a tick", hand.force_max_N,
                                    hand.force_step_max_N));
  rows.emplace_back("  time with reduced force", limits_text(hand, tick_s));
  rows.emplace_back("  grasps", formatted("%lld, held for %.3f s", static_cast<long long>(hand.grasps),
                                          tick_s * static_cast<double>(hand.holding_ticks)));
  if (!hand.missed_grasp.empty()) rows.emplace_back("  why it held nothing", hand.missed_grasp);
  if (!hand.has_fingers) return;
  rows.emplace_back("  fingers", formatted("greatest torque %.2f Nm; %lld of %lld postures collide, by brute force",
                                           hand.joint_torque_max_Nm, static_cast<long long>(hand.colliding_postures),
                                           static_cast<long long>(summary.checked)));
}

std::string link_text(const LinkSummary& link) {
  const auto number = [](std::uint64_t count) { return std::to_string(count); };
  return number(link.states) + " states (" + number(link.states_lost) + " lost, " + number(link.states_refused) +
         " refused), " + number(link.commands) + " commands (" + number(link.commands_dropped) + " dropped)";
}

Rows rows_of(const SessionSummary& summary, const Session& session, bool verbose) {
  if (summary.samples == 0) return {{"ticks", "0: the run ended before the first state of a glove"}};
  Rows rows;
  if (summary.goal_reached) {
    rows.emplace_back("goal reached", formatted("%s, %.3f mm from it", *summary.goal_reached ? "yes" : "no",
                                                1e3 * summary.goal_distance_m));
  }
  for (const PartSummary& part : summary.parts)
    add_part_rows(part, summary, rows);
  for (std::size_t h = 0; h < summary.hands.size(); ++h) {
    add_hand_rows(summary.hands[h], name_of_hand(session, h), summary, tick_seconds(session), rows);
    if (h < session.links.size()) rows.emplace_back("  messages", link_text(session.links[h]));
  }
  if (session.stops.joints > 0) {
    rows.emplace_back("error of the stop of fingers",
                      formatted("%.2f deg in the mean of %lld joints, %.2f deg of one", session.stops.mean_deg,
                                static_cast<long long>(session.stops.joints), session.stops.greatest_deg));
  }
  rows.emplace_back("objects", std::to_string(session.objects));
  rows.emplace_back("ticks", std::to_string(summary.ticks));
  if (session.calls.ended_early > 0) {
    rows.emplace_back("calls ended early", formatted("%lld of %lld: their work was used up",
                                                     static_cast<long long>(session.calls.ended_early),
                                                     static_cast<long long>(session.calls.calls)));
  }
  if (session.calls.unsettled_friction > 0) {
    rows.emplace_back("friction not in balance", formatted("%lld steps: it was not solved in time",
                                                           static_cast<long long>(session.calls.unsettled_friction)));
  }
  if (session.real_time) add_real_time_rows(*session.real_time, rows);
  if (!verbose) return rows;
  add_collision_rows(session, rows);
  rows.emplace_back("hash", hexadecimal(summary.hash));
  return rows;
}

Rows rule_rows(const Session& session, const HapticScene& scene) {
  return {{"scene", scene.source}, {"metaphor", session.choice.metaphor}, {"rules", words_of(session.choice)}};
}

double seconds_of_tick(const SessionRecorder& samples, std::size_t i) {
  return std::chrono::duration<double>(samples.tick(i).time - samples.tick(0).time).count();
}

void add_plots(const SessionSummary& summary, const Session& session, Report& report) {
  const SessionRecorder& samples = *session.samples;
  for (std::size_t h = 0; h < samples.hands(); ++h) {
    const std::string of_hand = " on the " + name_of_hand(session, h);
    VectorPlot force("Force" + of_hand, "force [N]");
    VectorPlot torque("Torque" + of_hand, "torque [Nm]");
    for (std::size_t i = 0; i < samples.size(); ++i) {
      force.add(seconds_of_tick(samples, i), samples.hand(i, h).force_W);
      torque.add(seconds_of_tick(samples, i), samples.hand(i, h).torque_V_W);
    }
    report.plots.push_back(force.plot());
    report.plots.push_back(torque.plot());
  }
  std::vector<std::string> names;
  for (const PartSummary& part : summary.parts)
    names.push_back(part.name);
  PartCurves parts(names);
  GrowingCurve age("age");
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (std::size_t p = 0; p < samples.parts(); ++p)
      parts.add(seconds_of_tick(samples, i), p, samples.part(i, p));
    age.add(seconds_of_tick(samples, i), 1e-6 * static_cast<double>(samples.tick(i).contact_set_age.count()));
  }
  parts.finish(report);
  report.plots.push_back({"Age of the contact set", kTimeLabel, "age [ms]", {age.series()}});
}

/// The clearance of each part that hands can hold, by its poses.
void add_clearance(const HapticScene& scene, const SessionRecorder& samples, Report& report) {
  Plot plot = clearance_plot();
  for (std::size_t part = 0; part < scene.parts.size(); ++part) {
    ClearanceCurve curve(scene, static_cast<std::int64_t>(samples.size()), part);
    std::vector<Eigen::Isometry3d> others_X_WB;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      others_X_WB.clear();
      for (std::size_t p = 0; p < samples.parts(); ++p) {
        if (p != part) others_X_WB.push_back(samples.part(i, p).X_WV);
      }
      curve.note(samples.tick(i).time - samples.tick(0).time, samples.part(i, part).X_WV, others_X_WB);
    }
    plot.series.push_back(curve.take(scene.parts[part].name));
  }
  report.plots.push_back(std::move(plot));
}

}  // namespace

std::string to_text(const SessionSummary& summary, const Session& session, bool verbose) {
  std::string text;
  for (const auto& [name, value] : rows_of(summary, session, verbose))
    text += formatted("  %-28s %s\n", name.c_str(), value.c_str());
  return text;
}

std::string write_session_report(const SessionSummary& summary, const Session& session, const std::string& title,
                                 const std::string& folder, const HapticScene& scene) {
  Report report{title, rule_rows(session, scene), {}};
  for (auto& row : rows_of(summary, session, false))
    report.summary.push_back(std::move(row));
  const std::int64_t kept = static_cast<std::int64_t>(session.samples->size());
  if (session.samples->total() > kept) {
    const double tick_s = std::chrono::duration<double>(session.period).count();
    report.summary.emplace_back("shown below",
                                formatted("the last %.1f s of %.1f s", tick_s * static_cast<double>(kept),
                                          tick_s * static_cast<double>(session.samples->total())));
  }
  if (summary.samples > 0) {
    add_plots(summary, session, report);
    add_clearance(scene, *session.samples, report);
    report.replay = replay_of(session, scene);
  }
  return write_html_report(report, folder);
}

std::string real_time_warning(const Session& session) {
  if (!session.real_time) return "";
  constexpr double kOld_ms = 50.0;
  const contact::CallStatistics& calls = session.calls;
  const std::string friction =
      calls.unsettled_friction > 0
          ? formatted("; friction did not settle in %lld steps, which costs time: try a scene without it",
                      static_cast<long long>(calls.unsettled_friction))
          : "";
  if (2 * calls.ended_early > calls.calls) {
    return formatted(
               "the simulation did not keep up with real time: %lld of its %lld calls ended early, so the visible "
               "parts lagged behind the hands",
               static_cast<long long>(calls.ended_early), static_cast<long long>(calls.calls)) +
           friction;
  }
  const double age_ms = 1e-3 * in_microseconds(session.real_time->server.contact_set_age.quantile(0.99));
  if (age_ms > kOld_ms) {
    return formatted(
               "%s did not keep up with real time: one contact set in a hundred was more than %.0f ms old, so what "
               "was visible lagged behind the gloves",
               friction.empty() ? "the machine" : "the simulation", age_ms) +
           friction;
  }
  return "";
}

SessionSummary conclude(const Session& session, const HapticScene& scene, const std::string& title, bool as_json,
                        bool verbose, const std::string& report_folder) {
  constexpr std::chrono::milliseconds kAfterInterrupt{500};
  std::optional<std::chrono::steady_clock::time_point> interrupted;
  const SessionSummary summary = summarize(session, scene, [&] {
    if (!StopSignal::requested()) return false;
    const auto now = std::chrono::steady_clock::now();
    if (!interrupted) interrupted = now;
    return now - *interrupted >= kAfterInterrupt;
  });
  if (summary.checked < summary.samples)
    say("glissade: interrupted: the poses of " + std::to_string(summary.checked) + " of " +
        std::to_string(summary.samples) + " ticks were checked for collisions");
  if (as_json) {
    std::cout << to_json(summary, session).dump(2) << '\n';
  } else {
    std::cout << title << '\n' << to_text(summary, session, verbose);
  }
  if (const std::string warning = real_time_warning(session); !warning.empty()) say("glissade: warning: " + warning);
  if (!report_folder.empty()) {
    const std::string page = write_session_report(summary, session, title, report_folder, scene);
    if (!as_json) std::cout << "  report                       " << page << '\n';
  }
  if (!session.recording.empty() && !as_json)
    std::cout << "  recording                    " << session.recording << '\n';
  std::cout.flush();
  if (summary.colliding_poses() > 0) {
    throw std::runtime_error(std::to_string(summary.colliding_poses()) + " visible poses collide");
  }
  if (!session.is_recording_whole) throw std::runtime_error(session.recording + ": the recording is not whole");
  return summary;
}

}  // namespace glissade::apps
