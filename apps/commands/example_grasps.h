#pragma once

/// Things of a household on a table, and hands that grasp them: among the files of `glissade example`.

#include <vector>

#include <glissade/apps/commands/example_files.h>

namespace glissade::apps {

/// For each thing a scene, such as grasp_mug.yaml, and the trajectory of a hand that reaches for it, closes round it in
/// 0.4 s and lifts it by 100 mm, such as grasp_mug_hand.csv. Cost: as `example_files`.
std::vector<TextFile> example_grasps();

}  // namespace glissade::apps
