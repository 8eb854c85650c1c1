/// The benchmarks of the haptic loop.

#include "benches.h"

int main(int argc, char** argv) {
  using namespace glissade::bench;
  constexpr const char* kDescription =
      "Measure the haptic loop.\n"
      "\n"
      "  tick       the time of a tick of the haptic thread, and its force when the simulation's answers are old\n"
      "  passivity  from which stiffness a device oscillates, by theory and in simulation; energy; delays\n"
      "  ages       how old the simulation's answers are in real time, with and without a budget of work\n"
      "  replay     the repetition of a recorded run";
  return run_bench_program(argc, argv, kDescription, [](const BenchOptions& options) {
    for (const auto& register_bench :
         {register_tick, register_old_sets, register_passivity, register_ages, register_replay})
      register_bench(options);
  });
}
