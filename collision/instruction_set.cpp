#include <stdexcept>
#include <string>

#include <glissade/collision/instruction_set.h>

namespace glissade::collision {

std::string_view name(InstructionSet instruction_set) {
  switch (instruction_set) {
    case InstructionSet::kScalar:
      return "scalar";
    case InstructionSet::kSse4:
      return "sse4";
    case InstructionSet::kAvx2:
      return "avx2";
    case InstructionSet::kAvx512:
      return "avx512";
    case InstructionSet::kNeon:
      return "neon";
  }
  return "unknown";
}

std::vector<InstructionSet> available_instruction_sets() {
  return {InstructionSet::kScalar};
}

InstructionSet instruction_set() {
  return InstructionSet::kScalar;
}

void use_instruction_set(InstructionSet instruction_set) {
  if (instruction_set != InstructionSet::kScalar) {
    throw std::invalid_argument("instruction set " + std::string(name(instruction_set)) + " is not available");
  }
}

}  // namespace glissade::collision
