#pragma once

#include <concepts>

#include <benchmark/benchmark.h>

namespace glissade::bench {

/// A counter: seconds for each of the `count` parts of an iteration.
template <std::integral Count>
benchmark::Counter seconds_each(Count count) {
  using benchmark::Counter;
  return {static_cast<double>(count),
          static_cast<Counter::Flags>(Counter::kIsIterationInvariantRate | Counter::kInvert)};
}

}  // namespace glissade::bench
