#include "sweeps/sweep_report.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "sanitizers.h"
#include "sweeps/sweep_poses.h"
#include "sweeps/sweep_variants.h"

namespace glissade::test_support {

int run_sweep(int argc, char** argv, const std::string& description, const std::string& unit,
              std::int64_t default_count, bool (*sweep)(const SweepArguments&)) {
  SweepArguments arguments;
  arguments.count = default_count;
  CLI::App app{description};
  app.add_option("--" + unit, arguments.count, "Number of " + unit + " to try; a twentieth of it under a sanitizer")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--seconds", arguments.seconds, "Stop after this time, in seconds")->check(CLI::PositiveNumber);
  app.add_option("--seed", arguments.seed, "Seed of all random choices")->capture_default_str();
  app.add_option("--only-instruction-set", arguments.only_instruction_set, "scalar, sse4, avx2, avx512 or neon");
  app.add_option("--only-case", arguments.only_case, "Run only this case, as named by a difference")
      ->check(CLI::NonNegativeNumber);
  try {
    app.parse(argc, argv);
    instruction_sets(arguments.only_instruction_set);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "--only-instruction-set: %s\n", error.what());
    return 2;
  }
  arguments.count = kSanitized ? std::max<std::int64_t>(1, arguments.count / 20) : arguments.count;
  try {
    std::printf("seed %llu\n", static_cast<unsigned long long>(arguments.seed));
    return sweep(arguments) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

void SweepDifferences::add(const std::string& description) {
  const std::lock_guard lock(mutex_);
  ++count_;
  if (descriptions_.size() < kPrinted) descriptions_.push_back(description);
}

void SweepDifferences::print() const {
  for (const std::string& description : descriptions_)
    std::printf("DIFFERENCE: %s\n", description.c_str());
  std::printf("%lld differences\n", static_cast<long long>(count_));
}

void SweepCounts::add_pose(std::size_t family, std::size_t pairs) {
  ++poses_[family];
  hits_[family] += pairs == 0 ? 0 : 1;
  pairs_[family] += static_cast<std::int64_t>(pairs);
}

void SweepCounts::print(double seconds) const {
  std::printf("%-20s %10s %10s %14s\n", "family", "poses", "hits", "pairs");
  std::int64_t total = 0;
  for (std::size_t f = 0; f < sweep_families().size(); ++f) {
    std::printf("%-20s %10lld %10lld %14lld\n", family_name(sweep_families()[f]).c_str(),
                static_cast<long long>(poses_[f]), static_cast<long long>(hits_[f]), static_cast<long long>(pairs_[f]));
    total += poses_[f];
  }
  std::printf("\n%-30s", "poses checked");
  for (const collision::InstructionSet set : sets_)
    std::printf(" %10s", std::string(collision::name_of(set)).c_str());
  std::printf("\n");
  const std::vector<collision::DopTreeOptions> variants = all_tree_options();
  for (std::size_t v = 0; v < variants.size(); ++v) {
    std::printf("%-30s", variant_name(variants[v]).c_str());
    for (std::size_t s = 0; s < sets_.size(); ++s)
      std::printf(" %10lld", static_cast<long long>(checks_[v][s]));
    std::printf("\n");
  }
  std::printf("\n%lld poses in %.1f s\n", static_cast<long long>(total), seconds);
}

}  // namespace glissade::test_support
