#include <string>

#include <glissade/apps/commands/scene_warnings.h>
#include <glissade/apps/commands/size_warnings.h>
#include <glissade/apps/say.h>
#include <glissade/apps/scene/parts_inside.h>

namespace glissade::apps {

void warn_of_scene(const Scene& file, const HapticScene& scene) {
  for (const std::string& sentence : doubtful_sizes(file, scene))
    warn(sentence);
  for (const std::string& sentence : parts_inside(scene))
    warn(scene.source + ": " + sentence);
}

}  // namespace glissade::apps
