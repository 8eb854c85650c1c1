#include <cstdint>

#include <glissade/apps/view/session_view.h>
#include <glissade/apps/view/slide_replay.h>
#include <glissade/contact/spring.h>
#include <glissade/viewer/view_simulation.h>

namespace glissade::apps {

namespace {

viewer::ViewScene slide_view_of(const HapticScene& scene) {
  viewer::ViewScene view = view_scene_of(scene, {"hand"}, {});
  view.has_loop = false;
  return view;
}

}  // namespace

SlideReplay::SlideReplay(const HapticScene& scene)
    : maker_(slide_view_of(scene)), part_({scene.parts.front().name}), patches_(scene.parts.front().part_V->radius()) {}

void SlideReplay::add(std::chrono::nanoseconds time, const contact::SlidingResult& result,
                      const Eigen::Vector3d& p_Vref, std::span<const Eigen::Isometry3d> scripted_X_WB) {
  devices::HapticState state;
  state.sequence = ++ticks_;
  state.time = time;
  viewer::show_part(result, p_Vref, 0, patches_, state);
  for (const Eigen::Isometry3d& X_WB : scripted_X_WB) {
    devices::HapticPartState& moving = state.parts[static_cast<std::size_t>(state.part_count++)];
    moving.X_WG = moving.X_WV = X_WB;
  }
  const contact::Wrench wrench = contact::contact_wrench(result, p_Vref);
  state.hands[0].part = 0;
  state.hands[0].force_W = wrench.f;
  state.hands[0].torque_V_W = wrench.t;
  maker_.add(state);
  const double time_s = 1e-3 * static_cast<double>(ticks_ - 1);
  force_.add(time_s, wrench.f);
  torque_.add(time_s, wrench.t);
  part_.add(time_s, 0, state.parts[0]);
}

void SlideReplay::finish(Report& report, const std::string& of) {
  const auto first = report.plots.insert(report.plots.begin(), {force_.plot(), torque_.plot()});
  first[0].title += of;
  first[1].title += of;
  part_.finish(report);
  report.replay = maker_.finish();
}

}  // namespace glissade::apps
