#include <algorithm>
#include <cassert>
#include <cmath>

#include <glissade/apps/report/plot.h>

namespace glissade::apps {

namespace {

/// Copies the point `index` of `from` to the end of `to`.
void append_point(const PlotSeries& from, std::size_t index, PlotSeries& to) {
  to.x.push_back(from.x[index]);
  to.y.push_back(from.y[index]);
}

/// Appends the minimum and the maximum of the points `begin` to `end` in their order, or one gap when no value is
/// finite.
void append_extremes(const PlotSeries& from, std::size_t begin, std::size_t end, PlotSeries& to) {
  std::size_t least = end;
  std::size_t greatest = end;
  for (std::size_t i = begin; i < end; ++i) {
    if (!std::isfinite(from.y[i])) continue;
    if (least == end || from.y[i] < from.y[least]) least = i;
    if (greatest == end || from.y[i] > from.y[greatest]) greatest = i;
  }
  if (least == end) {
    append_point(from, begin, to);
    return;
  }
  append_point(from, std::min(least, greatest), to);
  if (least != greatest) append_point(from, std::max(least, greatest), to);
}

}  // namespace

PlotSeries decimated(const PlotSeries& series, std::size_t most) {
  assert(series.x.size() == series.y.size() && most >= 4);
  const std::size_t count = series.x.size();
  if (count <= most) return series;
  PlotSeries result{series.name, {}, {}};
  append_point(series, 0, result);
  const std::size_t stretches = (most - 2) / 2;
  const std::size_t inner = count - 2;
  for (std::size_t i = 0; i < stretches; ++i) {
    append_extremes(series, 1 + inner * i / stretches, 1 + inner * (i + 1) / stretches, result);
  }
  append_point(series, count - 1, result);
  return result;
}

}  // namespace glissade::apps
