#include <map>
#include <numbers>
#include <stdexcept>

#include "sweeps/sliding_scenes.h"

namespace glissade::test_support {
namespace {

using SceneMaker = std::function<SlidingScene()>;

const std::map<std::string, SceneMaker>& scene_makers() {
  static const std::map<std::string, SceneMaker> kMakers{
      {"bay", [] { return bay_scene(); }},
      {"clutter", [] { return clutter_scene(1); }},
      {"corner",
       [] {
         return corner_scene({1200, true});
       }},
      {"flush_10k", [] { return housing_scene(10'000, Fit::kFlush); }},
      {"flush_50k", [] { return housing_scene(50'000, Fit::kFlush); }},
      {"gear", [] { return gear_scene(); }},
      {"groove",
       [] {
         return groove_scene({1200, true});
       }},
      {"light_10k", [] { return housing_scene(10'000, Fit::kLight); }},
      {"light_50k", [] { return housing_scene(50'000, Fit::kLight); }},
      {"nut", [] { return nut_scene(); }},
      {"peg",
       [] {
         return peg_scene({0.3e-3, 0.5 * std::numbers::pi / 180.0, 1});
       }},
      {"plane",
       [] {
         return plane_scene({1200, true});
       }},
      {"sheets", [] { return sheets_scene(1); }}};
  return kMakers;
}

}  // namespace

const std::vector<std::string>& sliding_scene_names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const auto& [name, maker] : scene_makers())
      names.push_back(name);
    return names;
  }();
  return kNames;
}

SlidingScene make_sliding_scene(const std::string& name) {
  const auto found = scene_makers().find(name);
  if (found != scene_makers().end()) return found->second();
  std::string known;
  for (const std::string& other : sliding_scene_names())
    known += (known.empty() ? "" : ", ") + other;
  throw std::invalid_argument("There is no scene '" + name + "'; known are " + known + ".");
}

}  // namespace glissade::test_support
