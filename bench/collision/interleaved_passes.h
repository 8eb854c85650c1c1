#pragma once

/// The clock of all benchmarks: a pass goes over all poses with one subject; subjects take turns, pass by pass, so that
/// a slow moment of the machine hits all of them alike. The first round, which warms the caches, does not count. What
/// is reported are medians over passes.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "subject.h"

namespace glissade::bench {

enum class Operation { kIntersects, kCountPairs };

/// Poses one after the other; parts are timed apart as well, in the same pass.
using PoseParts = std::vector<std::vector<Eigen::Isometry3d>>;

struct PassLimits {
  int least = 3;          ///< passes of every subject, however slow
  int most = 31;          ///< passes of a fast one
  double seconds = 0.25;  ///< after which a subject that has made its least passes stops
};

/// Mean time of a query in nanoseconds: median over passes.
struct PassTimes {
  double all_ns = 0.0;
  std::vector<double> part_ns;
};

/// One entry for each query, in order.
std::vector<PassTimes> interleaved_passes(std::span<Query* const> queries, const PoseParts& poses, Operation operation,
                                          const PassLimits& limits);

double median(std::vector<double> values);

}  // namespace glissade::bench
