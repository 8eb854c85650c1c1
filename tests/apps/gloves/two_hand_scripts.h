#pragma once

/// The scripts of two hands that share three cubes: first a lesson in seven steps, then grasps and releases at any
/// moment.

#include <array>
#include <cstdint>
#include <string>

namespace glissade::test_support {

/// What the two hands do when their grips have these counts (`GloveState::grip`, odd while the hand is closed).
/// Parts: 0 the first cube, 1 the second; −1: none.
struct LessonStep {
  const char* what;
  std::array<std::int64_t, 2> grips;
  std::array<std::int32_t, 2> parts;  ///< that they hold at the end of the step
  double least_force_N;               ///< that each hand feels at some time of the step
};

inline constexpr std::array<LessonStep, 7> kLesson{{{"the first carries a cube", {1, 0}, {0, -1}, 0.0},
                                                    {"both hold it and pull", {1, 1}, {0, 0}, 1.0},
                                                    {"it has passed to the second", {2, 1}, {-1, 0}, 0.0},
                                                    {"each holds one and pushes the other's", {3, 1}, {1, 0}, 1.0},
                                                    {"the second lets go under force", {3, 2}, {1, -1}, 0.0},
                                                    {"and takes it again", {3, 3}, {1, 0}, 0.0},
                                                    {"both have let go", {4, 4}, {-1, -1}, 0.0}}};

/// A script in the format of `glissade glove`.
struct GripScript {
  std::string csv;
  std::int64_t grip = 0;  ///< its count at the end
};

/// The cubes, of the edge 0.04 m, must be at (−0.03, 0, 0) and (0.03, 0, 0). The lesson takes six seconds. Then about
/// seventeen grasps or releases a second follow until 1.5 s before the end, in a cube of 0.12 m about the origin. The
/// scripts themselves go on for some seconds after it.
std::array<GripScript, 2> two_hand_scripts(double seconds, std::uint64_t seed);

}  // namespace glissade::test_support
