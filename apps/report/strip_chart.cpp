#include <algorithm>
#include <map>

#include <glissade/apps/report/strip_chart.h>

namespace glissade::apps {

void Strip::add(double begin, std::size_t word) {
  if (!spans.empty()) {
    spans.back().end = begin;
    if (spans.back().word == word) return;
  }
  spans.push_back({begin, begin, word});
}

void Strip::end_at(double end) {
  if (!spans.empty()) spans.back().end = end;
}

Strip coarsened(const Strip& strip, std::size_t most) {
  if (strip.spans.size() <= most) return strip;
  const double first = strip.spans.front().begin;
  const double step = (strip.spans.back().end - first) / static_cast<double>(most);
  Strip result{strip.name, {}};
  auto span = strip.spans.begin();
  for (std::size_t i = 0; i < most; ++i) {
    const double begin = first + static_cast<double>(i) * step;
    const double end = i + 1 < most ? begin + step : strip.spans.back().end;
    std::map<std::size_t, double> durations;  // by word
    while (std::next(span) != strip.spans.end() && span->end <= begin)
      ++span;
    for (auto inside = span; inside != strip.spans.end() && inside->begin < end; ++inside)
      durations[inside->word] += std::min(inside->end, end) - std::max(inside->begin, begin);
    const auto longest = std::max_element(durations.begin(), durations.end(),
                                          [](const auto& a, const auto& b) { return a.second < b.second; });
    result.add(begin, longest->first);
  }
  result.end_at(strip.spans.back().end);
  return result;
}

}  // namespace glissade::apps
