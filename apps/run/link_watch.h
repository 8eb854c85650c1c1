#pragma once

/// What is wrong with the messages of a glove.

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <glissade/devices/lcm_bus.h>

namespace glissade::apps {

/// Finds out from the link's counts why the states of a glove do not count. Each sentence comes once.
class LinkWatch {
 public:
  explicit LinkWatch(std::int64_t device) : name_("glove " + std::to_string(device)) {}

  /// To be called ten times a second.
  std::vector<std::string> news(const devices::LinkStatistics& link) {
    std::vector<std::string> sentences;
    for (const std::string& reason : refusals_of(link)) {
      if (told_.insert(reason).second) sentences.push_back("states on GLOVE_STATE are refused: " + reason);
    }
    const std::uint64_t out_of_sequence = link.out_of_sequence - out_of_sequence_;
    const bool most_are = out_of_sequence > kOftenOutOfSequence && out_of_sequence > link.accepted - accepted_;
    if (most_are && told_.insert("sequence").second)
      sentences.push_back("states of " + name_ + " are refused: their sequence numbers do not rise");
    out_of_sequence_ = link.out_of_sequence;
    if (second_glove_appears(link))
      sentences.push_back("a second glove sends as " + name_ + ", and is not heard: give it another --device");
    return sentences;
  }

 private:
  static constexpr std::uint64_t kOftenOutOfSequence = 10;  ///< in a call: some come twice on any network
  static constexpr int kCalls = 5;

  /// True once, when two gloves have sent under one number since each of the last five calls. A glove that takes the
  /// place of a silent one is no second one.
  bool second_glove_appears(const devices::LinkStatistics& link) {
    const bool both_send = link.accepted > accepted_ && link.other_sender > other_sender_;
    accepted_ = link.accepted;
    other_sender_ = link.other_sender;
    calls_ = both_send ? calls_ + 1 : 0;
    return calls_ == kCalls && told_.insert("second glove").second;
  }

  std::string name_;
  std::set<std::string> told_;
  std::uint64_t out_of_sequence_ = 0;
  std::uint64_t accepted_ = 0;
  std::uint64_t other_sender_ = 0;
  int calls_ = 0;  ///< one after the other between which both sent
};

}  // namespace glissade::apps
