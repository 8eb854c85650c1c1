#include <cstdint>
#include <numbers>
#include <utility>

#include <glissade/apps/view/part_curves.h>

namespace glissade::apps {

PartCurves::PartCurves(const std::vector<std::string>& names)
    : lags_({"Lag of the visible parts behind their ghosts", kTimeLabel, "lag of the reference point [mm]", {}}, names),
      angles_({"Angle between the visible parts and their ghosts", kTimeLabel, "angle [degrees]", {}}, names),
      contacts_({"Contacts that push", kTimeLabel, "contacts", {}, true}, names),
      states_(names.begin(), names.end()) {}

void PartCurves::add(double time_s, std::size_t part, const devices::HapticPartState& state) {
  constexpr double kRounding = 1e-9;  // mm or degrees; an axis of less would tell of nothing else
  const auto add_lag = [&](GrowingPlot& plot, double lag) { plot.add(part, time_s, lag > kRounding ? lag : 0.0); };
  const geometry::Displacement lag = state.lag();
  add_lag(lags_, 1e3 * lag.v.norm());
  add_lag(angles_, lag.w.norm() * 180.0 / std::numbers::pi);
  contacts_.add(part, time_s, state.contact_count);
  states_[part].add(time_s, static_cast<std::size_t>(state.state));
}

void PartCurves::finish(Report& report) const {
  for (const GrowingPlot* plot : {&lags_, &angles_, &contacts_})
    report.plots.push_back(plot->plot());
  Plot states{.title = "States of the parts", .x_label = kTimeLabel};
  for (std::int32_t state = 0; state < devices::kPartStates; ++state)
    states.words.emplace_back(devices::name_of(devices::part_state_from_number(state)));
  for (const WordCurve& curve : states_)
    states.series.push_back(curve.series());
  report.plots.push_back(std::move(states));
}

}  // namespace glissade::apps
