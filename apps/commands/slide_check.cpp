#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>

#include <glissade/apps/commands/size_warnings.h>
#include <glissade/apps/commands/slide_check.h>
#include <glissade/apps/durations.h>
#include <glissade/apps/report/growing_curve.h>
#include <glissade/apps/scene/sliding_option.h>
#include <glissade/apps/scene/start_overlap.h>
#include <glissade/apps/text.h>
#include <glissade/apps/view/clearance_curve.h>
#include <glissade/contact/spring.h>
#include <glissade/reference/sliding_method.h>
#include <glissade/study/slide_meter.h>

namespace glissade::apps {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kPlottedChecks = 6;

/// How deep the part is in others at the first row, and what can be done about it.
std::string advice(const HapticScene& scene, const FollowedTrajectory& trajectory, const SlideCheckOptions& options) {
  std::vector<Eigen::Isometry3d> moving_X_WB;
  for (const contact::ScriptedPart& part : scene.moving)
    moving_X_WB.push_back(part.script_X_WB.pose_at(trajectory.first_time()));
  const Eigen::Isometry3d& X_WV = trajectory.first_pose();
  const bool may_depenetrate = options.method == reference::SlidingMethod::kProjection &&
                               options.sliding.rules.overlap != contact::OverlapRule::kDepenetrate;
  return overlap_advice(scene, std::span(&X_WV, 1), moving_X_WB, may_depenetrate);
}

/// The distance of the part's bounding sphere from those of all other objects, metres; negative if they intersect.
double between_spheres(const HapticScene& scene, const reference::SlidingSimulation& sliding) {
  const collision::DopTree& part = scene.parts.front().part_V->tree;
  const Eigen::Vector3d center_W = sliding.result().X_WV * part.center();
  double least = std::numeric_limits<double>::infinity();
  const auto look_at = [&](const collision::DopTree& tree, const Eigen::Isometry3d& X_WB) {
    least = std::min(least, (X_WB * tree.center() - center_W).norm() - tree.radius() - part.radius());
  };
  for (const contact::Obstacle& obstacle : scene.obstacles)
    look_at(obstacle.body->tree, obstacle.X_WO);
  for (std::size_t i = 0; i < scene.moving.size(); ++i)
    look_at(scene.moving[i].part_B->tree, sliding.scripted_X_WB()[i]);
  return least;
}

/// The simulation from the first row of the trajectory on. Throws std::invalid_argument, with one sentence, when a body
/// is not free there.
std::unique_ptr<reference::SlidingSimulation> start_sliding(const HapticScene& scene,
                                                            const FollowedTrajectory& trajectory,
                                                            const SlideCheckOptions& options) {
  std::vector<contact::ScriptedPart> moving = scene.moving;
  for (contact::ScriptedPart& part : moving)
    part.start = trajectory.first_time();
  try {
    return reference::make_sliding(options.method, scene.obstacles, scene.parts.front().part_V, trajectory.first_pose(),
                                   options.sliding, moving);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string(error.what()) + ", at the time of the first row" +
                                advice(scene, trajectory, options));
  }
}

/// Advances to a tick of the trajectory, a millisecond, and returns its time.
std::chrono::nanoseconds slide_to(std::int64_t tick, FollowedTrajectory& trajectory,
                                  reference::SlidingSimulation& sliding) {
  const std::chrono::nanoseconds time = trajectory.first_time() + tick * milliseconds(1);
  // The first row shows the start: no time has passed yet.
  sliding.advance(trajectory.pose_at(time), tick == 0 ? 0.0 : 1.0);
  return time;
}

}  // namespace

SlideCheck check_slide(const HapticScene& scene, FollowedTrajectory& trajectory, const std::string& name,
                       const SlideCheckOptions& options, const SlideWatch& watch) {
  SlideCheck check;
  check.trajectory = name;
  check.has_goal = scene.X_WGoal.has_value();
  check.doubt = doubt_of_positions(trajectory.positions(), scene);
  check.far_m = std::numeric_limits<double>::infinity();
  std::unique_ptr<reference::SlidingSimulation> sliding;
  try {
    sliding = start_sliding(scene, trajectory, options);
  } catch (const std::invalid_argument& error) {
    check.problem = error.what();
    return check;
  }
  const Eigen::Isometry3d X_WGoal = scene.X_WGoal.value_or(trajectory.last_pose());
  study::SlideMeter meter(scene, {X_WGoal, options.goal_tolerance_m, options.goal_tolerance_deg},
                          options.needs_summary);
  const std::int64_t ticks = trajectory.duration() / milliseconds(1);
  ClearanceCurve curve(scene, ticks + 1);
  GrowingCurve force(name);
  for (std::int64_t i = 0; i <= ticks; ++i) {
    const std::chrono::nanoseconds now = slide_to(i, trajectory, *sliding);
    const std::chrono::nanoseconds time = now - trajectory.first_time();
    const contact::SlidingResult& result = sliding->result();
    meter.note(time, result, sliding->scripted_X_WB());
    if (options.needs_curve) {
      force.add(in_seconds(time), contact::contact_wrench(result, sliding->part().p_Vref()).f.norm());
      curve.note(time, result.X_WV, sliding->scripted_X_WB(), result.contacts);
    }
    check.far_m = std::min(check.far_m, between_spheres(scene, *sliding));
    if (watch) watch(now, *sliding);
  }
  check.measures = meter.finish();
  check.force = force.series();
  check.clearance = curve.take(name);
  if (check.measures.goal_reached) return check;
  check.overlaps = text_of_overlaps(scene, std::span(&check.measures.X_WV_end, 1), sliding->scripted_X_WB());
  return check;
}

