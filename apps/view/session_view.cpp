#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <utility>

#include <CLI/CLI.hpp>

#include <glissade/apps/text.h>
#include <glissade/apps/view/replay_maker.h>
#include <glissade/apps/view/session_view.h>

namespace glissade::apps {

std::uint16_t parse_port(const std::string& option, const std::string& text) {
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error == std::errc() && end == text.data() + text.size()) return port;
  throw CLI::ValidationError(option, "must be a port, 0 to 65535, not " + in_quotes(text));
}

std::vector<std::string> glove_names(const std::vector<std::int64_t>& devices) {
  std::vector<std::string> names;
  for (const std::int64_t device : devices)
    names.push_back("glove " + std::to_string(device));
  return names;
}

viewer::ViewScene view_scene_of(const HapticScene& scene, const std::vector<std::string>& hands,
                                const std::vector<std::shared_ptr<const grasping::HandModel>>& models) {
  viewer::ViewScene view{.title = scene.source, .objects = scene.shown};
  for (std::size_t h = 0; h < hands.size(); ++h)
    view.hands.push_back({hands[h], h < models.size() ? models[h] : nullptr});
  return view;
}

Replay replay_of(const Session& session, const HapticScene& scene) {
  ReplayMaker maker(view_scene_of(scene, glove_names(session.devices), session.hand_models));
  for (std::size_t i = 0; i < session.samples->size(); ++i)
    maker.add(session.samples->state(i));
  return maker.finish();
}

std::unique_ptr<viewer::ViewServer> open_view(viewer::ViewScene scene, std::uint16_t port, const std::string& option) {
  try {
    return std::make_unique<viewer::ViewServer>(std::move(scene), port);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(option + ": " + error.what() + "; choose another port, or any free one with " + option +
                                " 0");
  }
}

CLI::Option* add_view_option(CLI::App& command, std::optional<std::uint16_t>& port) {
  return command
      .add_option_function<std::string>(
          "--view",
          // CLI11 gives nothing for an option without its value.
          [&port](const std::string& text) { port = text.empty() ? kViewPort : parse_port("--view", text); },
          "Show the scene in a browser, at http://127.0.0.1:PORT/; 0: any port that is free (" +
              std::to_string(kViewPort) + " without PORT)")
      ->expected(0, 1)
      ->type_name("[PORT]");
}

}  // namespace glissade::apps
