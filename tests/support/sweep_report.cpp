#include "sweep_report.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include <glissade/collision/instruction_set.h>

#include "sanitizers.h"
#include "sweep_variants.h"

namespace glissade::test_support {

int run_sweep(int argc, char** argv, const std::string& description, const std::string& unit,
              std::int64_t default_count, bool (*sweep)(const SweepArguments&)) {
  SweepArguments arguments;
  arguments.count = default_count;
  CLI::App app{description};
  app.add_option("--" + unit, arguments.count, "How many " + unit + " to try; a twentieth under a sanitizer")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--seconds", arguments.seconds, "Stop after so long, if earlier")->check(CLI::PositiveNumber);
  app.add_option("--seed", arguments.seed, "Seed of everything random")->capture_default_str();
  app.add_option("--only-instruction-set", arguments.only_instruction_set, "scalar, sse4, avx2, avx512 or neon");
  app.add_option("--only-case", arguments.only_case, "Repeat the one case that a difference names")
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

}  // namespace glissade::test_support
