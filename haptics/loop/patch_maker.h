#pragma once

/// The patches of a contact set, for displays.

#include <vector>

#include <glissade/contact/multi_part_sliding.h>
#include <glissade/contact/tracked_contacts.h>
#include <glissade/haptics/contact_set.h>

namespace glissade::haptics {

/// Not thread-safe.
class PatchMaker {
 public:
  explicit PatchMaker(const contact::MultiPartSliding& sliding);

  /// Writes the patches of the parts that hands lead into `set`, those with the greatest forces of each part first.
  /// Contacts that do not push are in none. A contact of two such parts counts for the first of them.
  void tell(ContactSet& set);

 private:
  bool is_led_by_hand(std::size_t part) const;
  void take_pushing(std::size_t part);

  const contact::MultiPartSliding& sliding_;
  std::vector<contact::ContactPatches> patches_;  // by part
  std::vector<contact::TrackedContact> pushing_;
  std::vector<contact::ContactPatch> by_force_;
};

}  // namespace glissade::haptics
