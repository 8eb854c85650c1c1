/// The benchmarks of sliding contact: parses, runs what was asked for, writes results.csv.

#include <cstdio>
#include <exception>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "benches.h"

namespace {

using namespace glissade::bench;

constexpr int kFailed = 1;
constexpr int kBadInput = 2;

constexpr const char* kDescription =
    "Measures sliding contact: Glissade's method beside the founding paper's own (glissade-paper).\n"
    "\n"
    "  scenes   a part led through each scene: how far it lags, jams, force jumps, collisions, queries, times\n"
    "  sheets   thin sheets led through thin sheets at up to 5 m/s\n"
    "  pegs     pegs led into holes with 52 um of clearance, off by 0.3 mm and 0.5 degrees, or by 1 mm and 1.5\n"
    "  nut      a nut turned ten times on its bolt by a ghost that does not move along it\n"
    "  solver   the projection on up to 64 contacts\n"
    "\n"
    "Progress goes to standard error, the figures to results.csv, whose columns are\n"
    "bench,case,subject,metric,value,unit.";

constexpr const char* kFooter =
    "Examples:\n"
    "  haptics_bench --quick --out /tmp\n"
    "  haptics_bench --parts scenes --scenes plane,corner\n"
    "scripts/bench --only sliding builds and runs this and renews docs/benchmarks.md.\n"
    "Exit code: 0 when done, 1 when a run failed, 2 when the usage is wrong.";

using Part = void (*)(const SlidingBenchOptions&, Results&);
const std::vector<std::pair<std::string, Part>> kParts{
    {"scenes", run_scenes}, {"sheets", run_sheets}, {"pegs", run_pegs}, {"nut", run_nut}, {"solver", run_solver}};

int fail(int exit_code, const std::string& message) {
  std::fprintf(stderr, "haptics_bench: %s\n", message.c_str());
  return exit_code;
}

int parse_and_run(int argc, char** argv) {
  SlidingBenchOptions options;
  std::set<std::string> chosen;
  std::filesystem::path folder = ".";
  CLI::App app{kDescription, "haptics_bench"};
  app.footer(kFooter);
  std::vector<std::string> names;
  for (const auto& [name, run] : kParts)
    names.push_back(name);
  app.add_option("--parts", chosen, "Run only these, separated by commas")->delimiter(',')->check(CLI::IsMember(names));
  app.add_option("--scenes", options.scenes, "Only these scenes, separated by commas")->delimiter(',');
  app.add_flag("--quick", options.quick, "Shorter runs, fewer trials: within two minutes");
  app.add_option("--out", folder, "Folder for results.csv, made if need be")->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    return fail(kBadInput, error.what());
  }
  std::filesystem::create_directories(folder);
  Results results;
  for (const auto& [name, run] : kParts) {
    if (!chosen.empty() && !chosen.contains(name)) continue;
    run(options, results);
    results.write_csv(folder / "results.csv");  // after each: a run that is stopped has not been for nothing
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return parse_and_run(argc, argv);
  } catch (const std::invalid_argument& error) {
    return fail(kBadInput, error.what());
  } catch (const std::exception& error) {
    return fail(kFailed, error.what());
  }
}
