/// The benchmarks of sliding contact.

#include "benches.h"

int main(int argc, char** argv) {
  using namespace glissade::bench;
  constexpr const char* kDescription =
      "Measure sliding contact beside the method of the founding paper (glissade-paper).\n"
      "\n"
      "  sliding    a part that follows a ghost in each scene; open-sheets, which must not cross; pegs, which enter\n"
      "             holes with 52 um of clearance; nut-turns on a bolt; solver, the projection on up to 64 contacts\n"
      "  led        meshes of --mesh, two copies and --pairs: one is led through the other at 0.5 m/s";
  return run_bench_program(argc, argv, kDescription, [](const BenchOptions& options) {
    for (const auto& register_bench :
         {register_scenes, register_sheets, register_pegs, register_nut, register_solver, register_led})
      register_bench(options);
  });
}
