#pragma once

/// Benchmarks of one iteration: runs.

#include <string>
#include <utility>

#include <benchmark/benchmark.h>

namespace glissade::bench {

/// A benchmark of one iteration, which may take turns with others.
template <typename Run>
benchmark::internal::Benchmark* register_run(const std::string& name, Run run) {
  return benchmark::RegisterBenchmark(name.c_str(), std::move(run))->Iterations(1)->Unit(benchmark::kMillisecond);
}

/// One whose outcome is always the same, or takes long: it runs once, however often others are repeated.
template <typename Run>
benchmark::internal::Benchmark* register_single_run(const std::string& name, Run run) {
  return register_run(name, std::move(run))->Repetitions(1);
}

}  // namespace glissade::bench
