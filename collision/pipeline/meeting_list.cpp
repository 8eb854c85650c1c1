#include "pipeline/meeting_list.h"

#include <algorithm>
#include <iterator>

namespace glissade::collision {

bool MeetingList::update(const World& world, FrameResult& result) {
  result.report.result.in = std::ssize(met_) + std::ssize(parted_);
  const bool has_changed = !met_.empty() || !parted_.empty();
  if (has_changed) {
    std::sort(met_.begin(), met_.end());
    std::sort(parted_.begin(), parted_.end());
    kept_.clear();
    std::set_difference(meeting_.begin(), meeting_.end(), parted_.begin(), parted_.end(), std::back_inserter(kept_));
    meeting_.clear();
    std::merge(kept_.begin(), kept_.end(), met_.begin(), met_.end(), std::back_inserter(meeting_));
    met_.clear();
    parted_.clear();
    result.meeting.clear();
    for (const Meeting& pair : meeting_)
      result.meeting.push_back({world.objects()[pair.slots.a].id, world.objects()[pair.slots.b].id});
  }
  result.report.result.out = std::ssize(meeting_);
  return has_changed;
}

void MeetingList::copy_details(PairTable& pairs, FrameResult& result) const {
  result.ends.clear();
  result.all_triangle_pairs.clear();
  result.all_close_pairs.clear();
  for (const Meeting& pair : meeting_) {
    const MeetingDetails& details = *pairs.memory(pair.number).details;
    result.all_triangle_pairs.insert(result.all_triangle_pairs.end(), details.triangle_pairs.begin(),
                                     details.triangle_pairs.end());
    result.all_close_pairs.insert(result.all_close_pairs.end(), details.close_pairs.begin(), details.close_pairs.end());
    result.ends.push_back(result.all_triangle_pairs.size() + result.all_close_pairs.size());
  }
}

}  // namespace glissade::collision
