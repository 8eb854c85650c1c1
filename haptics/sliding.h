#pragma once

/// Sliding contact of one part: the visible part follows the ghost as closely as the obstacles allow. The ghost is the
/// pose that the part would have if nothing were in the way. A part that starts apart from all other bodies never gets
/// inside one, neither at rest nor on its way. `Sliding` is the method to use; `make_sliding` also offers, for
/// comparison, the method of the founding paper, *Natural Interaction in Virtual Environments*, §3.

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/pose_trajectory.h>
#include <glissade/haptics/multi_part_sliding.h>
#include <glissade/haptics/sliding_simulation.h>

namespace glissade::haptics {

struct SlidingOptions {
  Metaphor metaphor = Metaphor::kForceFeedback;
  std::optional<CouplingStiffness> stiffness{};  ///< default: `default_stiffness` of the part's radius
  SlidingRules rules{};
};

/// A part that moves on its own or in the other hand. Its script gives the poses of its ghost over time: the part
/// follows the script as far as contacts allow.
struct ScriptedPart {
  std::shared_ptr<const SlidingPart> part_B;
  geometry::PoseTrajectory script_X_WB;
  std::chrono::nanoseconds start{0};  ///< time of the script when the simulation begins
  /// Stiffness against translation, k_t; the stiffness against rotation is k_t ρ², with ρ the radius of the part. The
  /// default is a thousand times the default stiffness of a hand, so that the scripted part pushes other parts and is
  /// hardly pushed by them. With the stiffness of a hand, the script acts as another hand.
  double grip_N_per_m = 1e6;
  std::string name = "a moving part";  ///< for messages
};

/// The same for `MultiPartSliding`. Throws std::invalid_argument, naming the part, for a null pointer.
HeldPart held_by_script(const ScriptedPart& part);

/// The simulation of one part among fixed obstacles and scripted parts: `MultiPartSliding` with the part first and the
/// scripted parts after it. Deterministic: the same calls give the same bits. Not thread-safe; several simulations may
/// share bodies.
class Sliding final : public SlidingSimulation {
 public:
  /// Throws std::invalid_argument as `MultiPartSliding` does.
  Sliding(std::vector<Obstacle> obstacles, std::shared_ptr<const SlidingPart> part_V,
          const Eigen::Isometry3d& X_WV_start, const SlidingOptions& options = {},
          const std::vector<ScriptedPart>& scripted = {});

  void grasp(const Eigen::Isometry3d& X_WG) override { sliding_.grasp(0, X_WG); }
  void release() override { sliding_.release(0); }
  /// Also advances the scripts by `milliseconds`, even while the part is released or stays where it is because X_WG is
  /// not a rigid pose.
  const SlidingResult& advance(const Eigen::Isometry3d& X_WG, double milliseconds = 1.0) override;

  const SlidingResult& result() const override { return sliding_.result(0); }
  const SlidingPart& part() const override { return sliding_.part(0); }
  const CouplingStiffness& stiffness() const override { return sliding_.stiffness(0); }
  double margin() const override { return sliding_.margin(0); }
  std::span<const Eigen::Isometry3d> scripted_X_WB() const override { return scripted_X_WB_; }
  SearchStatistics search_statistics() const override { return sliding_.search_statistics(); }
  CallStatistics call_statistics() const { return sliding_.call_statistics(); }

  /// Minimum clearance (metres): the distance that the part keeps on every step from obstacles that have no margin of
  /// their own, as proved before the step. A step that starts nearer to an obstacle keeps 95 % of the distance at its
  /// start.
  double min_clearance() const { return kMinClearanceOfMargin * margin(); }

 private:
  friend struct SceneAccess;
  MultiPartSliding sliding_;
  std::vector<Eigen::Isometry3d> scripted_X_WB_;
  std::vector<Eigen::Isometry3d> ghosts_X_WG_;  // one for each part; only the first counts
};

/// The methods of sliding contact.
enum class SlidingMethod : std::uint8_t {
  kProjection,  ///< `Sliding`: sequential projection with a margin and a certificate (`multi_part_sliding.h`)
  kPaper,       ///< the founding paper's bisection and classification of contacts (paper §3)
};

/// Names of the methods, as on the command line, in the order of the values of `SlidingMethod`.
inline constexpr std::array<std::string_view, 2> kSlidingMethodNames{"projection", "paper"};

inline std::string_view name_of(SlidingMethod method) {
  return kSlidingMethodNames[static_cast<std::size_t>(method)];
}

/// The method with this name; nothing for an unknown name.
std::optional<SlidingMethod> sliding_method_from_name(std::string_view name);

/// The simulation of one part by either method. For `kProjection`, throws as the constructor of `Sliding` does. The
/// paper's method uses the metaphor and stiffness of the options, and ignores the rules and the margins of obstacles.
/// For `kPaper`, throws std::invalid_argument for scripted parts, if there is no obstacle, for null pointers, for poses
/// that `geometry::rigid_pose` rejects, and for a part that collides with an obstacle at its start.
std::unique_ptr<SlidingSimulation> make_sliding(SlidingMethod method, std::vector<Obstacle> obstacles,
                                                std::shared_ptr<const SlidingPart> part_V,
                                                const Eigen::Isometry3d& X_WV_start, const SlidingOptions& options = {},
                                                const std::vector<ScriptedPart>& scripted = {});

}  // namespace glissade::haptics
