#include "interleaved_passes.h"

#include <algorithm>
#include <chrono>

namespace glissade::bench {
namespace {

using Clock = std::chrono::steady_clock;
using Eigen::Isometry3d;
using Parts = std::span<const std::vector<Isometry3d>>;

constexpr double kWarmUp_ns = 2e6;

double ns_since(Clock::time_point start) {
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

void ask(Query& query, const Isometry3d& X_AB, Operation operation) {
  if (operation == Operation::kIntersects) {
    query.intersects(X_AB);
  } else if (operation == Operation::kCountPairs) {
    query.count_pairs(X_AB);
  } else {
    query.distance(X_AB);
  }
}

// The previous subject has filled the caches with its own model.
void warm_up(Query& query, Parts parts, Operation operation) {
  const Clock::time_point start = Clock::now();
  query.start();
  for (const std::vector<Isometry3d>& poses : parts) {
    for (const Isometry3d& X_AB : poses) {
      ask(query, X_AB, operation);
      if (ns_since(start) > kWarmUp_ns) return;
    }
  }
}

// Total time of each part.
std::vector<double> pass(Query& query, Parts parts, Operation operation) {
  query.start();
  std::vector<double> times;
  times.reserve(parts.size());
  for (const std::vector<Isometry3d>& poses : parts) {
    const Clock::time_point start = Clock::now();
    for (const Isometry3d& X_AB : poses)
      ask(query, X_AB, operation);
    times.push_back(ns_since(start));
  }
  return times;
}

// Times of one subject, pass by pass.
class Log {
 public:
  void add(const std::vector<double>& part_times, Parts parts) {
    part_ns_.resize(parts.size());
    double total = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      total += part_times[i];
      count += parts[i].size();
      part_ns_[i].push_back(part_times[i] / static_cast<double>(parts[i].size()));
    }
    all_ns_.push_back(total / static_cast<double>(count));
    spent_s_ += 1e-9 * total;
  }

  bool wants_more(const PassLimits& limits, bool slow) const {
    const int passes = static_cast<int>(all_ns_.size());
    return passes < (slow ? 1 : limits.least) || (passes < limits.most && spent_s_ < limits.seconds);
  }

  PassTimes medians() const {
    PassTimes times{median(all_ns_), {}};
    for (const std::vector<double>& part : part_ns_)
      times.part_ns.push_back(median(part));
    return times;
  }

 private:
  std::vector<double> all_ns_;
  std::vector<std::vector<double>> part_ns_;
  double spent_s_ = 0.0;
};

}  // namespace

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

Parts parts_for(const Contestant& contestant, const PoseParts& poses) {
  return {poses.data(), contestant.slow ? 1 : poses.size()};
}

std::vector<PassTimes> interleaved_passes(std::span<const Contestant> contestants, const PoseParts& poses,
                                          Operation operation, const PassLimits& limits) {
  for (const Contestant& contestant : contestants) {
    if (!contestant.slow) pass(*contestant.query, poses, operation);
  }
  std::vector<Log> logs(contestants.size());
  for (bool more = true; more;) {
    more = false;
    for (std::size_t i = 0; i < contestants.size(); ++i) {
      if (!logs[i].wants_more(limits, contestants[i].slow)) continue;
      const Parts parts = parts_for(contestants[i], poses);
      warm_up(*contestants[i].query, parts, operation);
      logs[i].add(pass(*contestants[i].query, parts, operation), parts);
      more = true;
    }
  }
  std::vector<PassTimes> times;
  for (const Log& log : logs)
    times.push_back(log.medians());
  return times;
}

}  // namespace glissade::bench
