#include <utility>
#include <vector>

#include <glissade/apps/view/replay_maker.h>
#include <glissade/apps/view/say_if_simplified.h>
#include <glissade/viewer/scene_model.h>

namespace glissade::apps {

namespace {

constexpr std::size_t kMostTriangles = 140'000;
constexpr std::size_t kMostFrameBytes = 1'000'000;

/// A replay without frames.
Replay models_of(const viewer::ViewScene& scene) {
  Replay replay{viewer::scene_model(scene, viewer::kFirstTriangles), {}};
  if (scene.triangles() > viewer::kFirstTriangles) replay.whole_model = viewer::scene_model(scene, kMostTriangles);
  return replay;
}

}  // namespace

ReplayMaker::ReplayMaker(const viewer::ViewScene& scene)
    : maker_(scene), models_(std::async(std::launch::async, [scene] { return models_of(scene); })) {
  say_if_simplified(scene, kMostTriangles, "the report");
}

void ReplayMaker::add(const devices::HapticState& state) {
  if (!first_) {
    // The start is a frame of its own, so that the page counts its time from the first state, as plots do.
    first_ = state.time;
    maker_.add(state);
    end_frame();
    return;
  }
  if ((state.time - *first_) / period_ != frame_ && maker_.has_news()) {
    end_frame();
    if (bytes_ > kMostFrameBytes) leave_out_half();
  }
  frame_ = (state.time - *first_) / period_;
  maker_.add(state);
}

Replay ReplayMaker::finish() {
  if (maker_.has_news()) end_frame();
  Replay replay = models_.get();
  for (const std::string& frame : frames_)
    viewer::append_frame(replay.frames, frame);
  return replay;
}

void ReplayMaker::end_frame() {
  frames_.push_back(maker_.make());
  bytes_ += frames_.back().size();
}

void ReplayMaker::leave_out_half() {
  period_ *= 2;
  bytes_ = 0;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < frames_.size(); i += 2) {
    bytes_ += frames_[i].size();
    if (kept != i) frames_[kept] = std::move(frames_[i]);
    ++kept;
  }
  frames_.resize(kept);
}

}  // namespace glissade::apps
