#include <cstdint>

#include <glissade/apps/view/session_view.h>
#include <glissade/apps/view/slide_replay.h>
#include <glissade/haptics/coupling.h>

namespace glissade::apps {

namespace {

viewer::ViewScene slide_view_of(const HapticScene& scene) {
  viewer::ViewScene view = view_scene_of(scene, {"hand"}, {});
  view.has_loop = false;
  return view;
}

}  // namespace

SlideReplay::SlideReplay(const HapticScene& scene)
    : maker_(slide_view_of(scene)), patches_(scene.parts.front().part_V->radius()) {}

void SlideReplay::add(std::chrono::nanoseconds time, const haptics::SlidingSimulation& sliding) {
  devices::HapticState state;
  state.sequence = ++ticks_;
  state.time = time;
  const haptics::SlidingResult& result = sliding.result();
  show_part(result, 0, patches_, state);
  for (const Eigen::Isometry3d& X_WB : sliding.scripted_X_WB()) {
    devices::HapticPartState& moving = state.parts[static_cast<std::size_t>(state.part_count++)];
    moving.X_WG = moving.X_WV = X_WB;
  }
  const haptics::Wrench wrench = haptics::about_point(haptics::spring_wrench(sliding.stiffness(), sliding.error()),
                                                      result.X_WT * sliding.part().p_Vref(), result.X_WV.translation());
  state.hands[0].part = 0;
  state.hands[0].force_W = wrench.f;
  state.hands[0].torque_V_W = wrench.t;
  maker_.add(state);
}

Replay SlideReplay::finish() {
  return maker_.finish();
}

}  // namespace glissade::apps
