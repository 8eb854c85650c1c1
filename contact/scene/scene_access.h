#pragma once

/// The scene of a simulation, i.e. the bodies and their poses, for tests.

#include <glissade/contact/multi_part_sliding.h>
#include <glissade/contact/sliding.h>

#include "scene/contact_scene.h"

namespace glissade::contact {

struct SceneAccess {
  static const ContactScene& of(const MultiPartSliding& sliding) { return sliding.scene(); }
  static const ContactScene& of(const Sliding& sliding) { return of(sliding.sliding_); }
};

inline const ContactScene& scene_of(const MultiPartSliding& sliding) {
  return SceneAccess::of(sliding);
}
inline const ContactScene& scene_of(const Sliding& sliding) {
  return SceneAccess::of(sliding);
}

}  // namespace glissade::contact
