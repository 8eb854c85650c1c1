#include <utility>

#include <glissade/apps/report/vector_curve.h>

namespace glissade::apps {

void VectorCurve::add(double time_s, const Eigen::Vector3d& value) {
  const std::array<double, 4> values{value.norm(), value.x(), value.y(), value.z()};
  for (std::size_t i = 0; i < values.size(); ++i)
    curves_[i].add(time_s, values[i]);
}

Plot VectorCurve::plot(std::string title, std::string label) const {
  Plot plot{std::move(title), kTimeLabel, std::move(label), {}};
  for (const GrowingCurve& curve : curves_)
    plot.series.push_back(curve.series());
  return plot;
}

}  // namespace glissade::apps
