#pragma once

/// One interface to compare two methods of sliding contact: the method of `contact::Sliding`, and the method of the
/// founding paper, *Natural Interaction in Virtual Environments*, §3.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/sliding.h>
#include <glissade/contact/spring.h>

namespace glissade::reference {

/// The simulation of one part in the hand. Its functions are those of `contact::Sliding`. Not thread-safe.
class SlidingSimulation {
 public:
  SlidingSimulation() = default;
  SlidingSimulation(const SlidingSimulation&) = delete;
  SlidingSimulation& operator=(const SlidingSimulation&) = delete;
  virtual ~SlidingSimulation() = default;

  /// With the paper's method and force feedback, an offset between hand and part exerts the full spring force on the
  /// hand.
  virtual void grasp(const Eigen::Isometry3d& X_WG) = 0;
  virtual void release() = 0;
  virtual const contact::SlidingResult& advance(const Eigen::Isometry3d& X_WG, double milliseconds = 1.0) = 0;

  virtual const contact::SlidingResult& result() const = 0;
  /// Empty for methods without scripted parts.
  virtual std::span<const Eigen::Isometry3d> scripted_X_WB() const { return {}; }
  virtual const contact::SlidingPart& part() const = 0;
  virtual const contact::CouplingStiffness& stiffness() const = 0;
  /// The largest gap of a reported contact of the paper's method; see `Contact::margin`.
  virtual double margin() const = 0;
  /// Number of collision checks or contact searches since construction.
  virtual std::int64_t queries() const = 0;

  /// The states of the method's state machine in the last call, in order, such as
  /// "moving>bisecting>classifying>new-direction>criterion>done". Empty for methods without a state machine.
  virtual std::string trace() const { return {}; }

  geometry::Displacement lag() const;
};

/// The methods of sliding contact.
enum class SlidingMethod : std::uint8_t {
  kProjection,  ///< `contact::Sliding`: sequential projection with a margin and a certificate
  kPaper,       ///< the founding paper's bisection and classification of contacts (paper §3)
};

/// Command-line names of the methods, in the order of the values of `SlidingMethod`.
inline constexpr std::array<std::string_view, 2> kSlidingMethodNames{"projection", "paper"};

inline std::string_view name_of(SlidingMethod method) {
  return kSlidingMethodNames[static_cast<std::size_t>(method)];
}

/// The method with this name; no value for an unknown name.
std::optional<SlidingMethod> sliding_method_from_name(std::string_view name);

/// The simulation of one part by either method. `kProjection` throws what the constructor of `Sliding` throws. `kPaper`
/// uses the metaphor and stiffness of the options, and ignores the rules and the margins of obstacles. `kPaper` throws
/// std::invalid_argument in these cases: a part is scripted; there is no obstacle; a pointer is null;
/// `geometry::rigid_pose` rejects a pose; or the part collides with an obstacle at the start.
std::unique_ptr<SlidingSimulation> make_sliding(SlidingMethod method, std::vector<contact::Obstacle> obstacles,
                                                std::shared_ptr<const contact::SlidingPart> part_V,
                                                const Eigen::Isometry3d& X_WV_start,
                                                const contact::SlidingOptions& options = {},
                                                const std::vector<contact::ScriptedPart>& scripted = {});

}  // namespace glissade::reference
