#pragma once

/// Whether a server, of which only the states are known, moves the parts of a scene.

#include <string>
#include <vector>

#include <Eigen/Core>

#include <glissade/apps/files/scene_file.h>
#include <glissade/devices/haptic_state.h>

namespace glissade::apps {

/// The parts of a scene as the states of its server have them. Calls of `doubt` may come from any thread.
class ViewedParts {
 public:
  /// The movable objects, and those that move on their own. Throws as `movable_objects`.
  explicit ViewedParts(const Scene& scene);

  /// Why this state is that of another scene, as a sentence; empty if nothing says so. Parts are told apart by their
  /// number and by their compliance points. Hands with fingers choose these points, so then the number alone counts.
  std::string doubt(const devices::HapticState& state) const;

 private:
  struct Part {
    std::string name;
    Eigen::Vector3d p_Vref;
  };

  std::string source_;
  std::vector<Part> parts_;
};

}  // namespace glissade::apps
