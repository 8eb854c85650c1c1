#pragma once

/// The contacts of `glissade slide` as files: one row per contact, or per patch of merged contacts, and millisecond.

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/text.h>
#include <glissade/contact/tracked_contacts.h>
#include <glissade/files/csv.h>
#include <glissade/reference/sliding_method.h>

namespace glissade::apps {

/// The paths of the files. An empty path writes no file; "-" is standard output.
struct SlideContactsFiles {
  std::string contacts;
  std::string patches;

  bool any() const { return !contacts.empty() || !patches.empty(); }
};

/// Writes the touching contacts of each tick. Not thread-safe.
class SlideContactsWriter {
 public:
  /// Throws std::invalid_argument when a file cannot be created. The names of the scene must pass
  /// `check_names_fit_csv`. `scene` and `sliding` must outlive this object.
  SlideContactsWriter(const SlideContactsFiles& files, const HapticScene& scene,
                      const reference::SlidingSimulation& sliding);

  /// Writes the rows of the newest result, with the time `time_s`. Call it once after every call of `advance`.
  void write(double time_s);

  /// Throws std::runtime_error when not everything could be written.
  void close();

 private:
  double travel_of_obstacles();
  void write_contact(double time_s, const contact::TrackedContact& tracked);
  void write_patch(double time_s, const contact::ContactPatch& patch);

  const HapticScene& scene_;
  const reference::SlidingSimulation& sliding_;
  contact::ContactTracker tracker_;
  contact::ContactPatches patches_;
  std::vector<Eigen::Isometry3d> moving_X_WB_;  // at the last call
  std::unique_ptr<CsvWriter> contacts_out_;
  std::unique_ptr<CsvWriter> patches_out_;
};

}  // namespace glissade::apps
