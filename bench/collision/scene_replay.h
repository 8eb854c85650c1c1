#pragma once

/// The timing of the benches of scenes. Subjects take turns of some frames each, so that a slow moment of the machine
/// affects all of them alike; each round begins with another subject.

#include <span>
#include <vector>

#include <glissade/collision/frame_result.h>

#include "scene_subject.h"

namespace glissade::bench {

struct ReplayLimits {
  int run_in = 20;       ///< frames that do not count: subjects with memory fill it
  int frames = 2000;     ///< after those
  int turn = 50;         ///< frames
  int warm_up = 5;       ///< frames of a turn that do not count: caches hold the models of others
  double seconds = 8.0;  ///< after which a subject stops; it has then taken the first frames only
  int least = 3;         ///< frames, however long they take
};

/// One frame of one subject.
struct FrameRecord {
  int frame = 0;
  double us = 0.0;
  std::vector<NumberPair> meeting;  ///< ascending, the lower number first
  collision::FrameReport report;
};

/// Lets the objects bounce off each other for `frames` frames. The referee decides which of them meet.
void play(Scene& scene, SceneSubject& referee, int frames);

/// The counted frames of each subject, in order.
std::vector<std::vector<FrameRecord>> replay(const Scene& scene,
                                             std::span<const std::unique_ptr<SceneSubject>> subjects,
                                             const ReplayLimits& limits);

/// Median time of the frames that `others` has, too.
double median_us(std::span<const FrameRecord> frames, std::span<const FrameRecord> others);

/// Mean time of the same frames, which includes the few slow ones.
double mean_us(std::span<const FrameRecord> frames, std::span<const FrameRecord> others);

/// The 99th percentile of the times; for fewer than a hundred frames the greatest time.
double percentile_99_us(std::span<const FrameRecord> frames);

/// Number of pairs that meet in one record but not in the other, over the frames that both have.
std::int64_t differences(std::span<const FrameRecord> frames, std::span<const FrameRecord> others);

}  // namespace glissade::bench
