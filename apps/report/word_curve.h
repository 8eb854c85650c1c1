#pragma once

/// What something is over time, as a line of a plot of words.

#include <cstddef>
#include <string>
#include <utility>

#include <glissade/apps/report/plot.h>

namespace glissade::apps {

/// Keeps the changes of the word.
class WordCurve {
 public:
  explicit WordCurve(std::string name) : changes_{std::move(name), {}, {}} {}

  /// The word with this number holds at `time`, which rises from call to call, and up to the next call.
  void add(double time, std::size_t word);
  /// The number of each word from where it begins, and of the last one at the end. If there are more than `most`
  /// changes: of each of so many equal stretches of time, the word that holds for the longest in it.
  PlotSeries series(std::size_t most = 1500) const;

 private:
  std::size_t longest_between(double begin, double end, std::size_t& first) const;

  PlotSeries changes_;
  double end_ = 0.0;
};

}  // namespace glissade::apps
