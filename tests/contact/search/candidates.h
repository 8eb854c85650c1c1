#pragma once

/// What candidates hold, and what they lack beside plain loops.

#include <string>
#include <vector>

#include "search/candidate_pairs.h"

namespace glissade::test_support {

std::vector<contact::TrianglesOfBodies> pairs_within(const contact::CandidatePairs& candidates, double reach);
std::vector<contact::PairToCertify> pairs_to_certify_within(const contact::CandidatePairs& candidates, double reach);

/// A pair of triangles within `reach` (metres) that is missing, for proofs or for contacts; empty if none is.
std::string what_is_missing(const contact::CandidatePairs& candidates, const contact::ContactScene& scene,
                            double reach);

}  // namespace glissade::test_support
