#pragma once

/// A benchmark program: its options beside Google Benchmark's, and what its benchmarks share.

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace glissade::bench {

struct BenchOptions {
  bool quick = false;                         ///< fewer meshes, poses and trials
  std::vector<std::filesystem::path> meshes;  ///< meshes of the user; a folder stands for all meshes in it
  std::filesystem::path pairs;                ///< a file for `user_pairs`, of these meshes; or empty
};

/// Registers benchmarks with Google Benchmark, named BENCH/CASE/SUBJECT. Does no work: what a benchmark measures is
/// made when it first runs (`Lazy`), because `--benchmark_filter` leaves out most. Throws std::invalid_argument for an
/// option that cannot be used.
using RegisterBenches = std::function<void(const BenchOptions&)>;

/// The main function of a benchmark program. `description` says what its benches measure. Exit code: 0 on success, 1 if
/// a run fails, 2 for wrong usage.
int run_bench_program(int argc, char** argv, const char* description, const RegisterBenches& register_benches);

/// What several benchmarks share, made when the first of them asks for it. Not thread-safe.
template <typename Value>
class Lazy {
 public:
  explicit Lazy(std::function<Value()> make) : make_(std::move(make)) {}

  Value& operator*() {
    if (!value_) value_.emplace(make_());
    return *value_;
  }
  Value* operator->() { return &**this; }

 private:
  std::function<Value()> make_;
  std::optional<Value> value_;
};

template <typename Make>
auto lazy(Make make) {
  return std::make_shared<Lazy<decltype(make())>>(std::move(make));
}

}  // namespace glissade::bench
