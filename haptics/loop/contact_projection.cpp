#include "loop/contact_projection.h"

#include <algorithm>
#include <utility>

#include <glissade/contact/spring.h>

#include "loop/loop_settings.h"
#include "loop/smooth.h"

namespace glissade::haptics {

namespace {

/// The motion of the contact point of a row across its normal, metres.
double across(const contact::CoupledRow& row, std::span<const geometry::Displacement> d) {
  const geometry::Displacement& own = d[static_cast<std::size_t>(row.part)];
  Eigen::Vector3d u = own.v + own.w.cross(row.r);
  if (row.other >= 0) {
    const geometry::Displacement& other = d[static_cast<std::size_t>(row.other)];
    u -= other.v + other.w.cross(row.r_other);
  }
  return (u - row.n.dot(u) * row.n).norm();
}

}  // namespace

ContactProjection::ContactProjection(std::size_t parts) : part_count_(parts), solver_(parts * parts * kMaxContactRows) {
  const std::size_t most = parts * kMaxContactRows;
  rows_.reserve(most);
  in_island_.reserve(most);
  numbers_.reserve(most);
}

void ContactProjection::update(const ContactSet& set, std::chrono::nanoseconds age, std::span<const LedPart> parts,
                               double dt) noexcept {
  for (std::size_t p = 0; p < part_count_; ++p) {
    contacts_[p] = {};
    friction_[p] = {};
    rubbing_[p] = 0.0;
    island_[p] = p;
    acts_[p] = parts[p].acts;
    wanted_[p] = {};
    moved_[p] = {};
    way_[p] = {};
    projected_[p] = {};
    pushes_[p] = 0.0;
    known_pushes_[p] = 0.0;
    if (!parts[p].acts) {
      X_WP_[p].reset();
      continue;
    }
    const PartAnswer& answer = set.parts[p];
    wanted_[p] = geometry::displacement_between(answer.X_WV_of_rows, parts[p].X_WG * parts[p].X_GT, answer.p_Vref);
    const geometry::Displacement step = geometry::displacement_between(answer.X_WV_of_rows, answer.X_WV, answer.p_Vref);
    const geometry::Displacement ghost = geometry::displacement_between(answer.X_WG, parts[p].X_WG, answer.p_Vref);
    moved_[p] = {step.v + ghost.v, step.w + ghost.w};
  }
  take_rows(set, age, dt);
  for (std::size_t p = 0; p < part_count_; ++p) {
    if (!acts_[p] || island_[p] != p) continue;
    choose_island(p);
    solve_island(set, parts, dt);
  }
  for (std::size_t p = 0; p < part_count_; ++p) {
    if (pushes_[p] > 0.0) contacts_[p].known = known_pushes_[p] / pushes_[p];
  }
}

// A part in contact moves across the normals as its ghost does, after the step that the rows led to.
void ContactProjection::take_rows(const ContactSet& set, std::chrono::nanoseconds age, double dt) noexcept {
  const double seconds =
      std::chrono::duration<double>(std::clamp<std::chrono::nanoseconds>(age, {}, kFullForce)).count();
  rows_.clear();
  for (const ContactRow& row : set.rows()) {
    const auto part = static_cast<std::size_t>(row.part);
    const auto other = static_cast<std::size_t>(std::max(0, row.other));
    const bool moves_other = row.other >= 0 && acts_[other];
    if (!acts_[part] && !moves_other) continue;
    if (!row.pushes && across(row, moved_) > row.range) continue;
    rows_.push_back({row, age < kFullForce ? row.approach * dt : 0.0, 0.0, &row});
    rows_.back().row.bound += row.approach * seconds;
    if (!acts_[part] || !moves_other) continue;
    const std::size_t low = std::min(island_[part], island_[other]);
    const std::size_t high = std::max(island_[part], island_[other]);
    std::replace(island_.begin(), island_.end(), high, low);
  }
}

/// The island whose lowest part is `first`. A part that does not act stands still, and belongs to no island.
void ContactProjection::choose_island(std::size_t first) noexcept {
  std::int32_t count = 0;
  for (std::size_t p = 0; p < part_count_; ++p)
    local_[p] = acts_[p] && island_[p] == first ? count++ : -1;
  in_island_.clear();
  numbers_.clear();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    contact::CoupledRow row = rows_[i].row;
    row.part = local_[static_cast<std::size_t>(row.part)];
    row.other = row.other < 0 ? -1 : local_[static_cast<std::size_t>(row.other)];
    if (row.part < 0 && row.other < 0) continue;
    if (row.part < 0) {  // seen from the other side, where the part acts
      row.n = -row.n;
      std::swap(row.r, row.r_other);
      std::swap(row.part, row.other);
    }
    in_island_.push_back(row);
    numbers_.push_back(i);
  }
}

