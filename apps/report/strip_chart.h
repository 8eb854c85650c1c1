#pragma once

/// What something is over time, as coloured strips: one below the other, each colour a word.

#include <cstddef>
#include <string>
#include <vector>

namespace glissade::apps {

/// A stretch in which a word holds, by its number.
struct StripSpan {
  double begin;
  double end;
  std::size_t word;
};

/// Spans follow one another without gaps.
struct Strip {
  std::string name;
  std::vector<StripSpan> spans;

  /// From `begin` on, which rises from call to call, the word holds; the one before held up to there.
  void add(double begin, std::size_t word);
  /// The last word holds up to here.
  void end_at(double end);
};

/// Over seconds.
struct StripChart {
  std::string title;
  std::vector<std::string> words;  ///< by number
  std::vector<Strip> strips;
};

/// At most `most` spans: of each of so many equal stretches of time, the word that holds for the longest in it.
Strip coarsened(const Strip& strip, std::size_t most);

}  // namespace glissade::apps
