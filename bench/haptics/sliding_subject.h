#pragma once

/// The subjects of the benchmarks of sliding contact: the methods of `haptics::SlidingMethod`.

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <glissade/haptics/sliding.h>

#include "sweeps/sliding_scenes.h"

namespace glissade::bench {

struct SlidingSubject {
  std::string name;
  haptics::SlidingMethod method;
};

inline const std::array<SlidingSubject, 2> kSlidingSubjects{
    SlidingSubject{"glissade", haptics::SlidingMethod::kProjection},
    SlidingSubject{"glissade-paper", haptics::SlidingMethod::kPaper}};

/// A simulation at the start of a scene.
struct SlidingRun {
  std::unique_ptr<haptics::SlidingSimulation> sliding;
  std::function<std::int64_t()> queries;  ///< queries of the collision detection so far
};

SlidingRun start(const SlidingSubject& subject, const test_support::SlidingScene& scene,
                 const haptics::SlidingOptions& options = {});

}  // namespace glissade::bench
