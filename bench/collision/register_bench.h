#pragma once

/// What all benches of collisions need of Google Benchmark.

#include <string>
#include <utility>

#include <benchmark/benchmark.h>

#include "kernels/instruction_set.h"
#include "seconds_each.h"

namespace glissade::bench {

/// Registers a benchmark named BENCH/CASE/SUBJECT. It begins with the best instruction set in use, whatever the one
/// before it has used.
template <typename Run>
benchmark::internal::Benchmark* register_bench(const std::string& name, Run run) {
  return benchmark::RegisterBenchmark(name.c_str(),
                                      [run = std::move(run)](benchmark::State& state) {
                                        collision::use_instruction_set(collision::available_instruction_sets().front());
                                        run(state);
                                      })
      ->Unit(benchmark::kMillisecond);
}

}  // namespace glissade::bench
