#include "loop/contact_set_maker.h"

#include <algorithm>

namespace glissade::haptics {
namespace {

class SetMaker {
 public:
  SetMaker(const contact::MultiPartSliding& sliding, ContactSet& set, std::vector<UrgentContact>& scratch)
      : sliding_(sliding), set_(set), order_(scratch) {}

  void add(std::size_t p) {
    const contact::SlidingResult& result = sliding_.result(p);
    PartAnswer& part = set_.parts[p] = {};
    part.p_Vref = sliding_.p_Vref(p);
    part.X_WV = result.X_WV;
    part.X_WV_of_rows = result.X_WV_of_contacts;
    part.X_WG = result.X_WG;
    part.X_GT = result.X_WG.inverse(Eigen::Isometry) * result.X_WT;
    part.reach = result.reach;
    part.state = result.state;
    part.pushing = result.pushing;
    if (!is_led_by_hand(p)) return;
    choose_contacts(p);
    const std::size_t kept = std::min(order_.size(), kMaxContactRows);
    part.dropped = static_cast<std::int32_t>(order_.size() - kept);
    for (std::size_t i = 0; i < kept; ++i)
      add_row(p, result.contacts[static_cast<std::size_t>(order_[i].number)]);
  }

 private:
  bool is_led_by_hand(std::size_t p) const {
    return !sliding_.is_scripted(p) && sliding_.result(p).state != contact::SlidingState::kReleased;
  }

  /// The part on the other side of the contact, if a hand leads it; otherwise −1.
  std::int32_t other_of(const contact::Contact& contact) const {
    const std::int32_t other = sliding_.part_of_body(contact.obstacle);
    return other >= 0 && is_led_by_hand(static_cast<std::size_t>(other)) ? other : -1;
  }

  /// The most urgent contacts come first. A contact of two parts is in the results of both.
  void choose_contacts(std::size_t p) {
    const std::vector<contact::Contact>& contacts = sliding_.result(p).contacts;
    order_.clear();
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const std::int32_t other = other_of(contacts[i]);
      if (other < 0 || other > static_cast<std::int32_t>(p))
        order_.push_back({contacts[i].gap, static_cast<std::int32_t>(i), contacts[i].force > 0.0});
    }
    const auto more_urgent = [](const UrgentContact& a, const UrgentContact& b) {
      if (a.pushes != b.pushes) return a.pushes;
      return a.gap != b.gap ? a.gap < b.gap : a.number < b.number;
    };
    const auto kept = order_.begin() + static_cast<std::ptrdiff_t>(std::min(order_.size(), kMaxContactRows));
    std::nth_element(order_.begin(), kept, order_.end(), more_urgent);  // the order is total
    std::sort(order_.begin(), kept, more_urgent);
  }

  void add_row(std::size_t p, const contact::Contact& contact) {
    const contact::ConstraintRow constraint{contact.n_W, contact.p_W - p_Wref(p),
                                            std::min(0.0, contact.margin - contact.gap)};
    ContactRow& row = set_.row_array[static_cast<std::size_t>(set_.row_count++)];
    row = {{constraint, static_cast<std::int32_t>(p), other_of(contact)}, contact.range};
    row.pushes = contact.force > 0.0;
    if (row.pushes) row.friction_ratio_W = contact.friction_W / contact.force;
    if (row.other < 0) {
      row.approach = contact.approach;
    } else {
      row.r_other = contact.p_W - p_Wref(static_cast<std::size_t>(row.other));
    }
  }

  Eigen::Vector3d p_Wref(std::size_t p) const { return sliding_.result(p).X_WV_of_contacts * sliding_.p_Vref(p); }

  const contact::MultiPartSliding& sliding_;
  ContactSet& set_;
  std::vector<UrgentContact>& order_;
};

}  // namespace

ContactSet make_contact_set(const contact::MultiPartSliding& sliding, std::int64_t sequence,
                            std::chrono::nanoseconds time, std::vector<UrgentContact>& scratch) {
  ContactSet set;
  renew_contact_set(sliding, sequence, time, scratch, set);
  return set;
}

void renew_contact_set(const contact::MultiPartSliding& sliding, std::int64_t sequence, std::chrono::nanoseconds time,
                       std::vector<UrgentContact>& scratch, ContactSet& set) {
  set.sequence = sequence;
  set.time = time;
  set.row_count = 0;
  set.part_count = static_cast<std::int32_t>(sliding.part_count());
  SetMaker maker(sliding, set, scratch);
  for (std::size_t p = 0; p < sliding.part_count(); ++p)
    maker.add(p);
}

}  // namespace glissade::haptics
