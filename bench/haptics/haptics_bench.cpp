/// The benchmarks of sliding contact: parses, runs the chosen parts, writes results.csv.

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
    "Measure sliding contact: Glissade's method beside that of the founding paper (glissade-paper).\n"
    "\n"
    "  scenes   a part that follows a ghost in each scene: lag, jams, force jumps, collisions, queries, times\n"
    "  sheets   thin sheets whose ghosts pass through thin sheets at up to 5 m/s\n"
    "  pegs     pegs that enter holes with 52 um of clearance, off by 0.3 mm and 0.5 degrees, or by 1 mm and 1.5\n"
    "  nut      a nut that turns ten times on its bolt, by a ghost that does not move along it\n"
    "  solver   the projection on up to 64 contacts\n"
    "  tick     the force on the hand when the simulation's answers are old, and the time of a tick\n"
    "  passivity  from which stiffness a device oscillates, by theory and in simulation; energy; delays\n"
    "  ages     how old the simulation's answers are in real time, with and without a budget of work\n"
    "  clasp    a hand that closes round a ball, and two hands among 100 objects\n"
    "  led      meshes of --mesh, two copies and --pairs: one is led through the other at 0.5 m/s\n"
    "\n"
    "Progress goes to standard error, the figures to results.csv with the columns\n"
    "bench,case,subject,metric,value,unit.";

constexpr const char* kFooter =
    "Examples:\n"
    "  haptics_bench --quick --out /tmp\n"
    "  haptics_bench --parts scenes --scenes plane,corner\n"
    "scripts/bench --only sliding builds and runs this program and renews docs/benchmarks.md.\n"
    "Exit code: 0 on success, 1 if a run fails, 2 for wrong usage.";

using Part = void (*)(const SlidingBenchOptions&, Results&);
const std::vector<std::pair<std::string, Part>> kParts{
    {"scenes", run_scenes}, {"sheets", run_sheets}, {"pegs", run_pegs},           {"nut", run_nut},
    {"solver", run_solver}, {"tick", run_tick},     {"passivity", run_passivity}, {"ages", run_ages},
    {"clasp", run_clasp},   {"led", run_led}};

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
  app.add_option("--parts", chosen, "Run only these parts, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(names));
  app.add_option("--scenes", options.scenes, "Run only these scenes, separated by commas")->delimiter(',');
  app.add_option("--scene-files", options.scene_files,
                 "More scenes for the part tick: scene files (YAML) with one movable object and a script")
      ->delimiter(',');
  app.add_option("--meshes", options.meshes,
                 "Folder with more meshes for the part ages: koala/koala.obj, scallop/scallop.ply,\n"
                 "ycb_power_drill/, drivaer_body/, industreal_gear_small/ and industreal_gear_base/ likewise");
  app.add_option("--mesh", options.led_meshes,
                 "For the part led: a mesh (OBJ, STL, PLY, glTF), or a folder of OBJ, STL and PLY; may be repeated");
  app.add_option(
      "--pairs", options.led_pairs,
      "For the part led: a file with two names of these meshes in each line, and, for a start at true size,\n"
      "metres per unit and the place of the second in the frame of the first, in units");
  app.add_flag("--quick", options.quick, "Shorter runs, fewer trials: within two minutes");
  app.add_option("--out", folder, "Folder for results.csv, created if necessary")->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    return fail(kBadInput, error.what());
  }
  if (chosen.contains("led") && options.led_meshes.empty()) return fail(kBadInput, "the part led needs --mesh");
  std::filesystem::create_directories(folder);
  Results results;
  for (const auto& [name, run] : kParts) {
    if (!chosen.empty() && !chosen.contains(name)) continue;
    run(options, results);
    results.write_csv(folder / "results.csv");  // after each part: a run that is stopped keeps its results
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
