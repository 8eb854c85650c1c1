#pragma once

/// The collision detection of sliding contact (paper §3.1): finds all pairs near the parts at given poses. It takes
/// poses from requests only, so it may run in a thread of its own while the simulation goes on (paper Figure 7).

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/collision_pipeline.h>

#include "certificate/separating_planes.h"
#include "scene/contact_scene.h"
#include "search/feature_pairs.h"
#include "search/lasting_planes.h"
#include "search/near_pairs.h"
#include "search/nearest_first.h"

namespace glissade::contact {

/// Lower bounds, metres, of the gaps of the contacts of a pair, from a search for contacts.
struct GapsOfPair {
  double least;           ///< of all contacts
  double beyond;          ///< of those beyond the reach of the search, at its poses only
  double left_out;        ///< of those with other features than `features`; 0: nothing is known
  FeaturePairs features;  ///< those that may be in contact within the reach, at these poses or others
};

/// The features of a pair that may be in contact, if `features` is not 0; otherwise nothing is known.
struct KnownFeatures {
  FeaturePairs features = 0;
  double left_out = 0.0;  ///< metres: no contact with other features has a smaller gap
};

/// Poses of the movers, range, and body pairs to leave out.
struct CandidateRequest {
  std::vector<Eigen::Isometry3d> X_WB;  ///< one for each mover
  SearchRange range{};
  std::vector<BodyPair> ignored;  ///< in ascending order
  ExpectedStep first_step;        ///< in which the answer is needed; may be unknown
};

/// The answer: what `find_near_pairs` finds, nearest first.
struct CandidateSet {
  bool has_too_many = false;  ///< pairs for the range of the request: nothing else is set then
  std::vector<NearPair> pairs;
  std::vector<PlanesOfBodies> planes;  ///< of `pairs`, by their places; none of them where distances are sought
  std::vector<PairToCertify> boxes;    ///< of larger pairs to certify than triangles
  std::size_t contact_count = 0;       ///< number of the pairs that may yield contacts
  std::size_t certify_count = 0;       ///< of those to certify, and the boxes
  collision::FrameReport report;       ///< of finding out which bodies are near; in total, of the search

  /// What `SearchRange::most_pairs` limits.
  std::size_t pair_and_box_count() const { return pairs.size() + boxes.size(); }
};

/// Not thread-safe. Reads neither poses nor minimum clearances of the scene, so these may change during a search.
class CandidateSearch {
 public:
  /// The scene must outlive this object. Requests may have radii up to `greatest_radius` (metres). The `meter` receives
  /// the work of each search, piece by piece, before it is done; null: nobody does. It must outlive this object.
  CandidateSearch(const ContactScene& scene, double greatest_radius, collision::WorkMeter* meter = nullptr);

  /// Replaces `set` by the answer, which depends on the request only. Throws std::invalid_argument for a pose that
  /// `geometry::rigid_pose` rejects.
  void find(const CandidateRequest& request, CandidateSet& set);

  /// Forgets earlier searches; required after one that ended with an exception of the meter.
  void start_afresh();

 private:
  void ignore(const std::vector<BodyPair>& bodies);
  void find_pairs(const collision::FrameResult& near, const CandidateRequest& request, CandidateSet& set);
  void find_planes(CandidateSet& set) const;

  const ContactScene& scene_;
  collision::WorkMeter* meter_;
  std::vector<PlacedBody> bodies_;
  std::vector<collision::ObjectId> ids_;  // of the bodies
  std::vector<BodyPair> ignored_;         // pairs that the world leaves out
  realtime::SteadyClock clock_;
  double greatest_radius_;
  double slack_ = 0.0;  // metres: the pipeline corrects poses that are not quite rigid
  std::optional<collision::World> world_;
  std::optional<collision::CollisionPipeline> pipeline_;  // of the world
  collision::QueryWorkspace workspace_;
  LastingPlanes lasting_planes_;
  NearestFirst nearest_first_;
  std::vector<NearPair> unsorted_pairs_;       // scratch memory
  std::vector<PairToCertify> unsorted_boxes_;  // the same
};

}  // namespace glissade::contact
