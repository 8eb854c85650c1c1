#include <algorithm>
#include <stdexcept>
#include <utility>

#include <glissade/contact/spring.h>
#include <glissade/reference/sliding_method.h>

#include "paper/paper_sliding.h"

namespace glissade::reference {
namespace {

class ProjectionSliding final : public SlidingSimulation {
 public:
  explicit ProjectionSliding(contact::Sliding sliding) : sliding_(std::move(sliding)) {}

  void grasp(const Eigen::Isometry3d& X_WG) override { sliding_.grasp(X_WG); }
  void release() override { sliding_.release(); }
  const contact::SlidingResult& advance(const Eigen::Isometry3d& X_WG, double milliseconds) override {
    return sliding_.advance(X_WG, milliseconds);
  }
  const contact::SlidingResult& result() const override { return sliding_.result(); }
  std::span<const Eigen::Isometry3d> scripted_X_WB() const override { return sliding_.scripted_X_WB(); }
  const contact::SlidingPart& part() const override { return sliding_.part(); }
  const contact::CouplingStiffness& stiffness() const override { return sliding_.stiffness(); }
  double margin() const override { return sliding_.margin(); }
  std::int64_t queries() const override { return sliding_.search_statistics().searches; }

 private:
  contact::Sliding sliding_;
};

}  // namespace

geometry::Displacement SlidingSimulation::lag() const {
  return geometry::displacement_between(result().X_WV, result().X_WT, part().p_Vref());
}

std::optional<SlidingMethod> sliding_method_from_name(std::string_view name) {
  const auto* const found = std::find(kSlidingMethodNames.begin(), kSlidingMethodNames.end(), name);
  if (found == kSlidingMethodNames.end()) return std::nullopt;
  return static_cast<SlidingMethod>(found - kSlidingMethodNames.begin());
}

std::unique_ptr<SlidingSimulation> make_sliding(SlidingMethod method, std::vector<contact::Obstacle> obstacles,
                                                std::shared_ptr<const contact::SlidingPart> part_V,
                                                const Eigen::Isometry3d& X_WV_start,
                                                const contact::SlidingOptions& options,
                                                const std::vector<contact::ScriptedPart>& scripted) {
  if (method == SlidingMethod::kPaper) {
    if (!scripted.empty()) {
      throw std::invalid_argument(scripted.front().name + " moves, which the paper's method does not know");
    }
    return std::make_unique<PaperSliding>(
        std::move(obstacles), std::move(part_V), X_WV_start,
        PaperSlidingOptions{.metaphor = options.metaphor, .stiffness = options.stiffness});
  }
  return std::make_unique<ProjectionSliding>(
      contact::Sliding(std::move(obstacles), std::move(part_V), X_WV_start, options, scripted));
}

}  // namespace glissade::reference
