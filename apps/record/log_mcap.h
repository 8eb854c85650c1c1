#pragma once

/// An event log as MCAP, for Foxglove and PlotJuggler.

#include <cstdint>
#include <string>
#include <vector>

namespace glissade::apps {

/// A topic of the file, and its number of messages.
struct McapTopic {
  std::string topic;
  std::uint64_t messages = 0;
};

/// Writes /tf, /scene, /contacts, /loop, and /part_N and /hand_N of each part and hand; docs/file_formats.md has the
/// messages. The scene is that of `scene_file`, or the recorded one if the name is empty. A log without a session, such
/// as one of a flight recorder, gets no /scene. Reads up to the first damage, and leaves out events that cannot be
/// read; of either, `damage` then tells. Shows a progress bar. Without a tick in the log, no file is written and there
/// are no topics. Throws std::invalid_argument, naming the file, when the log cannot be read, its scene is not the
/// recorded one, or the file cannot be written; and std::runtime_error when not everything could be written.
std::vector<McapTopic> write_log_mcap(const std::string& log_path, const std::string& mcap_path,
                                      const std::string& scene_file, std::string& damage);

}  // namespace glissade::apps
