#include <glissade/apps/say.h>
#include <glissade/apps/text.h>
#include <glissade/apps/view/say_if_simplified.h>

namespace glissade::apps {

void say_if_simplified(const viewer::ViewScene& scene, std::size_t most_triangles, const std::string& file) {
  if (scene.triangles() <= most_triangles) return;
  say("glissade: " + one_line(scene.title) + " has " + std::to_string(scene.triangles()) + " triangles: " + file +
      " shows it with about " + std::to_string(most_triangles));
}

}  // namespace glissade::apps
