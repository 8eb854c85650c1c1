#pragma once

/// Stage 3 of the pipeline: exact queries of the pairs that no plane separates.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glissade/collision/frame_result.h>
#include <glissade/collision/query_types.h>
#include <glissade/collision/world.h>

#include "pipeline/meeting_list.h"
#include "pipeline/pair_table.h"
#include "pipeline/thread_pool.h"
#include "pipeline/tracked_pair.h"

namespace glissade::collision {

struct PlacedPair;

class ExactStage {
 public:
  ExactStage(const World& world, const PipelineOptions& options, PairTable& pairs, MeetingList& meetings,
             ThreadPool& pool)
      : world_(world),
        options_(options),
        pairs_(pairs),
        meetings_(meetings),
        pool_(pool),
        scratch_(static_cast<std::size_t>(pool.threads())) {
    if (pool.threads() == 1) scratch_.front().set_meter(options.meter);
  }

  /// Determines which pairs are at most `distance` metres apart, with the triangles that the options require, and
  /// reports changes to the list of meetings. Reorders `near`: long queries come first, so that all threads end
  /// together.
  void query(std::vector<PairTable::Number>& near, double distance, StageReport& report);

  /// Whether several threads shared the last call; then they will probably share the next one.
  bool was_shared() const { return was_shared_; }

 private:
  void put_long_queries_first(std::vector<PairTable::Number>& near) const;
  void prefetch(const std::vector<PairTable::Number>& near, std::size_t i, std::size_t end);
  void prefetch(const TrackedPair& pair, const PairMemory& memory, int step) const;
  void query(TrackedPair& pair, PairMemory& memory, double distance, int worker);
  template <typename Pair>
  void find_pairs(TrackedPair& pair, PairMemory& memory, const PlacedPair& placed, double distance,
                  QueryWorkspace& scratch, std::vector<Pair>& found);

  const World& world_;
  const PipelineOptions& options_;
  PairTable& pairs_;
  MeetingList& meetings_;
  ThreadPool& pool_;
  std::vector<QueryWorkspace> scratch_;   ///< by worker
  std::vector<std::uint8_t> met_before_;  ///< by pair of the call
  bool was_shared_ = false;
};

}  // namespace glissade::collision