void ContactProjection::solve_island(const ContactSet& set, std::span<const LedPart> parts, double dt) noexcept {
  std::array<geometry::Displacement, contact::kMaxParts> wanted;
  std::array<contact::CouplingStiffness, contact::kMaxParts> stiffness{};
  std::size_t count = 0;
  for (std::size_t p = 0; p < part_count_; ++p) {
    if (local_[p] < 0) continue;
    wanted[count] = wanted_[p];
    stiffness[count] = parts[p].stiffness;
    ++count;
  }
  contact::CoupledProjection projection;
  projection.displacements = wanted;
  if (!in_island_.empty()) {
    projection =
        solver_.project({wanted.data(), count}, {stiffness.data(), count}, {in_island_.data(), in_island_.size()});
  }
  const bool is_unsolved = projection.status != contact::ProjectionStatus::kSolved;
  for (std::size_t p = 0; p < part_count_; ++p) {
    if (local_[p] < 0) continue;
    contacts_[p].is_unsolved = is_unsolved;
    const geometry::Displacement& d = projection.displacements[static_cast<std::size_t>(local_[p])];
    const PartAnswer& answer = set.parts[p];
    if (is_unsolved) continue;
    projected_[p] = d;
    move_to(p, geometry::displaced(answer.X_WV_of_rows, answer.p_Vref, d), answer.p_Vref, dt);
  }
  if (is_unsolved) return;
  for (int i = 0; i < projection.active_count; ++i) {
    const auto active = static_cast<std::size_t>(projection.active[static_cast<std::size_t>(i)]);
    add_push(active, projection.force[static_cast<std::size_t>(i)], projection);
  }
  add_friction({stiffness.data(), count}, projection);
}

bool ContactProjection::meets_led_part(std::size_t part) const noexcept {
  if (!acts_[part]) return false;
  for (std::size_t p = 0; p < part_count_; ++p) {
    if (p != part && acts_[p] && island_[p] == island_[part]) return true;
  }
  return false;
}

std::size_t ContactProjection::constraints_of(std::size_t part,
                                              std::span<contact::ConstraintRow> nearest) const noexcept {
  if (!acts_[part] || contacts_[part].is_unsolved) return 0;
  // Pushing rows are before all others.
  std::array<double, kMaxContactRows> order;
  const std::size_t most = std::min(nearest.size(), order.size());
  std::size_t count = 0;
  for (const ActiveRow& active : rows_) {
    const bool is_own = static_cast<std::size_t>(active.row.part) == part;
    const bool is_other = active.row.other >= 0 && static_cast<std::size_t>(active.row.other) == part;
    if (!is_own && !is_other) continue;
    const contact::ConstraintRow row = is_own ? seen_from_part(active.row) : seen_from_other(active.row);
    const double place = active.push > 0.0 ? -active.push : row.velocity(projected_[part]) - row.bound;
    std::size_t at = std::min(count, most);
    while (at > 0 && place < order[at - 1]) {
      if (at < most) {
        order[at] = order[at - 1];
        nearest[at] = nearest[at - 1];
      }
      --at;
    }
    if (at == most) continue;
    order[at] = place;
    nearest[at] = row;
    count = std::min(count + 1, most);
  }
  return count;
}

contact::ConstraintRow ContactProjection::seen_from_part(const contact::CoupledRow& row) const noexcept {
  const double of_other =
      row.other < 0
          ? 0.0
          : contact::ConstraintRow{row.n, row.r_other, 0.0}.velocity(projected_[static_cast<std::size_t>(row.other)]);
  return {row.n, row.r, row.bound + of_other};
}

contact::ConstraintRow ContactProjection::seen_from_other(const contact::CoupledRow& row) const noexcept {
  const double of_part =
      contact::ConstraintRow{row.n, row.r, 0.0}.velocity(projected_[static_cast<std::size_t>(row.part)]);
  return {-row.n, row.r_other, row.bound - of_part};
}

