#pragma once

/// The subjects of the benchmarks of sliding contact: the methods of `reference::SlidingMethod`.

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <glissade/contact/sliding.h>
#include <glissade/reference/sliding_method.h>

#include "sweeps/sliding_scenes.h"

namespace glissade::bench {

struct SlidingSubject {
  std::string name;
  reference::SlidingMethod method;
};

inline const std::array<SlidingSubject, 2> kSlidingSubjects{
    SlidingSubject{"glissade", reference::SlidingMethod::kProjection},
    SlidingSubject{"glissade-paper", reference::SlidingMethod::kPaper}};

/// A simulation at the start of a scene.
struct SlidingRun {
  std::unique_ptr<reference::SlidingSimulation> sliding;
};

SlidingRun start(const SlidingSubject& subject, const test_support::SlidingScene& scene,
                 const contact::SlidingOptions& options = {});

}  // namespace glissade::bench
