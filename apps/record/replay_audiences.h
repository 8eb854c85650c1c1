#pragma once

/// Audiences of a replay: browsers, at the pace of the recording, and a report.

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glissade/apps/record/offline_replay.h>
#include <glissade/apps/run/session.h>
#include <glissade/viewer/view_server.h>

namespace glissade::apps {

/// Shows each run at the pace at which it was recorded, once a page looks on.
class ReplayView final : public ReplayAudience {
 public:
  explicit ReplayView(std::uint16_t port) : port_(port) {}

  void begin(const HapticScene& scene, const SlidingChoice& choice, std::chrono::nanoseconds period,
             const std::vector<std::int64_t>& devices,
             const std::vector<std::shared_ptr<const grasping::HandModel>>& models) override;
  bool take(const devices::HapticState& state) override;

 private:
  std::uint16_t port_;
  std::unique_ptr<viewer::ViewServer> server_;
  std::optional<std::chrono::steady_clock::time_point> start_;
  std::chrono::nanoseconds first_{0};  // time of the first state
};

/// Keeps the last minute of the last run for a report as that of the run itself.
class ReplayReport final : public ReplayAudience {
 public:
  explicit ReplayReport(std::string title) : title_(std::move(title)) {}

  void begin(const HapticScene& scene, const SlidingChoice& choice, std::chrono::nanoseconds period,
             const std::vector<std::int64_t>& devices,
             const std::vector<std::shared_ptr<const grasping::HandModel>>& models) override;
  bool take(const devices::HapticState& state) override;

  /// Writes the page; returns its path.
  std::string write(const std::string& folder) const;

 private:
  std::string title_;
  std::optional<HapticScene> scene_;
  Session session_;
  std::shared_ptr<SessionRecorder> samples_;
};

}  // namespace glissade::apps
