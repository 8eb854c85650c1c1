#pragma once

/// The collision detection of sliding contact (paper §3.1): what is near parts at given poses. It knows poses from its
/// requests only, so it may work on one in a thread of its own while the simulation goes on (paper Figure 7).

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/collision_pipeline.h>

#include "certificate/pairs_to_certify.h"
#include "scene/contact_scene.h"

namespace glissade::haptics {

/// A pair of triangles that may make a contact: either answers for an edge or vertex that can stop the part.
struct CandidatePair : TrianglesOfBodies {
  double distance;      ///< metres, at the poses of the request
  Eigen::Vector3d n_W;  ///< unit, from the obstacle's to the part's closest point then; zero where it is not sharp
};

/// What is asked for.
struct CandidateRequest {
  std::vector<Eigen::Isometry3d> X_WV;  ///< of each part
  double radius = 0.0;                  ///< metres
  std::vector<BodyPair> ignored;        ///< pairs of bodies
};

/// The answer: all pairs within the radius, the nearest first.
struct CandidateSet {
  std::vector<CandidatePair> pairs;       ///< for contacts
  std::vector<PairToCertify> to_certify;  ///< for proofs
  collision::FrameReport report;          ///< what it took, without the to_certify
};

/// Not thread-safe, but apart from the scene: these may be changed while a request is worked on.
class CandidateSearch {
 public:
  /// The scene must outlive this object. Requests may have radii up to `greatest_radius` (metres).
  CandidateSearch(const ContactScene& scene, double greatest_radius);

  /// Replaces `set`. The answer depends on the request only. Throws std::invalid_argument for a pose that is none.
  void find(const CandidateRequest& request, CandidateSet& set);

 private:
  void collect_pairs(const collision::FrameResult& near, std::span<const BodyPair> ignored,
                     std::vector<CandidatePair>& pairs) const;

  const ContactScene& scene_;
  std::vector<PlacedBody> bodies_;
  std::vector<collision::ObjectId> part_ids_;
  realtime::SteadyClock clock_;
  collision::World world_;
  collision::CollisionPipeline pipeline_;
  collision::QueryWorkspace workspace_;
};

}  // namespace glissade::haptics
