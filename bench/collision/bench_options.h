#pragma once

/// The options of the command line.

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>

#include "suite.h"

namespace glissade::bench {

struct BenchOptions {
  std::set<std::string> only;  ///< names of benches; empty: all
  bool quick = false;
  std::filesystem::path folder = ".";  ///< for results.csv
  std::uint64_t seed = 1;
  Suite suite;
};

}  // namespace glissade::bench
