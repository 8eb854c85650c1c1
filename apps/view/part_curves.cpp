#include <cstdint>
#include <numbers>
#include <utility>

#include <glissade/apps/view/part_curves.h>

namespace glissade::apps {

PartCurves::PartCurves(const std::vector<std::string>& names) {
  for (std::int32_t state = 0; state < devices::kPartStates; ++state)
    states_.words.emplace_back(devices::name_of(devices::part_state_from_number(state)));
  for (const std::string& name : names) {
    lags_mm_.emplace_back(name);
    lags_deg_.emplace_back(name);
    contacts_.emplace_back(name);
    states_.strips.push_back({name, {}});
  }
}

void PartCurves::add(double time_s, std::size_t part, const devices::HapticPartState& state) {
  constexpr double kRounding = 1e-9;  // mm or degrees; an axis of less would tell of nothing else
  const auto add_lag = [time_s](GrowingCurve& curve, double lag) { curve.add(time_s, lag > kRounding ? lag : 0.0); };
  const geometry::Displacement lag = state.lag();
  add_lag(lags_mm_[part], 1e3 * lag.v.norm());
  add_lag(lags_deg_[part], lag.w.norm() * 180.0 / std::numbers::pi);
  contacts_[part].add(time_s, state.contact_count);
  states_.strips[part].add(time_s, static_cast<std::size_t>(state.state));
  states_.strips[part].end_at(time_s);
}

void PartCurves::finish(Report& report) {
  Plot lags{"Lag of the visible parts behind their ghosts", kTimeLabel, "lag of the reference point [mm]", {}};
  Plot angles{"Angle between the visible parts and their ghosts", kTimeLabel, "angle [degrees]", {}};
  Plot contacts{.title = "Contacts that push", .x_label = kTimeLabel, .y_label = "contacts", .counts = true};
  for (std::size_t part = 0; part < lags_mm_.size(); ++part) {
    lags.series.push_back(lags_mm_[part].series());
    angles.series.push_back(lags_deg_[part].series());
    contacts.series.push_back(contacts_[part].series());
  }
  report.plots.push_back(std::move(lags));
  report.plots.push_back(std::move(angles));
  report.plots.push_back(std::move(contacts));
  report.strips.push_back(std::move(states_));
}

}  // namespace glissade::apps
