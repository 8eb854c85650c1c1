#include "guarded_simulation.h"

#include <chrono>

#include <glissade/contact/tracked_contacts.h>
#include <glissade/viewer/view_simulation.h>

namespace glissade::python {

std::shared_ptr<ShownState> ShownSimulation::watch() {
  shown_->watch();
  show_after(0.0);
  return shown_;
}

void ShownSimulation::show_led_parts(devices::HapticState& state) {
  state.hand_count = static_cast<std::int32_t>(part_count());
  for (std::size_t p = 0; p < part_count(); ++p) {
    const contact::Wrench wrench = this->wrench(p);
    const Eigen::Vector3d r_W = X_WV(p).linear() * engine().parts().p_Vref(p);
    state.hands[p].part = static_cast<std::int32_t>(p);
    state.hands[p].force_W = wrench.f;
    state.hands[p].torque_V_W = wrench.t + r_W.cross(wrench.f);
  }
}

void ShownSimulation::show_after(double milliseconds) {
  time_ms_ += milliseconds;
  ++steps_;
  if (!shown_->is_watched()) return;
  const grasping::GraspSimulation& simulation = engine();
  devices::HapticState state;
  state.sequence = steps_;
  state.time = std::chrono::round<std::chrono::nanoseconds>(std::chrono::duration<double, std::milli>(time_ms_));
  state.part_count = static_cast<std::int32_t>(simulation.parts().part_count());
  state.hand_count = static_cast<std::int32_t>(simulation.hand_count());
  for (std::size_t p = 0; p < simulation.parts().part_count(); ++p) {
    contact::ContactPatches patches(simulation.parts().part(p).radius());
    viewer::show_part(result(p), simulation.parts().p_Vref(p), p, patches, state);
  }
  for (std::size_t h = 0; h < simulation.hand_count(); ++h) {
    const std::optional<std::size_t> part = simulation.held_part(h);
    state.hands[h].part = part ? static_cast<std::int32_t>(*part) : -1;
    state.hands[h].visible = simulation.visible(h);
  }
  if (simulation.hand_count() == 0) show_led_parts(state);
  shown_->put(state);
}

}  // namespace glissade::python
