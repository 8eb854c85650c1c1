#pragma once

/// Planes that last: where parts slide past each other, those that separate the most at one pose do not. A search gives
/// its pairs better ones, so that the step in which its answer is first needed finds most of them proved.

#include <algorithm>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/query_types.h>

#include "certificate/lasting_separation.h"
#include "certificate/separating_planes.h"
#include "scene/contact_scene.h"

namespace glissade::contact {

/// A step that is expected: the poses of the movers at both ends. Nothing is known of it where these are the same.
struct ExpectedStep {
  std::vector<Eigen::Isometry3d> X_WB_begin;
  std::vector<Eigen::Isometry3d> X_WB_end;

  bool is_known() const {
    return !std::equal(X_WB_begin.begin(), X_WB_begin.end(), X_WB_end.begin(), X_WB_end.end(),
                       [](const auto& begin, const auto& end) { return begin.matrix() == end.matrix(); });
  }
  void forget() {
    X_WB_begin.clear();
    X_WB_end.clear();
  }
};

/// Not thread-safe.
class LastingPlanes {
 public:
  /// The scene must outlive this object. The `meter` receives the work; null: nobody does.
  LastingPlanes(const ContactScene& scene, collision::WorkMeter* meter) : scene_(scene), meter_(meter) {}

  /// Turns those of `planes` that would not keep their triangles some margins apart in the step, where others keep them
  /// farther apart. `bodies` are at the poses of the search.
  void turn(const ExpectedStep& step, std::span<const PlacedBody> bodies, std::vector<PlanesOfBodies>& planes);

 private:
  void turn(const ExpectedStep& step, std::span<const PlacedBody> bodies, PlanesOfBodies& planes);
  void turn_waiting(std::span<const PlacedBody> bodies, PlanesOfBodies& planes);

  const ContactScene& scene_;
  collision::WorkMeter* meter_;
  LastingSeparations separations_;
  std::vector<std::size_t> waiting_;  // slots of the pairs of `separations_`
  std::vector<float> gaps_at_begin_;
  std::vector<float> gaps_at_end_;
};

}  // namespace glissade::contact
