// Torture test of sliding contact: random scenes of soups, sheets, slivers and needles from 1 mm to 5 m, or of machine
// elements that fit each other, and random hands up to 5 m/s that jump, press, turn and let go. Every visible pose, and
// every known path between two of them, is checked by code independent of the simulation. The printed hash depends only
// on the seed, the number of scenes and the milliseconds. With --again all scenes run a second time on another number
// of threads, each with a search thread of its own, and the hash must be the same.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "sanitizers.h"
#include "sweeps/torture_run.h"

namespace glissade::test_support {
namespace {

struct Arguments {
  std::int64_t scenes = 1000;
  int milliseconds = 1000;
  std::uint64_t seed = 1;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::int64_t only_scene = -1;
  bool again = false;
  bool off_centre = false;
  bool fits = false;
  bool quiet = false;
  std::string csv;
};

/// The threads of a run. No result may depend on them.
struct Threads {
  int scenes;               ///< threads that run scenes
  bool has_search = false;  ///< each simulation has a search thread
};

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// An exception is a fault of the scene.
TortureCounts run_one(const Arguments& arguments, std::int64_t index, const Threads& threads) {
  try {
    return run_torture_scene(arguments.seed, index, arguments.milliseconds,
                             {threads.has_search, arguments.off_centre, arguments.fits});
  } catch (const std::exception& error) {
    TortureCounts counts;
    counts.fault_count = 1;
    counts.faults.push_back(std::string(error.what()) + "\n  --seed " + std::to_string(arguments.seed) +
                            " --only-scene " + std::to_string(index));
    return counts;
  }
}

long long count(std::int64_t number) {
  return static_cast<long long>(number);
}

// Jams occur in few scenes.
void print_most_jammed(const std::vector<TortureCounts>& counts) {
  constexpr std::size_t kPrinted = 8;
  std::vector<std::pair<std::int64_t, std::size_t>> jams;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::int64_t ticks = counts[i].jammed + counts[i].jammed_near;
    if (ticks > 0) jams.emplace_back(-ticks, i);
  }
  std::sort(jams.begin(), jams.end());
  if (!jams.empty()) std::printf("jammed in %zu scenes:", jams.size());
  for (std::size_t i = 0; i < std::min(kPrinted, jams.size()); ++i)
    std::printf(" %lld ticks in scene %zu", count(-jams[i].first), jams[i].second);
  if (!jams.empty()) std::printf("\n");
}

// Each scene runs on the next free thread; the counts are added in the order of the scenes.
TortureCounts run_all(const Arguments& arguments, const Threads& threads) {
  if (arguments.only_scene >= 0) return run_one(arguments, arguments.only_scene, threads);
  const auto scenes = static_cast<std::size_t>(arguments.scenes);
  std::vector<TortureCounts> counts(scenes);
  std::atomic<std::size_t> next = 0;
  std::atomic<std::size_t> done = 0;
  const Stopwatch watch;
  const auto work = [&] {
    for (std::size_t i = next++; i < scenes; i = next++) {
      counts[i] = run_one(arguments, static_cast<std::int64_t>(i), threads);
      const std::size_t finished = ++done;
      if (!arguments.quiet && (finished % 100 == 0 || finished == scenes))
        std::fprintf(stderr, "\r%zu of %zu scenes, %.0f s", finished, scenes, watch.seconds());
    }
  };
  std::vector<std::thread> pool;
  for (int i = 0; i < threads.scenes; ++i)
    pool.emplace_back(work);
  for (std::thread& thread : pool)
    thread.join();
  if (!arguments.quiet) std::fprintf(stderr, "\n");
  print_most_jammed(counts);
  TortureCounts sum;
  for (const TortureCounts& scene : counts)
    sum.add(scene);
  return sum;
}

std::string hash_of(const TortureCounts& c) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(c.hash));
  return text;
}

void print(const TortureCounts& c, double seconds) {
  std::printf("%lld scenes, %lld ms in %.1f s: held %lld, pushed by contacts %lld, moved %lld\n", count(c.scenes),
              count(c.ticks), seconds, count(c.held), count(c.pushed), count(c.moved));
  std::printf("visible poses in collision       %lld\n", count(c.collisions));
  std::printf("paths not proved free            %lld of %lld, and of the last steps of %lld more\n",
              count(c.unproved_paths), count(c.paths), count(c.partial_paths));
  std::printf("poses nearer than allowed        %lld, least distance %.4f of the minimum clearance\n",
              count(c.below_min_clearance), c.least_of_min_clearance);
  std::printf("poses or forces not finite       %lld\n", count(c.not_finite));
  const double percent = 100.0 / static_cast<double>(std::max<std::int64_t>(1, c.wanted));
  std::printf("jammed ticks                     %lld of %lld with the target elsewhere (%.4f %%)\n", count(c.jammed),
              count(c.wanted), percent * static_cast<double>(c.jammed));
  std::printf("jammed, nearer than the minimum clearance since the start: %lld\n", count(c.jammed_near));
  std::printf("standing still off balance       %lld (%.4f %%)\n", count(c.unbalanced),
              percent * static_cast<double>(c.unbalanced));
  std::printf("greatest force jump              %.3g kt (0.2 mm + |dG|), under force feedback\n", c.force_jump);
  std::printf("hash                             %s\n", hash_of(c).c_str());
  constexpr std::size_t kPrinted = 10;
  for (std::size_t i = 0; i < std::min(kPrinted, c.faults.size()); ++i)
    std::printf("FAULT: %s\n", c.faults[i].c_str());
  std::printf("%lld faults\n", count(c.fault_count));
  std::fflush(stdout);  // with --again a second run follows
}

