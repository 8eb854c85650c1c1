#pragma once

/// Hands that move wildly about an object, for the torture of the clasp.

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/triangle_mesh.h>
#include <glissade/grasping/kinematic_chain.h>

namespace glissade::test_support {

/// What a hand does. In each, the palm comes towards a random point of the object from a random side, and every flex
/// value moves at up to 30 rad/s, within its limits.
enum class WildMotion : std::uint8_t {
  kRandom,  ///< all values swing for themselves, while the hand swings to and fro and turns
  kFist,    ///< the fist closes and opens at 30 rad/s, while the hand swings to and fro
  kSlap,    ///< the hand goes straight through the object at 3 m/s and back
  kTwist,   ///< the hand closes round the object, and then turns to and fro about a random axis through it
};
inline constexpr int kWildMotions = 4;

/// A motion of `kMs` milliseconds that depends on the seed only. It begins at a distance of the object.
class WildHand {
 public:
  static constexpr int kMs = 150;

  WildHand(std::uint64_t seed, WildMotion motion, const geometry::TriangleMesh& object_W);

  /// The target at a time, 0 to kMs.
  grasping::Posture at_ms(int ms) const;

 private:
  struct Swing {
    double middle;
    double amplitude;
    double rate;
    double phase;
  };

  WildMotion motion_;
  std::vector<Swing> swings_;  // of the flex values
  Eigen::Vector3d p_W_;        // where the palm comes to
  Eigen::Quaterniond q_WR_;
  Eigen::Vector3d axis_W_;
  Eigen::Vector3d swing_rates_;  // rad/s: approach, turn, sideways
};

}  // namespace glissade::test_support
