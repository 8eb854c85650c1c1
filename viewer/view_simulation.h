#pragma once

/// A scene, and its simulation without a haptic loop, as viewers show them.

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <glissade/contact/sliding_result.h>
#include <glissade/contact/tracked_contacts.h>
#include <glissade/devices/haptic_state.h>
#include <glissade/simulation/scene.h>
#include <glissade/viewer/view_scene.h>

namespace glissade::viewer {

/// All objects of the scene; the movable ones with the numbers that `part_names` gives them, then those that move on
/// their own.
std::vector<ViewObject> shown_objects(const simulation::Scene& scene, const std::vector<std::string>& part_names);

/// Writes a part of a simulation that runs by itself into a state, with the contacts that push on it, and their
/// patches. `p_Vref` is the part's reference point.
void show_part(const contact::SlidingResult& result, const Eigen::Vector3d& p_Vref, std::size_t part,
               contact::ContactPatches& patches, devices::HapticState& state);

}  // namespace glissade::viewer
