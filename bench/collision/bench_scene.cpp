// See `register_scene` in benches.h.

#include <algorithm>

#include "benches.h"
#include "scene_replay.h"

namespace glissade::bench {
namespace {

// Fraction of the box that the bounding spheres of the objects fill.
constexpr double kFilled = 0.12;
constexpr std::size_t kSampleFrames = 5;

// Fewer for more objects, so that the slow libraries need at most some seconds.
std::size_t frames_for(std::size_t objects, bool quick) {
  return std::min<std::size_t>(2000, 100'000 / objects) / (quick ? 5 : 1);
}

}  // namespace

void register_scene(const Suite& suite) {
  const auto cast = lazy([] { return SceneCast(); });
  std::vector<std::size_t> counts{10, 30, 100};
  if (!suite.quick) counts.insert(counts.end(), {300, 1000});
  for (const std::size_t count : counts) {
    const std::size_t frames = frames_for(count, suite.quick);
    register_scenes({"scene/objects-" + std::to_string(count), cast, lazy([=] {
                       return film_with_bounces(objects_apart((*cast)->radii(), count, kFilled, kSeed), frames, **cast);
                     })},
                    {glissade_scenes(1), fcl_scenes(), ode_scenes(), bullet_scenes()});
  }
  for (const std::size_t count : counts) {
    if (count < 100) continue;
    const auto through = [=](std::size_t frames) {
      return lazy([=] { return film(objects_in_box((*cast)->radii(), count, kFilled, kSeed), frames); });
    };
    const std::string name = "scene/through-" + std::to_string(count);
    register_scenes({name, cast, through(frames_for(count, suite.quick) / 4)}, {glissade_scenes(1), fcl_scenes()});
    register_scenes({name + "-sample", cast, through(kSampleFrames)},
                    {glissade_scenes(1), ode_scenes(), bullet_scenes()});
  }
  // In both scenes only object 0 moves, and in the same way.
  for (const std::size_t resting : {std::size_t{10}, std::size_t{1000}}) {
    register_scenes({"scene/rest-" + std::to_string(resting), cast,
                     lazy([=] { return film(one_among_resting((*cast)->radii(), resting, kFilled, kSeed), 2000); })},
                    {glissade_scenes(1)});
  }
}

}  // namespace glissade::bench
