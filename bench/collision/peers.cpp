#include "subject.h"

namespace glissade::bench {

std::vector<Subject> peers() {
  return {fcl_subject(), ode_subject(), bullet_subject(), cgal_subject()};
}

std::vector<Subject> peers_that_count_pairs() {
  return {fcl_subject(), ode_subject(), bullet_subject()};
}

}  // namespace glissade::bench