std::string name_of_goal(const SlideCheck& check) {
  return check.has_goal ? "goal" : "end of the trajectory";
}

std::string goal_tolerance(const SlideCheckOptions& options) {
  return rounded_text(1e3 * options.goal_tolerance_m) + " mm and " + rounded_text(options.goal_tolerance_deg) +
         " degrees";
}

std::string verdict(const SlideCheck& check, const SlideCheckOptions& options) {
  if (check.problem) return *check.problem;
  const std::string clearance = std::isfinite(check.measures.clearance_min_m)
                                    ? "; least clearance " + rounded_text(1e3 * check.measures.clearance_min_m) +
                                          " mm at " + fixed_text(check.measures.clearance_min_at_s, 3) + " s"
                                    : "";
  return name_of_goal(check) + (check.measures.goal_reached ? " reached, " : " not reached, ") +
         fixed_text(1e3 * check.measures.goal_distance_m, 3) + " mm and " +
         fixed_text(check.measures.goal_angle_deg, 2) + " degrees from it" +
         (check.measures.goal_reached ? "" : " (allowed: " + goal_tolerance(options) + ")") +
         (check.overlaps.empty() ? "" : ", still " + check.overlaps) + "; at most " +
         fixed_text(check.measures.force_max_N, 2) + " N and " + fixed_text(check.measures.torque_max_Nm, 3) +
         " Nm about the part's reference point" + clearance + "; " + fixed_text(check.measures.contact_s, 3) + " of " +
         fixed_text(check.measures.duration_s, 3) + " s in contact";
}

namespace {

ReportCell number_cell(double value, int decimals) {
  return {std::isfinite(value) ? fixed_text(value, decimals) : "", value};
}

/// One row per trajectory with the numbers of the summary.
ReportTable table_of(const std::vector<SlideCheck>& checks) {
  ReportTable table{"Trajectories",
                    {"trajectory", "goal", "pushed at the end by", "distance from goal [mm]", "angle from goal [deg]",
                     "greatest force [N]", "greatest torque [Nm]", "least clearance [mm]", "its time [s]",
                     "in contact [s]", "duration [s]"}};
  for (const SlideCheck& check : checks) {
    std::vector<ReportCell>& row = table.rows.emplace_back();
    row.push_back({check.trajectory});
    if (check.problem) {
      row.push_back({"not checked: " + *check.problem});
      row.push_back({});
      row.resize(table.columns.size(), number_cell(std::numeric_limits<double>::quiet_NaN(), 0));
      continue;
    }
    row.push_back({check.measures.goal_reached ? "reached" : "missed"});
    row.push_back({check.measures.goal_reached ? "" : check.measures.pushed_by});
    row.push_back(number_cell(1e3 * check.measures.goal_distance_m, 3));
    row.push_back(number_cell(check.measures.goal_angle_deg, 2));
    row.push_back(number_cell(check.measures.force_max_N, 2));
    row.push_back(number_cell(check.measures.torque_max_Nm, 3));
    row.push_back(number_cell(1e3 * check.measures.clearance_min_m, 4));
    const bool is_near = std::isfinite(check.measures.clearance_min_m);
    row.push_back(number_cell(is_near ? check.measures.clearance_min_at_s : check.measures.clearance_min_m, 3));
    row.push_back(number_cell(check.measures.contact_s, 3));
    row.push_back(number_cell(check.measures.duration_s, 3));
  }
  return table;
}

}  // namespace

Report report_of(const HapticScene& scene, const std::vector<SlideCheck>& checks, const SlideCheckOptions& options) {
  Report report;
  report.title = "Assembly check of " + scene.parts.front().name;
  const auto reached = std::count_if(checks.begin(), checks.end(), [](const SlideCheck& check) {
    return !check.problem && check.measures.goal_reached;
  });
  report.summary.emplace_back("scene", scene.source);
  report.summary.emplace_back("metaphor", std::string(contact::name_of(options.sliding.metaphor)));
  report.summary.emplace_back("method", std::string(reference::name_of(options.method)));
  report.summary.emplace_back("rules", words_of(options.choice));
  report.summary.emplace_back(scene.X_WGoal ? "goal reached" : "end of the trajectory reached",
                              std::to_string(reached) + " of " + std::to_string(checks.size()));
  if (checks.size() == 1) {
    report.summary.emplace_back(checks.front().trajectory, verdict(checks.front(), options));
  } else {
    report.table = table_of(checks);
  }

  std::vector<const SlideCheck*> by_force;
  for (const SlideCheck& check : checks) {
    if (!check.problem) by_force.push_back(&check);
  }
  std::stable_sort(by_force.begin(), by_force.end(), [](const SlideCheck* a, const SlideCheck* b) {
    return a->measures.force_max_N > b->measures.force_max_N;
  });
  if (by_force.size() > kPlottedChecks) by_force.resize(kPlottedChecks);
  if (by_force.empty()) return report;
  // The page of a single trajectory has the force by its axes.
  if (checks.size() > 1) {
    Plot plot{"Force on the hand, where it was greatest", kTimeLabel, "force [N]", {}};
    for (const SlideCheck* check : by_force)
      plot.series.push_back(check->force);
    report.plots.push_back(std::move(plot));
  }
  Plot clearance = clearance_plot();
  for (const SlideCheck* check : by_force)
    clearance.series.push_back(check->clearance);
  report.plots.push_back(std::move(clearance));
  return report;
}

}  // namespace glissade::apps
