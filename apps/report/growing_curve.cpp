#include <glissade/apps/report/growing_curve.h>

namespace glissade::apps {
namespace {

constexpr std::size_t kMostStretches = 1536;  // twice as many points are finer than a page draws them

}  // namespace

void GrowingCurve::Stretch::extend(const Stretch& other) {
  if (other.least.y < least.y) least = other.least;
  if (other.greatest.y > greatest.y) greatest = other.greatest;
}

void GrowingCurve::add(double x, double y) {
  const Stretch point{{x, y}, {x, y}};
  if (stretches_.empty()) first_ = point.least;
  last_ = point.least;
  if (points_of_last_ > 0 && points_of_last_ < points_of_stretch_) {
    stretches_.back().extend(point);
    ++points_of_last_;
    return;
  }
  if (stretches_.size() == kMostStretches) {
    for (std::size_t i = 0; i < kMostStretches / 2; ++i) {
      stretches_[i] = stretches_[2 * i];
      stretches_[i].extend(stretches_[2 * i + 1]);
    }
    stretches_.resize(kMostStretches / 2);
    points_of_stretch_ *= 2;
  }
  stretches_.push_back(point);
  points_of_last_ = 1;
}

PlotSeries GrowingCurve::series() const {
  PlotSeries series{name_, {}, {}};
  const auto append = [&](const Point& point) {
    if (!series.x.empty() && series.x.back() == point.x) return;
    series.x.push_back(point.x);
    series.y.push_back(point.y);
  };
  if (!stretches_.empty()) append(first_);
  for (const Stretch& stretch : stretches_) {
    const bool rises = stretch.least.x <= stretch.greatest.x;
    append(rises ? stretch.least : stretch.greatest);
    append(rises ? stretch.greatest : stretch.least);
  }
  if (!stretches_.empty()) append(last_);
  return series;
}

Plot GrowingPlot::plot() const {
  Plot plot = plot_;
  for (const GrowingCurve& curve : curves_)
    plot.series.push_back(curve.series());
  return plot;
}

void VectorPlot::add(double time_s, const Eigen::Vector3d& value) {
  plot_.add(0, time_s, value.norm());
  for (Eigen::Index i = 0; i < 3; ++i)
    plot_.add(static_cast<std::size_t>(i + 1), time_s, value[i]);
}

}  // namespace glissade::apps
