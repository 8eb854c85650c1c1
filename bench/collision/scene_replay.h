#pragma once

/// The clock of the benches of scenes: subjects take turns of some frames each, so that a slow moment of the machine
/// hits all of them alike, and another one comes first every time.

#include <span>
#include <vector>

#include <glissade/collision/frame_result.h>

#include "scene_subject.h"

namespace glissade::bench {

struct ReplayLimits {
  int run_in = 20;       ///< frames that do not count: what remembers fills its memory
  int frames = 2000;     ///< after those
  int turn = 50;         ///< frames
  int warm_up = 5;       ///< frames of a turn that do not count: they find the caches full of others' models
  double seconds = 8.0;  ///< after which a subject drops out, and so has taken the first frames only
  int least = 3;         ///< frames, however long they take
};

/// One frame of one subject.
struct FrameRecord {
  int frame = 0;
  double us = 0.0;
  std::vector<NumberPair> meeting;  ///< ascending, the lower number first
  collision::FrameReport report;
};

/// Lets the objects bounce off each other for so many frames; the referee says which meet.
void play(Scene& scene, SceneSubject& referee, int frames);

/// The frames of each subject that count, in order.
std::vector<std::vector<FrameRecord>> replay(const Scene& scene,
                                             std::span<const std::unique_ptr<SceneSubject>> subjects,
                                             const ReplayLimits& limits);

/// Median time of the frames that `others` took, too.
double median_us(std::span<const FrameRecord> frames, std::span<const FrameRecord> others);

/// Mean time of the same frames, in which the few that take long count.
double mean_us(std::span<const FrameRecord> frames, std::span<const FrameRecord> others);

/// One frame of a hundred takes longer; of fewer than a hundred the slowest.
double percentile_99_us(std::span<const FrameRecord> frames);

/// How many pairs meet in one but not in the other, over the frames that both took.
std::int64_t differences(std::span<const FrameRecord> frames, std::span<const FrameRecord> others);

}  // namespace glissade::bench
