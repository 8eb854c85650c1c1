/// The collision benchmarks: parses, runs the chosen benches, writes results.csv.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "benches.h"
#include "kernels/instruction_set.h"
#include "subject.h"

namespace {

using namespace glissade::bench;

constexpr int kFailed = 1;
constexpr int kBadInput = 2;

constexpr const char* kDescription =
    "Measure Glissade's collision queries beside FCL, ODE, Bullet and CGAL, on the same poses, "
    "in one thread (except\n"
    "for the bench threads).\n"
    "\n"
    "  zachmann   two copies of an object at all distances from 0 to just apart, boolean query\n"
    "  close      two copies of an object 0.1 %, 0.3 % and 1 % of the size apart, boolean query\n"
    "  shells     nested spheres and stacked bumpy plates, parallel and 2 % apart, boolean query\n"
    "  coherent   one part slides along another in steps of 0.01 mm and 0.005 degrees, boolean query\n"
    "  all-pairs  all intersecting pairs of triangles of two overlapping copies of an object\n"
    "  parts      meshes of --mesh, two copies and --pairs: yes or no, all pairs, distances, beside FCL and the method "
    "of PQP\n"
    "  build      time and memory of building\n"
    "  hull       one convex hull turns and goes round another in small steps, boolean query\n"
    "  scene      10 to 1000 objects bounce about in a box: which pairs meet, frame by frame\n"
    "  threads    dense and sparse scenes and all pairs of large meshes, Glissade on 1, 2, 4 and 8 threads\n"
    "\n"
    "Subjects take turns; each turn is a pass over all poses, and times are medians over the passes. Answers are\n"
    "compared, too. Progress goes to standard error, the figures to results.csv with the columns\n"
    "bench,case,subject,metric,value,unit.";

constexpr const char* kFooter =
    "Examples:\n"
    "  collision_bench --quick --only zachmann --out /tmp\n"
    "  collision_bench --only zachmann,close --mesh gear.stl --mesh housing.obj\n"
    "scripts/bench builds and runs this program and renews docs/benchmarks.md.\n"
    "Exit code: 0 on success, 1 if a run fails, 2 for wrong usage or a wrong mesh.";

using Bench = void (*)(const BenchOptions&, Results&);

const std::vector<std::pair<std::string, Bench>>& benches() {
  static const std::vector<std::pair<std::string, Bench>> all{
      {"zachmann", run_zachmann},   {"close", run_close},    {"shells", run_shells}, {"coherent", run_coherent},
      {"all-pairs", run_all_pairs}, {"parts", run_parts},    {"build", run_build},   {"hull", run_hull},
      {"scene", run_scene},         {"threads", run_threads}};
  return all;
}

bool exists(const std::string& name) {
  return std::any_of(benches().begin(), benches().end(), [&](const auto& bench) { return bench.first == name; });
}

int fail(int exit_code, const std::string& message) {
  std::fprintf(stderr, "collision_bench: %s\n", message.c_str());
  return exit_code;
}

void choose_instruction_set_named(const std::string& wanted) {
  std::string names;
  for (const auto set : glissade::collision::available_instruction_sets()) {
    if (glissade::collision::name_of(set) == wanted) return choose_instruction_set(set);
    names += " " + std::string(glissade::collision::name_of(set));
  }
  throw std::invalid_argument("--instruction-set: " + wanted + " is not available; available are" + names);
}

void fill_in_suite(Suite& suite, bool quick) {
  if (suite.shapes.empty()) suite.shapes = all_shapes();
  if (suite.triangles.empty()) {
    suite.triangles = {1'000, 5'000, 20'000, 50'000, 100'000};
    suite.shell_triangles = {100'000};
    suite.coherent_triangles = 50'000;
    suite.hull_vertices = {100, 1'000, 5'000, 20'000};
    suite.scene_triangles = {1'000, 5'000, 20'000, 50'000};
    suite.thread_triangles = {50'000, 200'000};
    if (quick) {
      suite.triangles = {1'000, 20'000};
      suite.shell_triangles = {20'000};
      suite.coherent_triangles = 20'000;
      suite.hull_vertices = {100, 1'000};
      suite.scene_triangles = {1'000, 20'000};
      suite.thread_triangles = {50'000};
    }
  } else {
    suite.shell_triangles = suite.triangles;
    suite.coherent_triangles = suite.triangles.back();
    for (const std::int64_t triangles : suite.triangles)
      suite.hull_vertices.push_back(triangles / 2);
    suite.scene_triangles = suite.triangles;
    suite.thread_triangles = {suite.triangles.back()};
  }
}

void run_all(BenchOptions options) {
  fill_in_suite(options.suite, options.quick);
  for (const std::string& name : options.only) {
    if (!exists(name)) throw std::invalid_argument("--only: unknown bench " + name);
  }
  Results results;
  std::filesystem::create_directories(options.folder);
  for (const auto& [name, run] : benches()) {
    if (!options.only.empty() && !options.only.contains(name)) continue;
    run(options, results);
    results.write_csv(options.folder / "results.csv");  // after each bench: a run that is stopped keeps its results
  }
}

int parse_and_run(int argc, char** argv) {
  BenchOptions options;
  std::string instruction_set;
  CLI::App app{kDescription, "collision_bench"};
  app.footer(kFooter);
  app.add_option("--only", options.only, "Run only these benches, separated by commas")->delimiter(',');
  app.add_flag("--quick", options.quick, "Fewer meshes and poses: each bench within a minute");
  app.add_option("--out", options.folder, "Folder for results.csv, created if necessary")->capture_default_str();
  app.add_option("--mesh", options.suite.files,
                 "Another mesh (OBJ, STL, PLY, glTF), or a folder of OBJ, STL and PLY; may be repeated");
  app.add_option("--pairs", options.suite.pairs, "For parts: a file with the names of two meshes in each line");
  app.add_option("--instruction-set", instruction_set, "Glissade's vector instructions (default: the best available)");
  app.add_option("--seed", options.seed, "Seed of the poses")->capture_default_str();
  app.add_option("--shapes", options.suite.shapes, "Use only these generated shapes, separated by commas")
      ->delimiter(',');
  app.add_option("--triangles", options.suite.triangles, "Use only these numbers of triangles, separated by commas")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    return fail(kBadInput, error.what());
  }
  if (!instruction_set.empty()) choose_instruction_set_named(instruction_set);
  run_all(std::move(options));
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