/// The figures of `print` as rows of figure, value and unit; `again` is the hash of a second run, if there was one.
void write_csv(const std::string& path, const TortureCounts& c, const std::string& again) {
  std::ofstream file(path);
  file.precision(9);
  const auto row = [&](const char* figure, auto value, const char* unit) {
    file << figure << ',' << value << ',' << unit << '\n';
  };
  row("scenes", c.scenes, "1");
  row("milliseconds", c.ticks, "1");
  row("collisions", c.collisions, "1");
  row("paths", c.paths, "1");
  row("last_steps", c.partial_paths, "1");
  row("unproved_paths", c.unproved_paths, "1");
  row("below_min_clearance", c.below_min_clearance, "1");
  row("least_of_min_clearance", c.least_of_min_clearance, "x");
  row("not_finite", c.not_finite, "1");
  row("wanted_elsewhere", c.wanted, "1");
  row("jammed", c.jammed, "1");
  row("off_balance", c.unbalanced, "1");
  row("greatest_force_jump", c.force_jump, "x");
  row("hash", hash_of(c).c_str(), "hex");
  if (!again.empty()) row("hash_again", again.c_str(), "hex");
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

/// Promises about many scenes together: few ticks jam, and no force jumps.
bool keeps_promises(const TortureCounts& counts) {
  constexpr double kMostJammed = 1e-3;
  const bool jams = static_cast<double>(counts.jammed) > kMostJammed * static_cast<double>(counts.wanted) + 20.0;
  const bool jumps = counts.force_jump > 1.0 + 1e-6;
  if (jams) std::printf("FAULT: more than %.1f %% of the ticks jam\n", 100.0 * kMostJammed);
  if (jumps) std::printf("FAULT: the force jumps by more than the slew allows\n");
  return !jams && !jumps;
}

bool torture(const Arguments& arguments) {
  const Stopwatch watch;
  const TortureCounts counts = run_all(arguments, {.scenes = arguments.threads});
  print(counts, watch.seconds());
  bool sound = counts.fault_count == 0 && counts.not_finite == 0 && keeps_promises(counts);
  std::string again;
  if (arguments.again) {
    const int threads = arguments.threads == 1 ? 2 : 1;
    const TortureCounts second = run_all(arguments, {.scenes = threads, .has_search = true});
    const bool same = second.hash == counts.hash;
    again = hash_of(second);
    std::printf("again on %d thread%s, each scene with a search thread: hash %s\n", threads, threads == 1 ? "" : "s",
                same ? "the same" : "DIFFERENT");
    sound = sound && same;
  }
  if (!arguments.csv.empty()) write_csv(arguments.csv, counts, again);
  return sound;
}

}  // namespace
}  // namespace glissade::test_support

int main(int argc, char** argv) {
  using namespace glissade::test_support;
  Arguments arguments;
  CLI::App app{"Random scenes and hands for sliding contact, with every visible pose and path checked independently"};
  app.add_option("--scenes", arguments.scenes, "Number of scenes; a twentieth of it under a sanitizer")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--ms", arguments.milliseconds, "Duration of each scene in milliseconds")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--seed", arguments.seed, "Seed of all random choices")->capture_default_str();
  app.add_option("--threads", arguments.threads, "Number of threads that run scenes")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--only-scene", arguments.only_scene, "Run only this scene, as named by a fault")
      ->check(CLI::NonNegativeNumber);
  app.add_flag("--again", arguments.again,
               "Run all scenes again on another number of threads, with search threads, and compare the hashes");
  app.add_flag("--off-centre", arguments.off_centre,
               "Couple each part at a random point, up to two radii from its centre, instead of at its centre");
  app.add_flag("--fits", arguments.fits,
               "Machine elements that fit each other with little play: nuts, gears, pegs, sleeves, balls in sockets");
  app.add_flag("--quiet", arguments.quiet, "No progress");
  app.add_option("--csv", arguments.csv,
                 "Write the figures of the first run, and the hash of the second, to this file: figure,value,unit");
  CLI11_PARSE(app, argc, argv);
  if (kSanitized) arguments.scenes = std::max<std::int64_t>(1, arguments.scenes / 20);
  try {
    return torture(arguments) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sliding_torture: %s\n", error.what());
    return 2;
  }
}
