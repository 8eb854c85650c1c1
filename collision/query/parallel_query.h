#pragma once

/// Queries of all pairs by several threads, for pairs of objects that meet in so many triangles that one thread would
/// be long about it (paper §2.3, fine grain). Whether it is worth waking others shows while the query goes on: it
/// begins in the calling thread alone, and only when that has seen enough work divides what is still before it.

#include <memory>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/query_types.h>

namespace glissade::collision {

/// Scratch memory and counters of such queries. Keep one for each query that is under way and reuse it. Not
/// thread-safe.
class ParallelWorkspace {
 public:
  ParallelWorkspace();
  ~ParallelWorkspace();
  ParallelWorkspace(ParallelWorkspace&&) noexcept;
  ParallelWorkspace& operator=(ParallelWorkspace&&) noexcept;

  /// Work of the last query, of all threads together: the same however many there are.
  const QueryCounters& counters() const;
  /// Pieces of the last query that could go to other threads; 0 when the calling thread did it all.
  int pieces() const;

  struct Memory;
  Memory& memory() { return *memory_; }

 private:
  std::unique_ptr<Memory> memory_;
};

/// As the functions of `dop_query.h`: the same pairs in the same order, whatever the number of threads. The threads are
/// oneTBB's, those of the arena that the caller is in. May block and allocate.
void intersecting_pairs(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                        ParallelWorkspace& workspace, std::vector<TrianglePair>& pairs, double tolerance = 0.0);
void pairs_within(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                  ParallelWorkspace& workspace, std::vector<ClosePair>& pairs, const PairSelection& selection = {});

}  // namespace glissade::collision
