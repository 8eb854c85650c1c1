#include "bench_program.h"

#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>
#include <benchmark/benchmark.h>

namespace glissade::bench {
namespace {

constexpr int kFailed = 1;
constexpr int kBadInput = 2;

constexpr const char* kFooter =
    "All options of Google Benchmark work, too:\n"
    "  --benchmark_filter=REGEX  only the benchmarks whose names match; names are BENCH/CASE/SUBJECT\n"
    "  --benchmark_list_tests  --benchmark_repetitions=N  --benchmark_enable_random_interleaving\n"
    "  --benchmark_out=FILE --benchmark_out_format=json  --benchmark_min_time=S\n"
    "scripts/bench builds and runs the benchmark programs. Exit code: 0 on success, 1 if a run fails, 2 for wrong "
    "usage.";

int parse_and_run(int argc, char** argv, const char* description, const RegisterBenches& register_benches) {
  BenchOptions options;
  CLI::App app{description, std::filesystem::path(argv[0]).filename().string()};
  app.footer(kFooter);
  app.allow_extras();
  app.add_flag("--quick", options.quick, "Fewer meshes, poses and trials");
  app.add_option("--mesh", options.meshes,
                 "A mesh of yours (OBJ, STL, PLY, glTF), or a folder of OBJ, STL and PLY; may be repeated")
      ->check(CLI::ExistingPath);
  app.add_option("--pairs", options.pairs,
                 "Pairs of these meshes, two names a line; metres per unit and a start of the second may follow")
      ->check(CLI::ExistingFile);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    throw std::invalid_argument(error.what());
  }
  // Unless the user wants another: repetitions take turns, so each may be short.
  std::string min_time = options.quick ? "--benchmark_min_time=0.01" : "--benchmark_min_time=0.05";
  std::vector<std::string> others = app.remaining();
  std::vector<char*> arguments{argv[0], min_time.data()};
  for (std::string& other : others)
    arguments.push_back(other.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (count > 1) throw std::invalid_argument("unknown option " + std::string(arguments[1]));
  register_benches(options);
  if (benchmark::RunSpecifiedBenchmarks() == 0) throw std::invalid_argument("no benchmark matches the filter");
  benchmark::Shutdown();
  return 0;
}

}  // namespace

int run_bench_program(int argc, char** argv, const char* description, const RegisterBenches& register_benches) {
  const auto fail = [&](int exit_code, const char* message) {
    std::fprintf(stderr, "%s: %s\n", argv[0], message);
    return exit_code;
  };
  try {
    return parse_and_run(argc, argv, description, register_benches);
  } catch (const std::invalid_argument& error) {
    return fail(kBadInput, error.what());
  } catch (const std::exception& error) {
    return fail(kFailed, error.what());
  }
}

}  // namespace glissade::bench
