#pragma once

/// The tables of `glissade slide` for one trajectory: motion, contacts, patches and moving objects, millisecond by
/// millisecond, all of one run.

#include <chrono>
#include <memory>
#include <string>

#include <glissade/apps/commands/slide_contacts.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/text.h>
#include <glissade/contact/sliding.h>
#include <glissade/files/csv.h>
#include <glissade/reference/sliding_method.h>

namespace glissade::apps {

/// The paths of the files. An empty path writes no file; "-" is standard output.
struct SlideTableFiles {
  std::string motion;
  SlideContactsFiles contacts;
  std::string moving;
};

/// Not thread-safe.
class SlideTables {
 public:
  /// `scene` must outlive this object. For contacts, patches and moving objects, its names must pass
  /// `check_names_fit_csv`.
  SlideTables(SlideTableFiles files, const HapticScene& scene, reference::SlidingMethod method);

  /// Writes the rows of the newest result. Call it once after every call of `advance`, with the same simulation. The
  /// first call creates the files; it throws std::invalid_argument when one cannot be created.
  void write(std::chrono::nanoseconds time, const reference::SlidingSimulation& sliding);

  /// Throws std::runtime_error when not everything could be written.
  void close();

 private:
  void create(const reference::SlidingSimulation& sliding);

  SlideTableFiles files_;
  const HapticScene& scene_;
  reference::SlidingMethod method_;
  bool is_created_ = false;
  std::unique_ptr<CsvWriter> motion_;
  std::unique_ptr<SlideContactsWriter> contacts_;
  std::unique_ptr<CsvWriter> moving_;
};

}  // namespace glissade::apps
