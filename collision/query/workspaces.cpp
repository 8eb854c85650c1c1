#include <glissade/collision/query_types.h>

#include "query/coherent_front.h"
#include "query/dop_traversal.h"

namespace glissade::collision {

QueryWorkspace::QueryWorkspace() : memory_(std::make_unique<QueryMemory>()) {}
QueryWorkspace::~QueryWorkspace() = default;
QueryWorkspace::QueryWorkspace(QueryWorkspace&&) noexcept = default;
QueryWorkspace& QueryWorkspace::operator=(QueryWorkspace&&) noexcept = default;

const QueryCounters& QueryWorkspace::counters() const {
  return memory_->counters;
}

void QueryWorkspace::set_meter(WorkMeter* meter) {
  memory_->meter = meter;
}

CoherentWorkspace::CoherentWorkspace() : front_(std::make_unique<CoherentFront>()) {}
CoherentWorkspace::~CoherentWorkspace() = default;
CoherentWorkspace::CoherentWorkspace(CoherentWorkspace&&) noexcept = default;
CoherentWorkspace& CoherentWorkspace::operator=(CoherentWorkspace&&) noexcept = default;

void CoherentWorkspace::forget() {
  front_->clear();
}

}  // namespace glissade::collision
