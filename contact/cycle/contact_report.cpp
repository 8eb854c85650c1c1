#include "cycle/contact_report.h"

#include <algorithm>
#include <array>

#include "features/contact_motion.h"

namespace glissade::contact {
namespace {

/// To the caller, an inset is its part.
void hide_insets(const SimulatedParts& shared, std::vector<Contact>& contacts) {
  if (shared.seats.empty()) return;
  const std::int32_t first = shared.scene.rider(shared.inset_of_seat(0));
  for (Contact& contact : contacts) {
    if (contact.rider >= first) contact.rider = -1;
  }
}

void add_overlaps(const SimulatedParts& shared, std::span<const WayOut> ways_out, std::vector<Contact>& contacts) {
  const auto obstacles = static_cast<std::int32_t>(shared.scene.obstacles().size());
  for (const WayOut& way : ways_out) {
    const Seat& seat = shared.seats[way.seat];
    Contact& contact = contacts.emplace_back();
    contact.kind = ContactKind::kOverlap;
    contact.part = seat.bodies.part - obstacles;
    contact.obstacle = seat.bodies.obstacle;
    contact.n_W = way.n_W;
    const HeldPartState& part = shared.states[static_cast<std::size_t>(contact.part)];
    contact.p_W = part.result.X_WV_of_contacts * part.p_Vref;
    contact.gap = -way.left;
    contact.margin = seat.margin;
  }
}

/// Speed along n_W (m/s) of the point q_W of a part that moved in a call of so many milliseconds.
double speed_along(const Eigen::Vector3d& n_W, const Eigen::Vector3d& q_W, const HeldPartState& part,
                   double milliseconds) {
  if (milliseconds <= 0.0) return 0.0;
  const Eigen::Isometry3d motion_W = part.result.X_WV * part.X_WV_before.inverse(Eigen::Isometry);
  return n_W.dot(q_W - motion_W.inverse(Eigen::Isometry) * q_W) / (1e-3 * milliseconds);
}

/// A result has one pose for its contacts, that of its part. Therefore contacts are carried along to the present poses
/// of both sides.
void distribute(SimulatedParts& shared, const std::vector<Contact>& contacts, double milliseconds) {
  std::vector<HeldPartState>& parts = shared.states;
  const ContactScene& scene = shared.scene;
  std::array<Eigen::Isometry3d, kMaxParts> motions;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    SlidingResult& result = parts[p].result;
    motions[p] = result.X_WV * result.X_WV_of_contacts.inverse(Eigen::Isometry);
    result.X_WV_of_contacts = result.X_WV;
    result.contacts.clear();
  }
  for (const Contact& found : contacts) {
    const auto number = static_cast<std::size_t>(found.part);
    const std::int32_t other = scene.leader(found.obstacle);
    if (other == ContactScene::kStands) {
      parts[number].result.contacts.push_back(carried(found, motions[number]));
      continue;
    }
    HeldPartState& other_part = parts[static_cast<std::size_t>(other)];
    Contact contact = carried(found, motions[number], motions[static_cast<std::size_t>(other)]);
    const std::size_t own_mover =
        found.rider < 0 ? number : scene.first_rider() + static_cast<std::size_t>(found.rider);
    Contact mirror = mirrored(contact, static_cast<std::int32_t>(scene.body_of_mover(own_mover)));
    mirror.part = other;
    mirror.rider = scene.rider(found.obstacle);
    contact.approach = speed_along(contact.n_W, contact.q_W(), other_part, milliseconds);
    mirror.approach = speed_along(mirror.n_W, mirror.q_W(), parts[number], milliseconds);
    parts[number].result.contacts.push_back(contact);
    other_part.result.contacts.push_back(mirror);
  }
}

}  // namespace

void report_contacts(SimulatedParts& shared, std::span<const WayOut> ways_out, std::vector<Contact>& contacts,
                     double milliseconds) {
  hide_insets(shared, contacts);
  add_overlaps(shared, ways_out, contacts);
  if (shared.count() == 1) {
    std::swap(shared.states.front().result.contacts, contacts);
  } else {
    distribute(shared, contacts, milliseconds);
  }
  for (HeldPartState& part : shared.states) {
    SlidingResult& result = part.result;
    result.pushing = static_cast<int>(std::count_if(result.contacts.begin(), result.contacts.end(),
                                                    [](const Contact& contact) { return contact.force > 0.0; }));
    if (part.is_held()) continue;
    result.contacts.clear();
    result.pushing = 0;
  }
}

}  // namespace glissade::contact
