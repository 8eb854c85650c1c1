#include "candidates.h"

#include <set>

#include "near_bodies.h"

namespace glissade::test_support {

using contact::PairToCertify;
using contact::TrianglesOfBodies;

std::vector<TrianglesOfBodies> pairs_within(const contact::CandidatePairs& candidates, double reach) {
  std::vector<TrianglesOfBodies> pairs(3);  // they are replaced
  candidates.pairs().within(reach, pairs);
  return pairs;
}

std::vector<PairToCertify> pairs_to_certify_within(const contact::CandidatePairs& candidates, double reach) {
  std::vector<PairToCertify> to_certify(3);
  candidates.pairs().within(reach, to_certify);
  return to_certify;
}

std::string what_is_missing(const contact::CandidatePairs& candidates, const contact::ContactScene& scene,
                            double reach) {
  std::set<TrianglesOfBodies> for_contacts;
  for (const TrianglesOfBodies& c : pairs_within(candidates, reach))
    for_contacts.insert({c.bodies, c.obstacle_triangle, c.part_triangle});
  std::set<TrianglesOfBodies> for_proofs;
  for (const PairToCertify& pair_to_certify : pairs_to_certify_within(candidates, reach)) {
    for (const TrianglesOfBodies& pair : triangles_of(scene.bodies(), pair_to_certify))
      for_proofs.insert(pair);
  }
  for (const auto& [pair, distance] : near_triangles(scene.bodies(), scene.obstacles().size(), reach)) {
    const std::string text = std::to_string(pair.obstacle_triangle) + " of body " +
                             std::to_string(pair.bodies.obstacle) + " and " + std::to_string(pair.part_triangle) +
                             " of body " + std::to_string(pair.bodies.part) + " at " + std::to_string(distance);
    if (!for_proofs.contains(pair)) return "for proofs: " + text;
    if (can_make_contact(scene, pair) && !for_contacts.contains(pair)) return "for contacts: " + text;
  }
  return "";
}

}  // namespace glissade::test_support
