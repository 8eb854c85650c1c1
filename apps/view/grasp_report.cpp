#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iterator>
#include <utility>

#include <glissade/apps/text.h>
#include <glissade/apps/view/grasp_report.h>
#include <glissade/apps/view/session_view.h>
#include <glissade/contact/spring.h>
#include <glissade/viewer/view_simulation.h>

namespace glissade::apps {

namespace {

std::vector<std::string> names_of_hands(std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t h = 0; h < count; ++h)
    names.push_back("hand " + std::to_string(h));
  return names;
}

viewer::ViewScene grasp_view_of(const HapticScene& scene,
                                const std::vector<std::shared_ptr<const grasping::HandModel>>& hands) {
  viewer::ViewScene view = view_scene_of(scene, names_of_hands(hands.size()), hands);
  view.has_loop = false;
  return view;
}

std::vector<std::string> names_of_parts(const HapticScene& scene) {
  return {scene.body_names.begin() + std::ssize(scene.obstacles), scene.body_names.end()};
}

}  // namespace

GraspReport::GraspReport(const HapticScene& scene, const grasping::GraspSimulation& simulation,
                         const std::vector<std::shared_ptr<const grasping::HandModel>>& hands, std::int64_t ticks)
    : scene_(scene),
      simulation_(simulation),
      replay_(grasp_view_of(scene, hands)),
      touching_({"Segments that touch", kTimeLabel, "segments", {}, true}, names_of_hands(hands.size())),
      parts_(names_of_parts(scene)) {
  for (const std::string& name : names_of_hands(hands.size()))
    kinds_.emplace_back(name);
  for (std::size_t p = 0; p < simulation.part_count(); ++p) {
    patches_.emplace_back(simulation.parts().part(p).radius());
  }
  for (std::size_t p = 0; p < scene.parts.size(); ++p) {
    const std::string of_part = " of " + scene.parts[p].name + " on the hands";
    forces_.emplace_back("Force" + of_part, "force [N]");
    torques_.emplace_back("Torque" + of_part + ", about its reference point", "torque [Nm]");
    clearances_.emplace_back(scene, ticks, p);
  }
}

void GraspReport::add(std::chrono::nanoseconds time) {
  devices::HapticState state;
  state.sequence = ++ticks_;
  state.time = time;
  state.part_count = static_cast<std::int32_t>(simulation_.part_count());
  state.hand_count = static_cast<std::int32_t>(simulation_.hand_count());
  const double time_s = 1e-3 * static_cast<double>(ticks_ - 1);
  for (std::size_t p = 0; p < simulation_.part_count(); ++p) {
    const contact::SlidingResult& result = simulation_.parts().result(p);
    viewer::show_part(result, simulation_.parts().p_Vref(p), p, patches_[p], state);
    parts_.add(time_s, p, state.parts[p]);
    if (p >= scene_.parts.size()) continue;  // moves on its own
    const contact::Wrench wrench =
        contact::contact_wrench(simulation_.parts().result(p), simulation_.parts().p_Vref(p));
    forces_[p].add(time_s, wrench.f);
    torques_[p].add(time_s, wrench.t);
    others_X_WB_.clear();
    for (std::size_t other = 0; other < simulation_.part_count(); ++other) {
      if (other != p) others_X_WB_.push_back(simulation_.parts().result(other).X_WV);
    }
    clearances_[p].note(std::chrono::milliseconds(ticks_ - 1), result.X_WV, others_X_WB_);
  }
  for (std::size_t h = 0; h < simulation_.hand_count(); ++h) {
    const auto part = simulation_.held_part(h);
    devices::HapticHandState& hand = state.hands[h];
    hand.part = part ? static_cast<std::int32_t>(*part) : -1;
    hand.visible = simulation_.visible(h);
    const auto& touching = simulation_.clasp(h).touching();
    const auto count = std::count_if(touching.begin(), touching.end(), [](char touches) { return touches != 0; });
    touching_.add(h, time_s, static_cast<double>(count));
    kinds_[h].add(time_s, static_cast<std::size_t>(hand.visible.grasp));
  }
  replay_.add(state);
}

Report GraspReport::finish(const GraspOutcome& outcome) {
  Report report{"glissade grasp: " + scene_.source, outcome.rows(), {}};
  Plot kinds{.title = "Kind of grasp", .x_label = kTimeLabel};
  for (std::int32_t kind = 0; kind < hands::kGraspTypes; ++kind)
    kinds.words.emplace_back(hands::name_of(static_cast<hands::GraspType>(kind)));
  for (const WordCurve& curve : kinds_)
    kinds.series.push_back(curve.series());
  report.plots = {std::move(kinds), touching_.plot()};
  for (std::size_t p = 0; p < scene_.parts.size(); ++p) {
    report.plots.push_back(forces_[p].plot());
    report.plots.push_back(torques_[p].plot());
  }
  parts_.finish(report);
  Plot clearance = clearance_plot();
  for (std::size_t p = 0; p < clearances_.size(); ++p)
    clearance.series.push_back(clearances_[p].take(scene_.parts[p].name));
  report.plots.push_back(std::move(clearance));
  report.replay = replay_.finish();
  return report;
}

}  // namespace glissade::apps
