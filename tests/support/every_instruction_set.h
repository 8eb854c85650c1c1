#pragma once

/// Tests of vector code, once for each instruction set of the processor.

#include <string>

#include <gtest/gtest.h>

#include "kernels/instruction_set.h"

namespace glissade::test_support {

/// All vector code of the process uses the instruction set of the parameter as long as the object lives.
class EveryInstructionSet : public ::testing::TestWithParam<collision::InstructionSet> {
 public:
  static auto all() { return ::testing::ValuesIn(collision::available_instruction_sets()); }
  static std::string name(const ::testing::TestParamInfo<collision::InstructionSet>& test) {
    return std::string(collision::name_of(test.param));
  }

 protected:
  EveryInstructionSet() { collision::use_instruction_set(GetParam()); }
  ~EveryInstructionSet() override { collision::use_instruction_set(collision::available_instruction_sets().front()); }
};

}  // namespace glissade::test_support
