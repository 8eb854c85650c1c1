#pragma once

/// The vector instruction set of the collision queries. The default is the best one of the processor; tests and
/// benchmarks choose others for comparison.

#include <string_view>
#include <vector>

namespace glissade::collision {

enum class InstructionSet { kScalar, kSse4, kAvx2, kAvx512, kNeon };

/// "scalar", "sse4", "avx2", "avx512", "neon".
std::string_view name_of(InstructionSet instruction_set);

/// The instruction sets that this processor and this build support, the best first.
std::vector<InstructionSet> available_instruction_sets();

/// Makes all queries of this process use that instruction set. Must not be called while a query runs. Throws
/// std::invalid_argument if it is not available.
void use_instruction_set(InstructionSet instruction_set);

}  // namespace glissade::collision
