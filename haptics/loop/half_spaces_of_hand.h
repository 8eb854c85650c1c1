#pragma once

/// The half-spaces of the hand root, for devices that hold them in their own loop.

#include <span>

#include <Eigen/Geometry>

#include <glissade/contact/projection.h>
#include <glissade/contact/spring.h>
#include <glissade/devices/glove_device.h>
#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/coupling.h>

namespace glissade::haptics {

/// The contacts of the part in a hand as constraints on the pose of the hand, with the spring and damper of `coupling`.
/// While nothing else limits the force, the wrench of the half-spaces at this pose is the wrench of the contacts
/// without friction. `rows` constrain the displacement of the part from `answer.X_WV_of_rows`; at most kMaxHalfSpaces
/// count. `X_WG` is the part's ghost as this hand alone has it. Real-time safe.
devices::HalfSpaces half_spaces_of_hand(const Eigen::Isometry3d& X_WH, const Eigen::Isometry3d& X_WG,
                                        const PartAnswer& answer, std::span<const contact::ConstraintRow> rows,
                                        const Coupling& coupling) noexcept;

/// The size of a wrench about the reference point as `devices::HalfSpaces::max_force` has it, N.
double spring_size(const contact::Wrench& wrench, const contact::CouplingStiffness& stiffness) noexcept;

}  // namespace glissade::haptics
