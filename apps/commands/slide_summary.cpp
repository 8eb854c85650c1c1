#include <cstdint>

#include <glissade/apps/commands/slide_summary.h>

namespace glissade::apps {

SlideSummary::SlideSummary(const std::string& path)
    : out_(path, {"trajectory", "goal_reached", "goal_distance_m", "goal_angle_deg", "force_max_N", "torque_max_Nm",
                  "clearance_min_m", "clearance_min_at_s", "duration_s", "contact_s"}) {
  out_.close();
}

void SlideSummary::add(const SlideCheck& check) {
  if (check.problem) return;
  out_.add(check.trajectory).add(std::int64_t{check.measures.goal_reached});
  for (const double value : {check.measures.goal_distance_m, check.measures.goal_angle_deg, check.measures.force_max_N,
                             check.measures.torque_max_Nm, check.measures.clearance_min_m,
                             check.measures.clearance_min_at_s, check.measures.duration_s, check.measures.contact_s}) {
    out_.add(value);
  }
  out_.end_row();
  out_.close();
}

}  // namespace glissade::apps
