#include <stdexcept>
#include <utility>

#include <glissade/contact/sliding.h>

namespace glissade::contact {
namespace {

std::vector<HeldPart> held_parts(std::shared_ptr<const SlidingPart> part_V, const Eigen::Isometry3d& X_WV_start,
                                 const SlidingOptions& options, const std::vector<ScriptedPart>& scripted) {
  std::vector<HeldPart> parts{{.part_V = std::move(part_V),
                               .X_WV_start = X_WV_start,
                               .metaphor = options.metaphor,
                               .stiffness = options.stiffness}};
  for (const ScriptedPart& part : scripted)
    parts.push_back(held_by_script(part));
  return parts;
}

}  // namespace

HeldPart held_by_script(const ScriptedPart& part) {
  if (part.part_B == nullptr) throw std::invalid_argument(part.name + " needs a body, not a null pointer");
  const double radius = part.part_B->radius();
  return {.part_V = part.part_B,
          .metaphor = Metaphor::kRubberBandSpring,  // only contacts make it lag behind its script
          .stiffness = CouplingStiffness{part.grip_N_per_m, part.grip_N_per_m * radius * radius},
          .name = part.name,
          .script = PartScript{part.script_X_WB, part.start}};
}

Sliding::Sliding(std::vector<Obstacle> obstacles, std::shared_ptr<const SlidingPart> part_V,
                 const Eigen::Isometry3d& X_WV_start, const SlidingOptions& options,
                 const std::vector<ScriptedPart>& scripted)
    : sliding_(std::move(obstacles), held_parts(std::move(part_V), X_WV_start, options, scripted), options.rules),
      scripted_X_WB_(scripted.size()),
      ghosts_X_WG_(sliding_.part_count(), Eigen::Isometry3d::Identity()) {
  for (std::size_t i = 0; i < scripted_X_WB_.size(); ++i)
    scripted_X_WB_[i] = sliding_.result(i + 1).X_WV;
}

const SlidingResult& Sliding::advance(const Eigen::Isometry3d& X_WG, double milliseconds) {
  ghosts_X_WG_[0] = X_WG;
  sliding_.advance(ghosts_X_WG_, milliseconds);
  for (std::size_t i = 0; i < scripted_X_WB_.size(); ++i)
    scripted_X_WB_[i] = sliding_.result(i + 1).X_WV;
  return sliding_.result(0);
}

}  // namespace glissade::contact
