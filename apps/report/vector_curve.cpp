#include <iterator>
#include <utility>

#include <glissade/apps/report/vector_curve.h>

namespace glissade::apps {

void VectorCurve::add(double time_s, const Eigen::Vector3d& value) {
  const std::array<double, 4> values{value.norm(), value.x(), value.y(), value.z()};
  for (std::size_t i = 0; i < values.size(); ++i) {
    series_[i].x.push_back(time_s);
    series_[i].y.push_back(values[i]);
  }
}

Plot VectorCurve::take(std::string title, std::string label) {
  return {std::move(title),
          kTimeLabel,
          std::move(label),
          {std::make_move_iterator(series_.begin()), std::make_move_iterator(series_.end())}};
}

}  // namespace glissade::apps
