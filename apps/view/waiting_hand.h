#pragma once

/// Why a hand waits.

#include <string>

#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/grasping/hand_model.h>

namespace glissade::apps {

/// The segment of a hand that would be in an object at this posture, or nearest to one, and that object, as
/// "palm in 'table'". Cost: a query for each segment and object, and a tree for each segment.
std::string nearest_object(const HapticScene& scene, const grasping::GraspSimulation& simulation,
                           const grasping::HandModel& hand, grasping::Posture posture);

}  // namespace glissade::apps
