#pragma once

/// Lists of subjects that benches compare. Glissade is the first.

#include <initializer_list>
#include <vector>

#include "subject.h"

namespace glissade::bench {

inline std::vector<Subject> join(std::initializer_list<std::vector<Subject>> lists) {
  std::vector<Subject> all;
  for (const std::vector<Subject>& list : lists)
    all.insert(all.end(), list.begin(), list.end());
  return all;
}

/// Those that take all poses.
inline std::vector<Subject> fast_subjects(bool with_instruction_sets) {
  return join({{glissade_subject()},
               with_instruction_sets ? glissade_instruction_sets() : std::vector<Subject>{},
               {fcl_subject()}});
}

/// Those that take a sample, because all poses would take hours.
inline std::vector<Subject> sample_subjects() {
  return {glissade_subject(), ode_subject(), bullet_subject(), cgal_subject()};
}

}  // namespace glissade::bench
