#include <algorithm>
#include <limits>
#include <numbers>
#include <set>

#include <glissade/files/text.h>
#include <glissade/geometry/displacement.h>
#include <glissade/study/slide_meter.h>

namespace glissade::study {
namespace {

double distance_m(const Eigen::Isometry3d& X_WA, const Eigen::Isometry3d& X_WB) {
  return (X_WA.translation() - X_WB.translation()).norm();
}

double angle_deg(const Eigen::Isometry3d& X_WA, const Eigen::Isometry3d& X_WB) {
  return Eigen::AngleAxisd(X_WB.linear().transpose() * X_WA.linear()).angle() * 180.0 / std::numbers::pi;
}

double in_seconds(std::chrono::nanoseconds time) {
  return std::chrono::duration<double>(time).count();
}

}  // namespace

SlideMeter::SlideMeter(const simulation::SceneBodies& bodies, const SlideGoal& goal, bool measures_clearance)
    : bodies_(bodies), goal_(goal) {
  if (measures_clearance) clearance_.emplace(bodies);
}

void SlideMeter::update(Rest& rest, double share_of_goal, const Eigen::Isometry3d& X_WV, double time_s) const {
  const bool is_near = distance_m(X_WV, rest.X_WV) <= share_of_goal * goal_.distance_m &&
                       angle_deg(X_WV, rest.X_WV) <= share_of_goal * goal_.angle_deg;
  if (ticks_ == 0 || !is_near) rest = {X_WV, time_s};
}

void SlideMeter::note(std::chrono::nanoseconds time, const contact::SlidingResult& result,
                      std::span<const Eigen::Isometry3d> moving_X_WB) {
  const contact::Wrench wrench = contact::contact_wrench(result, bodies_.parts.front().part_V->p_Vref());
  measures_.force_max_N = std::max(measures_.force_max_N, wrench.f.norm());
  measures_.torque_max_Nm = std::max(measures_.torque_max_Nm, wrench.t.norm());
  measures_.duration_s = in_seconds(time);
  contact_ticks_ += result.pushing > 0 ? 1 : 0;
  if (clearance_) clearance_->note(result.X_WV, moving_X_WB, result.contacts);
  update(rest_, 1.0, result.X_WV, measures_.duration_s);
  update(short_rest_, 0.1, result.X_WV, measures_.duration_s);
  if (ticks_ > 0) add_work(result, wrench);
  last_ = result;
  last_wrench_ = wrench;
  ++ticks_;
}

/// The hand moves the ghost against the wrench that it feels (trapezoidal rule).
void SlideMeter::add_work(const contact::SlidingResult& result, const contact::Wrench& wrench) {
  if (result.pushing == 0 && last_.pushing == 0) return;
  const Eigen::Vector3d& p_Vref = bodies_.parts.front().part_V->p_Vref();
  const Eigen::Vector3d way = result.X_WG * p_Vref - last_.X_WG * p_Vref;
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(result.X_WG.linear() * last_.X_WG.linear().transpose()));
  measures_.work_J -= 0.5 * (wrench.f + last_wrench_.f).dot(way);
  measures_.work_J -= 0.5 * turn.angle() * (wrench.t + last_wrench_.t).dot(turn.axis());
}

void SlideMeter::note_pushing(const contact::SlidingResult& result) {
  std::set<std::int32_t> pushing;
  double forces = 0.0;
  Eigen::Vector3d weighted = Eigen::Vector3d::Zero();
  for (const contact::Contact& contact : result.contacts) {
    if (!(contact.force > 0.0)) continue;
    pushing.insert(contact.obstacle);
    forces += contact.force;
    weighted += contact.force * contact.p_W;
  }
  if (pushing.empty()) return;
  std::vector<std::string> names;
  for (const std::int32_t body : pushing)
    names.push_back(bodies_.body_names[static_cast<std::size_t>(body)]);
  measures_.pushed_by = files::joined(names);
  measures_.p_Wpushed = weighted / forces;
}

SlideMeasures SlideMeter::finish() {
  using std::chrono::milliseconds;
  measures_.contact_s = in_seconds(contact_ticks_ * milliseconds(1));
  measures_.clearance_min_m = std::numeric_limits<double>::infinity();
  if (clearance_) {
    clearance_->finish();
    measures_.clearance_min_m = clearance_->least();
    measures_.clearance_min_at_s = in_seconds(clearance_->least_at() * milliseconds(1));
  }
  measures_.still_since_s = rest_.since_s;
  measures_.moves_at_end = measures_.duration_s - short_rest_.since_s < 0.01;
  measures_.X_WV_end = last_.X_WV;
  measures_.goal_distance_m = distance_m(last_.X_WV, goal_.X_WGoal);
  measures_.goal_angle_deg = angle_deg(last_.X_WV, goal_.X_WGoal);
  measures_.goal_reached = measures_.goal_distance_m <= goal_.distance_m && measures_.goal_angle_deg <= goal_.angle_deg;
  note_pushing(last_);
  return measures_;
}

}  // namespace glissade::study
