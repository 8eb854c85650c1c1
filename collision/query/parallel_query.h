#pragma once

/// Queries for all triangle pairs by several threads, for objects that meet in so many triangles that one thread would
/// take long (paper §2.3, fine grain). A query begins in the calling thread alone. It divides the rest only once it has
/// done enough work to make waking other threads worthwhile.

#include <memory>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/query_types.h>

namespace glissade::collision {

/// Scratch memory and counters of such queries. Keep one for each query in progress and reuse it. Not thread-safe.
class ParallelWorkspace {
 public:
  ParallelWorkspace();
  ~ParallelWorkspace();
  ParallelWorkspace(ParallelWorkspace&&) noexcept;
  ParallelWorkspace& operator=(ParallelWorkspace&&) noexcept;

  /// Work of the last query, summed over all threads; independent of their number.
  const QueryCounters& counters() const;
  /// Number of pieces of the last query that other threads could take; 0 if the calling thread did everything.
  int pieces() const;

  struct Memory;
  Memory& memory() { return *memory_; }

 private:
  std::unique_ptr<Memory> memory_;
};

/// As in `dop_query.h`: the same pairs in the same order for any number of threads. Runs on the threads of the oneTBB
/// arena of the caller. May block and allocate.
void intersecting_pairs(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                        ParallelWorkspace& workspace, std::vector<TrianglePair>& pairs, double tolerance = 0.0);
void pairs_within(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                  ParallelWorkspace& workspace, std::vector<ClosePair>& pairs, const PairSelection& selection = {});

}  // namespace glissade::collision
