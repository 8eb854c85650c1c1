#include "kernels/instruction_set.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include <hwy/highway.h>
#include <hwy/targets.h>

namespace glissade::collision {
namespace {

struct Target {
  InstructionSet instruction_set;
  std::int64_t bit;
  std::string_view name;
};

// The best first. Every processor supports plain C++.
constexpr std::array<Target, 5> kTargets{{{InstructionSet::kAvx512, HWY_AVX3, "avx512"},
                                          {InstructionSet::kAvx2, HWY_AVX2, "avx2"},
                                          {InstructionSet::kSse4, HWY_SSE4, "sse4"},
                                          {InstructionSet::kNeon, HWY_NEON, "neon"},
                                          {InstructionSet::kScalar, HWY_EMU128, "scalar"}}};

const Target& target_of(InstructionSet instruction_set) {
  return *std::find_if(kTargets.begin(), kTargets.end(),
                       [&](const Target& target) { return target.instruction_set == instruction_set; });
}

}  // namespace

std::string_view name_of(InstructionSet instruction_set) {
  return target_of(instruction_set).name;
}

std::vector<InstructionSet> available_instruction_sets() {
  std::vector<InstructionSet> available;
  for (const Target& target : kTargets) {
    const bool is_plain = target.instruction_set == InstructionSet::kScalar;
    if (is_plain || (hwy::SupportedTargets() & HWY_TARGETS & target.bit) != 0) {
      available.push_back(target.instruction_set);
    }
  }
  return available;
}

void use_instruction_set(InstructionSet instruction_set) {
  const auto available = available_instruction_sets();
  if (std::find(available.begin(), available.end(), instruction_set) == available.end()) {
    throw std::invalid_argument("this processor does not have the instruction set " +
                                std::string(name_of(instruction_set)));
  }
  hwy::GetChosenTarget().Update(target_of(instruction_set).bit);
}

}  // namespace glissade::collision
