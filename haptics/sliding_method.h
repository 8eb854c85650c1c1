#pragma once

/// The methods of sliding contact by name, and the one place that makes a simulation of any of them.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/haptics/sliding.h>
#include <glissade/haptics/sliding_simulation.h>

namespace glissade::haptics {

enum class SlidingMethod : std::uint8_t {
  kProjection,  ///< sequential projection with margin and certificate (`sliding.h`)
  kPaper,       ///< the founding paper's bisection and classification (`paper_sliding.h`)
};

/// In the order of their numbers, as on the command line.
inline constexpr std::array<std::string_view, 2> kSlidingMethodNames{"projection", "paper"};

inline std::string_view name_of(SlidingMethod method) {
  return kSlidingMethodNames[static_cast<std::size_t>(method)];
}

/// None for any other name.
std::optional<SlidingMethod> sliding_method_from_name(std::string_view name);

/// The simulation of one part among obstacles. The paper's method takes metaphor and stiffness of the options, and
/// knows none of the rules and no scripted parts: it throws std::invalid_argument for these. Throws it otherwise as the
/// constructors of `Sliding` and `PaperSliding` do.
std::unique_ptr<SlidingSimulation> make_sliding(SlidingMethod method, std::vector<Obstacle> obstacles,
                                                std::shared_ptr<const SlidingPart> part_V,
                                                const Eigen::Isometry3d& X_WV_start, const SlidingOptions& options = {},
                                                std::vector<ScriptedPart> scripted = {});

}  // namespace glissade::haptics
