#pragma once

/// What candidates hold, and what they lack beside plain loops.

#include <string>
#include <vector>

#include "search/candidate_pairs.h"

namespace glissade::test_support {

std::vector<haptics::TrianglesOfBodies> pairs_within(const haptics::CandidatePairs& candidates, double reach);
std::vector<haptics::PairToCertify> pairs_to_certify_within(const haptics::CandidatePairs& candidates, double reach);

/// A pair of triangles within `reach` (metres) that is missing, for proofs or for contacts; empty if none is.
std::string what_is_missing(const haptics::CandidatePairs& candidates, const haptics::ContactScene& scene,
                            double reach);

}  // namespace glissade::test_support
