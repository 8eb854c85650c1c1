#pragma once

/// The timing of all benchmarks. A pass goes over all poses with one subject. Subjects take turns, pass by pass, so
/// that a slow moment of the machine affects all of them alike. The first round does not count, nor do the first two
/// milliseconds of each turn, which warm the caches. Reported times are medians over passes.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "subject.h"

namespace glissade::bench {

enum class Operation { kIntersects, kCountPairs, kDistance };

/// Poses in order. Each part is also timed by itself, in the same pass. Slow subjects take the first part only.
using PoseParts = std::vector<std::vector<Eigen::Isometry3d>>;

struct PassLimits {
  int least = 3;          ///< passes of every subject, however long they take; one for slow subjects
  int most = 101;         ///< passes of a fast one
  double seconds = 0.25;  ///< after which a subject stops that has made `least` passes
};

struct Contestant {
  Query* query;
  bool slow;
};

/// Mean time of a query in nanoseconds: median over passes.
struct PassTimes {
  double all_ns = 0.0;
  std::vector<double> part_ns;  ///< for a slow subject the first part only
};

/// One entry for each contestant, in order. Slow ones have no warming round: they have just given their answers.
std::vector<PassTimes> interleaved_passes(std::span<const Contestant> contestants, const PoseParts& poses,
                                          Operation operation, const PassLimits& limits);

/// The parts that a subject takes.
std::span<const std::vector<Eigen::Isometry3d>> parts_for(const Contestant& contestant, const PoseParts& poses);

double median(std::vector<double> values);

}  // namespace glissade::bench
