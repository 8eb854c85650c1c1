#pragma once

/// Private: the two stages of the pipeline that look at one pair at a time: separating planes and the exact test.
/// Different pairs may be looked at by different threads at once.

#include <vector>

#include <glissade/collision/collision_pipeline.h>

#include "placed_objects.h"
#include "tracked_pair.h"
#include "work_crew.h"

namespace glissade::collision {

/// Two trees, and the pose of B in the frame of A.
struct PlacedPair {
  const DopTree& tree_A;
  const DopTree& tree_B;
  Eigen::Isometry3d X_AB;
  PairSelection selection;  ///< where close pairs are asked for
};

class PairChecks {
 public:
  PairChecks(const World& world, const PlacedObjects& placed, const PipelineOptions& options, WorkCrew& crew)
      : world_(world),
        placed_(placed),
        options_(options),
        crew_(crew),
        scratch_(static_cast<std::size_t>(crew.threads())) {}

  /// Whether the hulls are certainly further apart than `distance` (metres). Notes for how long.
  bool are_separated(TrackedPair& pair, PairMemory& memory, double distance) const;

  /// Has the memory ready soon that the pair's exact query will look at; step 0 first, then 1, 2 and 3, each with some
  /// queries of other pairs in between.
  void prefetch(const TrackedPair& pair, const PairMemory& memory, int step) const;

  /// Finds out whether the objects are not further apart than `distance`, and all else that is asked for. `worker` is
  /// the crew's.
  void find_out(TrackedPair& pair, PairMemory& memory, double distance, int worker);

 private:
  template <typename Pair>
  void find_pairs(TrackedPair& pair, PairMemory& memory, const PlacedPair& placed, double distance,
                  QueryWorkspace& scratch, std::vector<Pair>& found);

  const World& world_;
  const PlacedObjects& placed_;
  const PipelineOptions& options_;
  WorkCrew& crew_;
  std::vector<QueryWorkspace> scratch_;
};

}  // namespace glissade::collision
