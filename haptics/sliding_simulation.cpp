#include <algorithm>
#include <numeric>

#include <glissade/haptics/sliding_simulation.h>

namespace glissade::haptics {

geometry::Displacement SlidingSimulation::error() const {
  return geometry::displacement_between(result().X_WV, result().X_WT, part().p_Vref());
}

ContactSet make_contact_set(const SlidingResult& result, const SlidingPart& part, std::int64_t sequence,
                            std::chrono::nanoseconds time, std::vector<std::int32_t>& scratch) {
  const std::vector<Contact>& contacts = result.contacts;
  const auto kept = std::min(contacts.size(), kMaxContactRows);

  ContactSet set;
  set.sequence = sequence;
  set.time = time;
  set.X_WV = result.X_WV;
  set.X_WV_of_rows = result.X_WV_of_contacts;
  set.X_WG = result.X_WG;
  set.X_GT = result.X_WG.inverse(Eigen::Isometry) * result.X_WT;
  set.reach = result.reach;
  set.state = result.state;
  set.pushing = result.pushing;
  set.dropped = static_cast<std::int32_t>(contacts.size() - kept);
  set.row_count = static_cast<std::int32_t>(kept);

  scratch.resize(contacts.size());
  std::iota(scratch.begin(), scratch.end(), 0);
  const auto more_urgent = [&](std::int32_t i, std::int32_t j) {
    const Contact& a = contacts[static_cast<std::size_t>(i)];
    const Contact& b = contacts[static_cast<std::size_t>(j)];
    if ((a.force > 0.0) != (b.force > 0.0)) return a.force > 0.0;
    return a.gap != b.gap ? a.gap < b.gap : i < j;
  };
  std::partial_sort(scratch.begin(), scratch.begin() + static_cast<std::ptrdiff_t>(kept), scratch.end(), more_urgent);

  const Eigen::Vector3d p_Wref = result.X_WV_of_contacts * part.p_Vref();
  for (std::size_t i = 0; i < kept; ++i) {
    const Contact& contact = contacts[static_cast<std::size_t>(scratch[i])];
    set.row_array[i] = {contact.n_W, contact.p_W - p_Wref, std::min(0.0, contact.margin - contact.gap)};
    set.row_array[i].range = contact.range;
    set.row_array[i].approach = contact.approach;
    set.friction_ratio_W[i].setZero();
    if (contact.force > 0.0) set.friction_ratio_W[i] = contact.friction_W / contact.force;
  }
  return set;
}

}  // namespace glissade::haptics
