#pragma once

/// Lists of subjects that benches compare.

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

/// Glissade first, then other instruction sets, then all other libraries.
inline std::vector<Subject> usual_subjects() {
  return join({{glissade_subject()}, glissade_instruction_sets(), peers()});
}

inline const std::vector<std::string> kPeers{"fcl", "ode", "bullet", "cgal"};

}  // namespace glissade::bench
