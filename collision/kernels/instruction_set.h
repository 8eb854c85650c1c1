#pragma once

/// Which vector instructions the collision queries use. They choose the best of this processor by themselves; tests and
/// benchmarks choose others, to compare.

#include <string_view>
#include <vector>

namespace glissade::collision {

enum class InstructionSet { kScalar, kSse4, kAvx2, kAvx512, kNeon };

/// "scalar", "sse4", "avx2", "avx512", "neon".
std::string_view name_of(InstructionSet instruction_set);

/// Those that this processor and this build have, the best first.
std::vector<InstructionSet> available_instruction_sets();

/// Makes all queries of this process use that one. Not to be called while a query runs.
/// Throws std::invalid_argument when it is not available.
void use_instruction_set(InstructionSet instruction_set);

}  // namespace glissade::collision
