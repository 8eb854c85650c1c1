#pragma once

/// What the haptic thread gets to know of a hand with fingers.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/grasping/clasp.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/grasping/kinematic_chain.h>
#include <glissade/haptics/contact_set.h>

namespace glissade::haptics {

/// Not thread-safe.
class FingerRows {
 public:
  /// Writes all that the haptic thread gets to know of a hand of a simulation.
  void tell(const grasping::GraspSimulation& simulation, std::size_t hand, HandAnswer& answer);
  /// Writes the posture and the contacts of a visible hand into `answer`: of each contact its row of the Jacobian. Of
  /// more than `kMaxFingerRows` contacts, it chooses as documented there. The parts are the bodies from
  /// `first_part` on. The chain has at most as many flex values as a glove has joints.
  void tell(const grasping::Clasp& clasp, std::span<const grasping::LinkContact> contacts, std::int32_t first_part,
            HandAnswer& answer);

 private:
  enum class Priority : std::uint8_t {
    kStrongest,  ///< pushes a joint back the farthest
    kOfSegment,  ///< the deepest of a segment with an object
    kOther
  };

  void choose(const grasping::Clasp& clasp, std::span<const grasping::LinkContact> contacts);
  void choose_strongest(const grasping::Clasp& clasp);
  void choose_of_each_segment(std::span<const grasping::LinkContact> contacts);

  std::vector<Eigen::Isometry3d> X_WL_;
  std::vector<FingerRow> rows_;        // of all contacts
  std::vector<std::size_t> by_depth_;  // their numbers, the deepest first
  std::vector<std::size_t> chosen_;
  std::vector<Priority> priorities_;
};

}  // namespace glissade::haptics
