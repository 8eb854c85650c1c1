#include <algorithm>
#include <map>

#include <glissade/apps/report/word_curve.h>

namespace glissade::apps {

void WordCurve::add(double time, std::size_t word) {
  end_ = time;
  const auto number = static_cast<double>(word);
  if (!changes_.y.empty() && changes_.y.back() == number) return;
  changes_.x.push_back(time);
  changes_.y.push_back(number);
}

PlotSeries WordCurve::series(std::size_t most) const {
  PlotSeries series = changes_;
  if (series.x.size() > most) {
    WordCurve coarse(series.name);
    const double step = (end_ - series.x.front()) / static_cast<double>(most);
    std::size_t first = 0;
    for (std::size_t i = 0; i < most; ++i) {
      const double begin = series.x.front() + static_cast<double>(i) * step;
      coarse.add(begin, longest_between(begin, begin + step, first));
    }
    series = coarse.changes_;
  }
  if (series.x.empty()) return series;
  series.x.push_back(end_);
  series.y.push_back(series.y.back());
  return series;
}

/// `first` is a change before the stretch, and becomes the last one before it.
std::size_t WordCurve::longest_between(double begin, double end, std::size_t& first) const {
  const auto end_of = [&](std::size_t i) { return i + 1 < changes_.x.size() ? changes_.x[i + 1] : end_; };
  while (first + 1 < changes_.x.size() && end_of(first) <= begin)
    ++first;
  std::map<double, double> durations;  // by word
  for (std::size_t i = first; i < changes_.x.size() && changes_.x[i] < end; ++i)
    durations[changes_.y[i]] += std::min(end_of(i), end) - std::max(changes_.x[i], begin);
  const auto longest = std::max_element(durations.begin(), durations.end(),
                                        [](const auto& a, const auto& b) { return a.second < b.second; });
  return static_cast<std::size_t>(longest->first);
}

}  // namespace glissade::apps
