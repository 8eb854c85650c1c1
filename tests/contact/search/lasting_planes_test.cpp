// Planes that last: in the step for which they are made, they keep more triangles apart than those of the search, and
// never fewer.

#include "search/lasting_planes.h"

#include <algorithm>
#include <array>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>

#include "held_part.h"
#include "search/candidate_search.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

// Metres:
constexpr double kMarginOfBall = 2e-6;
constexpr double kBall = 0.02;
constexpr double kSocket = 0.02003;

ContactScene ball_in_socket() {
  return {{test_support::obstacle_of(geometry::make_sphere(kSocket, 3000))},
          {test_support::part_of(geometry::make_sphere(kBall, 3000))},
          std::vector<double>{kMarginOfBall}};
}

CandidateRequest request_at(const Isometry3d& X_WV) {
  CandidateRequest request;
  request.X_WB = {X_WV};
  request.range.radius = 0.3e-3;
  request.range.sought = SoughtPairs::kWithPlanesInCloseFit;
  return request;
}

/// By slot: the lesser of the gaps (metres) at both ends of a step.
std::vector<float> least_gaps(const PlanesOfBodies& planes, const ExpectedStep& step) {
  std::array<std::vector<float>, 2> gaps;
  planes.find_gaps(planes.maps(step.X_WB_begin.front()), 0, planes.block_count(), gaps[0]);
  planes.find_gaps(planes.maps(step.X_WB_end.front()), 0, planes.block_count(), gaps[1]);
  std::vector<float> least;
  for (std::size_t slot = 0; slot < planes.numbers().size(); ++slot)
    least.push_back(std::min(gaps[0][slot], gaps[1][slot]));
  return least;
}

/// The numbers of pairs that planes of a search and those that last leave of interest in the step, which is that of the
/// last mover as the first body sees it.
struct PairsOfInterest {
  PairsOfInterest(const ContactScene& scene, CandidateRequest request, const ExpectedStep& step,
                  const ExpectedStep& relative) {
    CandidateSearch search(scene, 1e-3);
    CandidateSet of_search;
    search.find(request, of_search);
    request.first_step = step;
    CandidateSet lasting;
    search.find(request, lasting);
    const std::vector<float> before = least_gaps(of_search.planes.front(), relative);
    const std::vector<float> after = least_gaps(lasting.planes.front(), relative);
    EXPECT_EQ(before.size(), after.size());
    for (std::size_t slot = 0; slot < before.size(); ++slot) {
      if (after[slot] < std::min(before[slot], kOfInterest) - kRounding) ++nearer_than_before;
    }
    of_planes_of_search = count(before);
    of_lasting_planes = count(after);
  }

  static std::ptrdiff_t count(const std::vector<float>& gaps) {
    return std::count_if(gaps.begin(), gaps.end(), [](float gap) { return gap < kOfInterest; });
  }

  static constexpr float kOfInterest = 2.5F * static_cast<float>(kMarginOfBall);
  static constexpr float kRounding = 1e-7F;
  std::ptrdiff_t of_planes_of_search = 0;
  std::ptrdiff_t of_lasting_planes = 0;
  int nearer_than_before = 0;
};

const Isometry3d kAside(Eigen::Translation3d(10e-6, -5e-6, 3e-6));
const Isometry3d kTurned(Eigen::AngleAxisd(20e-3, Vector3d(1.0, 2.0, 3.0).normalized()));

TEST(LastingPlanes, SeparateMorePairsInTheExpectedStep) {
  const ExpectedStep step{{kAside}, {kTurned * kAside}};
  const PairsOfInterest pairs(ball_in_socket(), request_at(kAside), step, step);
  EXPECT_GT(pairs.of_planes_of_search, 3000);
  EXPECT_LT(3 * pairs.of_lasting_planes, pairs.of_planes_of_search);
  EXPECT_EQ(pairs.nearer_than_before, 0);
}

// The socket moves.
TEST(LastingPlanes, AccountForTheMotionOfBothBodies) {
  const ContactScene scene({},
                           {test_support::part_of(geometry::make_sphere(kSocket, 3000)),
                            test_support::part_of(geometry::make_sphere(kBall, 3000))},
                           std::vector<double>{kMarginOfBall, kMarginOfBall});
  const Isometry3d X_still = Isometry3d::Identity();
  CandidateRequest request = request_at(X_still);
  request.X_WB.push_back(kAside);
  const PairsOfInterest pairs(scene, request, {{X_still, kAside}, {kTurned.inverse(), kAside}},
                              {{kAside}, {kTurned * kAside}});
  EXPECT_GT(pairs.of_planes_of_search, 3000);
  EXPECT_LT(3 * pairs.of_lasting_planes, pairs.of_planes_of_search);
}

}  // namespace
}  // namespace glissade::contact
