#pragma once

/// The scene of a run as viewers show it, and the option --view.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glissade/apps/report/html_report.h>
#include <glissade/apps/run/session.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/viewer/view_scene.h>
#include <glissade/viewer/view_server.h>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace glissade::apps {

/// The run for a report.
Replay replay_of(const Session& session, const HapticScene& scene);

inline constexpr std::uint16_t kViewPort = 8421;

/// The names of the hands in these gloves.
std::vector<std::string> glove_names(const std::vector<std::int64_t>& devices);

/// A scene with hands of these names; the model of a hand without fingers is null.
viewer::ViewScene view_scene_of(const HapticScene& scene, const std::vector<std::string>& hands,
                                const std::vector<std::shared_ptr<const grasping::HandModel>>& models);

/// The port of the text of an option. Throws CLI::ValidationError, naming the option and what is allowed.
std::uint16_t parse_port(const std::string& option, const std::string& text);

/// A server of the page at this port. Throws std::invalid_argument, naming the option that gave the port and how to get
/// another one, if it cannot be opened.
std::unique_ptr<viewer::ViewServer> open_view(viewer::ViewScene scene, std::uint16_t port,
                                              const std::string& option = "--view");

/// Adds --view [PORT]; `port` stays empty without it.
CLI::Option* add_view_option(CLI::App& command, std::optional<std::uint16_t>& port);

}  // namespace glissade::apps
