#pragma once

#include <Eigen/Core>

#include <glissade/haptics/coupling.h>
#include <glissade/haptics/sliding_result.h>

namespace glissade::apps {

/// What the contacts of a part exert on the hands that hold it, about the part's reference point p_Vref, in world axes.
/// At rest it balances the spring of the coupling. A part that only needs time to follow exerts nothing.
haptics::Wrench contact_wrench(const haptics::SlidingResult& result, const Eigen::Vector3d& p_Vref);

}  // namespace glissade::apps
