#include <algorithm>
#include <stdexcept>
#include <utility>

#include <glissade/haptics/paper_sliding.h>
#include <glissade/haptics/sliding_method.h>

namespace glissade::haptics {

std::optional<SlidingMethod> sliding_method_from_name(std::string_view name) {
  const auto* const found = std::find(kSlidingMethodNames.begin(), kSlidingMethodNames.end(), name);
  if (found == kSlidingMethodNames.end()) return std::nullopt;
  return static_cast<SlidingMethod>(found - kSlidingMethodNames.begin());
}

std::unique_ptr<SlidingSimulation> make_sliding(SlidingMethod method, std::vector<Obstacle> obstacles,
                                                std::shared_ptr<const SlidingPart> part_V,
                                                const Eigen::Isometry3d& X_WV_start, const SlidingOptions& options,
                                                std::vector<ScriptedPart> scripted) {
  if (method == SlidingMethod::kPaper) {
    if (!scripted.empty()) {
      throw std::invalid_argument(scripted.front().name + " moves, which the paper's method does not know");
    }
    return std::make_unique<PaperSliding>(
        std::move(obstacles), std::move(part_V), X_WV_start,
        PaperSlidingOptions{.metaphor = options.metaphor, .stiffness = options.stiffness});
  }
  return std::make_unique<Sliding>(std::move(obstacles), std::move(part_V), X_WV_start, options, std::move(scripted));
}

}  // namespace glissade::haptics