/// Friction holds the parts that it rubs back on the way that the contacts leave them, as a share of the force that
/// their springs exert on this way. It takes no more energy on this way than the friction of the rows would, and is on
/// no part greater than this friction. Another direction, such as that of the rows, would make the hand go round.
void ContactProjection::add_friction(std::span<const contact::CouplingStiffness> stiffness,
                                     const contact::CoupledProjection& projection) noexcept {
  double against_way = 0.0;
  double of_springs = 0.0;
  double share = 1.0;
  const auto each = [&](const auto& take) {
    for (std::size_t p = 0; p < part_count_; ++p) {
      if (local_[p] < 0 || rubbing_[p] == 0.0) continue;
      const auto in_island = static_cast<std::size_t>(local_[p]);
      geometry::Displacement way = projection.displacements[in_island];
      // Parts that press on each other give way together, and that is no way along their contacts.
      const Eigen::Vector3d push = contacts_[p].wrench.f.stableNormalized();
      if (stiffness.size() > 1) way.v -= push.dot(way.v) * push;
      const contact::CouplingStiffness& K = stiffness[in_island];
      take(p, way, contact::Wrench{K.translational * way.v, K.rotational * way.w});
    }
  };
  each([&](std::size_t p, const geometry::Displacement& way, const contact::Wrench& spring) {
    against_way -= friction_[p].f.dot(way.v) + friction_[p].t.dot(way.w);
    of_springs += spring.f.dot(way.v) + spring.t.dot(way.w);
    share = std::min(share, rubbing_[p] / std::max(rubbing_[p], spring.f.norm()));
  });
  if (!(against_way > 0.0)) return;
  share = std::min(share, against_way / of_springs);
  each([&](std::size_t p, const geometry::Displacement& /*way*/, const contact::Wrench& spring) {
    contacts_[p].wrench.f -= share * spring.f;
    contacts_[p].wrench.t -= share * spring.t;
  });
}

/// Notes the way since the last call. A way that no hand can make is none: the part was taken elsewhere.
void ContactProjection::move_to(std::size_t part, const Eigen::Isometry3d& X_WP, const Eigen::Vector3d& p_Vref,
                                double dt) noexcept {
  if (X_WP_[part]) {
    const geometry::Displacement way = geometry::displacement_between(*X_WP_[part], X_WP, p_Vref);
    if (way.v.norm() <= kLoop.fastest_part_m_per_s * dt) way_[part] = way;
  }
  X_WP_[part] = X_WP;
}

/// Adds the force of an active row to the parts on both sides that act.
void ContactProjection::add_push(std::size_t row_number, double push,
                                 const contact::CoupledProjection& projection) noexcept {
  const contact::CoupledRow& projected = in_island_[row_number];
  rows_[numbers_[row_number]].push = push;
  const ContactRow& row = *rows_[numbers_[row_number]].in_set;
  const double known =
      push * smoothly_down(across(projected, projection.displacements) - row.range, kLoop.known_m, kLoop.unknown_m);
  const auto acts = [&](std::int32_t part) { return part >= 0 && acts_[static_cast<std::size_t>(part)]; };
  const auto way_of = [&](std::int32_t part, const Eigen::Vector3d& r) {
    const geometry::Displacement& way = way_[static_cast<std::size_t>(part)];
    return row.n.dot(way.v + way.w.cross(r));
  };
  const auto add = [&](std::int32_t part, const Eigen::Vector3d& r, const Eigen::Vector3d& f,
                       const Eigen::Vector3d& friction, double from_hands) {
    const auto p = static_cast<std::size_t>(part);
    contacts_[p].wrench.f += f;
    contacts_[p].wrench.t += r.cross(f);
    friction_[p].f += friction;
    friction_[p].t += r.cross(friction);
    rubbing_[p] += friction.norm();
    contacts_[p].from_hands += from_hands;
    pushes_[p] += push;
    known_pushes_[p] += known;
  };
  const Eigen::Vector3d f = push * row.n;
  const Eigen::Vector3d friction = push * row.friction_ratio_W;
  const bool is_coupled = acts(row.part) && acts(row.other);
  if (acts(row.part)) {
    add(row.part, row.r, f, friction, is_coupled ? push * way_of(row.other, row.r_other) : 0.0);
    if (!is_coupled)
      contacts_[static_cast<std::size_t>(row.part)].from_movers += push * rows_[numbers_[row_number]].way;
  }
  if (acts(row.other)) add(row.other, row.r_other, -f, -friction, is_coupled ? -push * way_of(row.part, row.r) : 0.0);
}

}  // namespace glissade::haptics
