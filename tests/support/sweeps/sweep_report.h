#pragma once

/// Shared by the sweeps: command line, timing, and the record of differences.

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include <oneapi/tbb/parallel_for.h>

#include "kernels/instruction_set.h"

namespace glissade::test_support {

/// The command line of a sweep.
struct SweepArguments {
  std::int64_t count = 0;  ///< poses or frames to try
  double seconds = 1e9;    ///< to stop after, if earlier
  std::uint64_t seed = 1;
  std::string only_instruction_set;
  std::int64_t only_case = -1;  ///< to repeat the case of a difference
};

/// Parses the command line and runs the sweep, which returns whether it found no difference. The result is the
/// exit code: 0, 1 after a difference or failure, 2 after bad usage. `unit` names the counted objects ("poses").
int run_sweep(int argc, char** argv, const std::string& description, const std::string& unit,
              std::int64_t default_count, bool (*sweep)(const SweepArguments&));

/// Counts and describes differences. Thread-safe.
class SweepDifferences {
 public:
  void add(const std::string& description);

  std::int64_t count() const { return count_; }

  /// Prints the first few differences and their total number.
  void print() const;

 private:
  static constexpr std::size_t kPrinted = 10;
  std::mutex mutex_;
  std::int64_t count_ = 0;
  std::vector<std::string> descriptions_;
};

/// Numbers of comparisons, by family of poses, and by variant and instruction set. Thread-safe.
class SweepCounts {
 public:
  explicit SweepCounts(const std::vector<collision::InstructionSet>& sets) : sets_(sets) {}

  void add_pose(std::size_t family, std::size_t pairs);
  void add_check(std::size_t variant, std::size_t set) { ++checks_[variant][set]; }
  void print(double seconds) const;

 private:
  static constexpr std::size_t kMost = 32;
  using Counters = std::array<std::atomic<std::int64_t>, kMost>;

  std::vector<collision::InstructionSet> sets_;
  Counters poses_{};  ///< by family
  Counters hits_{};   ///< with any pair
  Counters pairs_{};
  std::array<Counters, kMost> checks_{};  ///< by variant and instruction set
};

/// Calls run_batch(first case, number of cases) for the number of poses in `arguments`, or for the one case; stops when
/// the time is up.
template <typename RunBatch>
void run_batches(const SweepArguments& arguments, int poses_per_case, int cases_per_batch, const RunBatch& run_batch);

/// One batch on all processors: make(index) → Case for each, with the instruction set whose turn it is, then
/// check(case, place of the instruction set) for each with every instruction set. Returns the cases.
template <typename Make, typename Check>
auto run_cases(const std::vector<collision::InstructionSet>& sets, std::int64_t turn, std::int64_t first, int count,
               const Make& make, const Check& check);

/// Runs from its construction on.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

template <typename RunBatch>
void run_batches(const SweepArguments& arguments, int poses_per_case, int cases_per_batch, const RunBatch& run_batch) {
  if (arguments.only_case >= 0) {
    run_batch(arguments.only_case, 1);
    return;
  }
  const std::int64_t wanted = (arguments.count + poses_per_case - 1) / poses_per_case;
  const Stopwatch watch;
  for (std::int64_t first = 0; first < wanted && watch.seconds() < arguments.seconds; first += cases_per_batch)
    run_batch(first, static_cast<int>(std::min<std::int64_t>(cases_per_batch, wanted - first)));
}

template <typename Make, typename Check>
auto run_cases(const std::vector<collision::InstructionSet>& sets, std::int64_t turn, std::int64_t first, int count,
               const Make& make, const Check& check) {
  std::vector<decltype(make(first))> cases(static_cast<std::size_t>(count));
  collision::use_instruction_set(sets[static_cast<std::size_t>(turn) % sets.size()]);
  tbb::parallel_for(std::size_t{0}, cases.size(),
                    [&](std::size_t i) { cases[i] = make(first + static_cast<std::int64_t>(i)); });
  for (std::size_t set = 0; set < sets.size(); ++set) {
    collision::use_instruction_set(sets[set]);
    tbb::parallel_for(std::size_t{0}, cases.size(), [&](std::size_t i) { check(cases[i], set); });
  }
  return cases;
}

}  // namespace glissade::test_support
