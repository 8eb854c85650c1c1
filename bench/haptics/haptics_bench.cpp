/// The benchmarks of the haptic loop and of sliding contact.

#include "benches.h"

int main(int argc, char** argv) {
  using namespace glissade::bench;
  constexpr const char* kDescription =
      "Measure the haptic loop, and sliding contact beside the method of the founding paper (glissade-paper).\n"
      "\n"
      "  tick       the time of a tick of the haptic thread, and its force when the simulation's answers are old\n"
      "  sliding    a part that follows a ghost in each scene; open-sheets, which must not cross; pegs, which enter\n"
      "             holes with 52 um of clearance; nut-turns on a bolt; solver, the projection on up to 64 contacts\n"
      "  passivity  from which stiffness a device oscillates, by theory and in simulation; energy; delays\n"
      "  ages       how old the simulation's answers are in real time, with and without a budget of work\n"
      "  led        meshes of --mesh, two copies and --pairs: one is led through the other at 0.5 m/s\n"
      "  replay     the repetition of a recorded run";
  return run_bench_program(argc, argv, kDescription, [](const BenchOptions& options) {
    for (const auto& register_bench :
         {register_tick, register_old_sets, register_scenes, register_sheets, register_pegs, register_nut,
          register_solver, register_passivity, register_ages, register_led, register_replay})
      register_bench(options);
  });
}
