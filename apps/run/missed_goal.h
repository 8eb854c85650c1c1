#pragma once

/// Why a run has missed the goal of its scene.

#include <string>

#include <glissade/apps/run/session.h>
#include <glissade/apps/scene/haptic_scene.h>

namespace glissade::apps {

/// How far the first part is from its goal, what the hands did with it, and what stood in the way, as far as the kept
/// ticks show it: one sentence. The summary has a goal that was not reached.
std::string why_goal_is_missed(const SessionSummary& summary, const Session& session, const HapticScene& scene);

}  // namespace glissade::apps
