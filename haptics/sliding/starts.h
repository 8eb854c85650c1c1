#pragma once

/// Bodies that are too close at the start: overlaps are refused or depenetrated; a minimum clearance that was lowered
/// at the start is restored as the bodies come apart.

#include <vector>

#include <glissade/haptics/sliding_rules.h>

#include "certificate/path_certificate.h"
#include "sliding/overlaps.h"
#include "sliding/simulated_parts.h"

namespace glissade::haptics {

/// Not thread-safe.
class Starts {
 public:
  /// Finds overlaps; bodies closer than `touching` (metres) count as overlapping. `shared` must outlive this object.
  /// Throws std::invalid_argument for an overlap that the rules refuse.
  Starts(SimulatedParts& shared, const std::vector<HeldPart>& parts, double touching);

  const Overlaps& overlaps() const { return overlaps_; }

  /// Aims parts that overlap an obstacle out of it, by at most `most` metres.
  void depenetrate(double most);
  /// Metres by which `depenetrate` may move a part in this tick; 0 when none overlaps.
  double depenetration() const { return depenetration_; }

  /// Raises the minimum clearance of bodies that have come apart since their start, up to kMinClearanceOfMargin of the
  /// margin.
  void restore_min_clearances();

 private:
  void look(const std::vector<HeldPart>& parts, std::size_t part, std::size_t other, double touching);
  double gap_of(const BodyPair& pair, double limit);

  SimulatedParts& shared_;
  Overlaps overlaps_;
  std::vector<BodyPair> near_starts_;  // pairs whose minimum clearance is lowered
  collision::QueryWorkspace workspace_;
  double depenetration_ = 0.0;  // metres
};

}  // namespace glissade::haptics
