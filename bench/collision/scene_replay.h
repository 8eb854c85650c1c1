#pragma once

/// The benchmarks of scenes: subjects go through the frames of a scene to and fro, so that nothing ever jumps.

#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench_program.h"
#include "scene_cast.h"

namespace glissade::bench {

/// A scene and the frames that all subjects see.
struct Film {
  Scene scene;
  std::vector<std::vector<MovedObject>> frames;
};

/// The first frames of a scene.
Film film(Scene scene, std::size_t frames);

/// A scene whose objects bounce off each other where `cast` finds that they meet.
Film film_with_bounces(Scene scene, std::size_t frames, SceneCast& cast);

/// One subject in one film.
class Replay {
 public:
  using Meeting = std::vector<std::vector<NumberPair>>;

  /// Goes through the frames once. The cast and the film must outlive the replay.
  Replay(SceneCast& cast, const SceneLibrary& library, const Film& film);

  /// The pairs that meet in each frame, ascending, the lower number first.
  const Meeting& meeting() const { return meeting_; }
  const Film& film() const { return film_; }
  bool has_report() const { return subject_->report() != nullptr; }

  /// Goes through the frames, each time in the other direction; calls after_frame(subject) after each.
  template <typename AfterFrame>
  void pass(const AfterFrame& after_frame) {
    const std::size_t count = film_.frames.size();
    for (std::size_t i = 0; i < count; ++i) {
      subject_->step(film_.frames[is_forward_ ? i : count - 1 - i]);
      after_frame(*subject_);
    }
    is_forward_ = !is_forward_;
  }

 private:
  const Film& film_;
  std::unique_ptr<SceneSubject> subject_;
  Meeting meeting_;
  bool is_forward_ = true;
};

/// Replays that benchmarks share, and the film of a case.
struct SceneCase {
  std::string name;  ///< BENCH/CASE
  std::shared_ptr<Lazy<SceneCast>> cast;
  std::shared_ptr<Lazy<Film>> film;
  int pause_ms = 0;           ///< after each frame, not measured
  bool is_real_time = false;  ///< for several threads
};

/// Registers NAME/LIBRARY for each library; the pairs that the first finds are what the others' are compared with.
///
/// Counters: `frame`, seconds a frame; `meeting`, pairs that meet, mean over the frames; of all but the first,
/// `disagreements`, pairs of all frames that only one of both finds. Of subjects with a report, means over the frames:
/// `neighbors`; for each stage `STAGE_in` and `STAGE_out`, pairs, and `STAGE_us`, microseconds.
void register_scenes(const SceneCase& scene_case, const std::vector<SceneLibrary>& libraries);

}  // namespace glissade::bench
