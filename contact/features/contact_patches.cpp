#include <algorithm>
#include <numeric>

#include <glissade/contact/tracked_contacts.h>

namespace glissade::contact {
namespace {

constexpr double kCosOfOnePatch = 0.984807753012208;  // 10°

const Contact& contact_at(std::span<const TrackedContact> contacts, std::int32_t index) {
  return contacts[static_cast<std::size_t>(index)].contact;
}

ContactPatch patch_of(std::span<const TrackedContact> contacts, std::span<const std::int32_t> members) {
  double total = 0.0;
  for (const std::int32_t m : members)
    total += contact_at(contacts, m).force;
  ContactPatch patch;
  const Contact& first = contact_at(contacts, members.front());
  patch.id = contacts[static_cast<std::size_t>(members.front())].id;
  patch.obstacle = first.obstacle;
  patch.count = static_cast<std::int32_t>(members.size());
  patch.gap = first.gap;
  Eigen::Vector3d n_sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();  // from the first point, so that small distances keep their digits
  double weights = 0.0;
  for (const std::int32_t m : members) {
    const Contact& contact = contact_at(contacts, m);
    const double weight = total > 0.0 ? contact.force : 1.0;
    weights += weight;
    n_sum += weight * contact.n_W;
    arm += weight * (contact.p_W - first.p_W);
    patch.force_on_part_W += contact.force * contact.n_W + contact.friction_W;
    patch.gap = std::min(patch.gap, contact.gap);
  }
  patch.n_W = n_sum.normalized();
  patch.p_W = first.p_W + arm / weights;
  for (const std::int32_t m : members)
    patch.extent = std::max(patch.extent, (contact_at(contacts, m).p_W - patch.p_W).norm());
  return patch;
}

}  // namespace

std::span<const ContactPatch> ContactPatches::merge(std::span<const TrackedContact> contacts) {
  patches_.clear();
  by_age_.resize(contacts.size());
  std::iota(by_age_.begin(), by_age_.end(), 0);
  std::sort(by_age_.begin(), by_age_.end(), [&](std::int32_t a, std::int32_t b) {
    return contacts[static_cast<std::size_t>(a)].id < contacts[static_cast<std::size_t>(b)].id;
  });
  while (!by_age_.empty()) {
    const Contact& founder = contact_at(contacts, by_age_.front());
    const auto joins = [&](std::int32_t i) {
      const Contact& contact = contact_at(contacts, i);
      return contact.part == founder.part && contact.obstacle == founder.obstacle &&
             contact.n_W.dot(founder.n_W) >= kCosOfOnePatch &&
             std::abs(founder.n_W.dot(contact.p_W - founder.p_W)) <= plane_tolerance_;
    };
    members_.clear();
    std::copy_if(by_age_.begin(), by_age_.end(), std::back_inserter(members_), joins);
    std::erase_if(by_age_, joins);
    patches_.push_back(patch_of(contacts, members_));
  }
  return patches_;
}

}  // namespace glissade::contact
