#pragma once

/// What the haptic thread gets to know of a clasp.

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/grasping/clasp.h>
#include <glissade/grasping/kinematic_chain.h>
#include <glissade/haptics/contact_set.h>

namespace glissade::grasping {

/// Writes the posture and the contacts of a visible hand into `answer`: of each contact its row of the Jacobian, the
/// deepest contacts first. The parts are the bodies from `first_part` on. `X_WL` is working memory; pass the same
/// vector to each call. The chain has at most as many flex values as a glove has joints.
void tell_visible(const KinematicChain& chain, const Posture& visible, std::span<const LinkContact> contacts,
                  std::int32_t first_part, std::vector<Eigen::Isometry3d>& X_WL, haptics::HandAnswer& answer);

}  // namespace glissade::grasping
