#pragma once

#include <Eigen/Core>

#include <glissade/contact/sliding_result.h>
#include <glissade/contact/spring.h>
#include <glissade/haptics/coupling.h>

namespace glissade::apps {

/// What the contacts of a part exert on the hands that hold it, about the part's reference point p_Vref, in world axes.
/// At rest it balances the spring of the coupling. A part that only needs time to follow exerts nothing.
contact::Wrench contact_wrench(const contact::SlidingResult& result, const Eigen::Vector3d& p_Vref);

}  // namespace glissade::apps
