#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>

#include <pybind11/stl.h>

#include <glissade/devices/event_log.h>
#include <glissade/viewer/view_server.h>
#include <glissade/viewer/view_simulation.h>

#include "guarded_simulation.h"
#include "module.h"
#include "recording.h"
#include "running.h"
#include "server.h"
#include "unlocked.h"

namespace glissade::python {

namespace py = pybind11;

namespace {

using devices::HapticState;

/// What a view shows: a new state, or none. A thread without Python calls it, some 60 times a second.
using Source = std::function<std::optional<HapticState>(bool is_watched)>;

constexpr std::chrono::milliseconds kFrame{16};

/// The page's server, and the thread that feeds it.
class Feed {
 public:
  Feed(viewer::ViewScene scene, std::uint16_t port, Source source)
      : server_(std::in_place, std::move(scene), port),
        source_(std::move(source)),
        thread_([this](const std::stop_token& stop) {
          while (!stop.stop_requested()) {
            if (const std::optional<HapticState> state = source_(server_->has_had_client())) server_->push(*state);
            std::this_thread::sleep_for(kFrame);
          }
        }) {}

  std::string url() const { return server_->url(); }

  /// Takes up to 0.3 s.
  void stop() {
    thread_.request_stop();
    thread_.join();
    server_.reset();
  }

 private:
  std::optional<viewer::ViewServer> server_;
  Source source_;
  std::jthread thread_;
};

class View final : public Running {
 public:
  View(viewer::ViewScene scene, std::uint16_t port, Source source)
      : feed_(std::make_unique<Feed>(std::move(scene), port, std::move(source))), url_(feed_->url()) {}
  ~View() override { end(); }

  const std::string& url() const noexcept { return url_; }
  bool is_open() const noexcept { return feed_ != nullptr; }

  void end() noexcept override {
    const std::unique_ptr<Feed> feed = std::move(feed_);
    if (feed == nullptr) return;
    const Unlocked unlocked;  // until before the source dies, which may hold the last reference to a server
    feed->stop();
  }
  void abandon() noexcept override { static_cast<void>(feed_.release()); }

 private:
  std::unique_ptr<Feed> feed_;
  std::string url_;
};

/// The states of a log at the pace of their times, once, from when a page has come.
class Player {
 public:
  explicit Player(const std::string& path) : log_(path), next_(read()) {
    if (!next_) throw std::invalid_argument(path + " has no state of a haptic loop");
    first_ = next_->time;
  }

  std::optional<HapticState> operator()(bool is_watched) {
    if (!is_watched || !next_) return {};
    const auto now = std::chrono::steady_clock::now();
    if (!start_) start_ = now;
    std::optional<HapticState> newest;
    while (next_ && next_->time - first_ <= now - *start_) {
      newest = next_;
      next_ = read();
    }
    return newest;
  }

 private:
  std::optional<HapticState> read() {
    while (const std::optional<devices::LogEvent> event = log_.next()) {
      if (std::optional<HapticState> state = devices::haptic_state_of(*event)) return state;
    }
    return {};
  }

  devices::EventLogReader log_;
  std::optional<HapticState> next_;
  std::chrono::nanoseconds first_{0};
  std::optional<std::chrono::steady_clock::time_point> start_;
};

/// The hands are those of the scene, and then some without fingers.
viewer::ViewScene shown(const simulation::Scene& scene, std::size_t hands, bool has_loop) {
  if (scene.objects.empty()) throw std::invalid_argument("the scene has no objects");
  viewer::ViewScene view{
      .title = scene.source, .objects = viewer::shown_objects(scene, scene.movable_names()), .has_loop = has_loop};
  const auto models = simulation::hand_models(scene.hands);
  for (std::size_t h = 0; h < std::max(hands, models.size()); ++h)
    view.hands.push_back({"hand " + std::to_string(h), h < models.size() ? models[h] : nullptr});
  return view;
}

std::shared_ptr<View> open(viewer::ViewScene scene, std::uint16_t port, Source source) {
  const std::shared_ptr<View> view = [&] {
    const Unlocked unlocked;
    return std::make_shared<View>(std::move(scene), port, std::move(source));
  }();
  end_with_program(view);
  return view;
}

std::shared_ptr<View> view_of_scene(const simulation::Scene& scene, std::uint16_t port) {
  const std::size_t parts = scene.movable_names().size();
  if (parts > devices::kHapticParts)
    throw std::invalid_argument("the scene has " + std::to_string(parts) + " movable objects; a view shows at most " +
                                std::to_string(devices::kHapticParts));
  return open(shown(scene, 0, false), port, [](bool) { return std::nullopt; });
}

std::shared_ptr<View> view_of_simulation(GuardedSimulation& simulation, std::uint16_t port) {
  std::pair<simulation::Scene, std::shared_ptr<ShownState>> watched =
      simulation.with([](ShownSimulation& of) { return std::pair(of.scene(), of.watch()); });
  const std::size_t hands = watched.first.hands.empty() ? watched.first.movable_names().size() : 0;
  return open(shown(watched.first, hands, false), port, [state = watched.second](bool) { return state->take(); });
}

std::shared_ptr<View> view_of_server(const std::shared_ptr<Server>& server, std::uint16_t port) {
  return open(shown(server->scene(), server->glove_count(), true), port,
              [server](bool) { return std::optional(server->newest()); });
}

std::shared_ptr<View> view_of_recording(const Recording& recording, const py::object& scene, std::uint16_t port) {
  if (!py::isinstance<simulation::Scene>(scene))
    throw py::type_error("a recording needs its scene: view(recording, scene)");
  const auto player = std::make_shared<Player>(recording.path);
  viewer::ViewScene view = shown(scene.cast<simulation::Scene>(), static_cast<std::size_t>(recording.hand_count), true);
  const auto parts = std::count_if(view.objects.begin(), view.objects.end(),
                                   [](const viewer::ViewObject& object) { return object.part.has_value(); });
  if (parts != recording.part_count)
    throw std::invalid_argument("the recording is of another scene: it has " + std::to_string(recording.part_count) +
                                " parts, and this scene " + std::to_string(parts));
  return open(std::move(view), port, [player](bool is_watched) { return (*player)(is_watched); });
}

std::shared_ptr<View> view_of(const py::object& of, const py::object& scene, std::uint16_t port) {
  if (py::isinstance<Recording>(of)) return view_of_recording(of.cast<const Recording&>(), scene, port);
  if (!scene.is_none()) throw py::type_error("only a recording needs a scene beside it");
  if (py::isinstance<simulation::Scene>(of)) return view_of_scene(of.cast<const simulation::Scene&>(), port);
  if (py::isinstance<GuardedSimulation>(of)) return view_of_simulation(of.cast<GuardedSimulation&>(), port);
  if (py::isinstance<Server>(of)) return view_of_server(of.cast<std::shared_ptr<Server>>(), port);
  throw py::type_error("a view shows a Scene, Simulation, HapticServer or Recording");
}

/// IPython may be missing; only a program that has loaded it runs in a notebook.
bool is_in_notebook() {
  const py::dict modules = py::module_::import("sys").attr("modules");
  if (!modules.contains("IPython")) return false;
  const py::object get_shell = py::getattr(modules["IPython"], "get_ipython", py::none());
  if (get_shell.is_none()) return false;  // half imported, or kept out
  const py::object shell = get_shell();
  return std::string(py::str(py::type::of(shell).attr("__name__"))) == "ZMQInteractiveShell";
}

/// Returns after Ctrl-C, or when the view has been closed.
void wait(const View& view) {
  while (view.is_open()) {
    if (PyErr_CheckSignals() != 0) {
      if (PyErr_ExceptionMatches(PyExc_KeyboardInterrupt) == 0) throw py::error_already_set();
      PyErr_Clear();
      return;
    }
    const Unlocked unlocked;
    std::this_thread::sleep_for(2 * kFrame);
  }
}

std::shared_ptr<View> view(const py::object& of, const py::object& scene, std::uint16_t port, bool opens_browser,
                           bool waits) {
  std::shared_ptr<View> made = view_of(of, scene, port);
  if (opens_browser && !is_in_notebook()) py::module_::import("webbrowser").attr("open")(made->url());
  if (!waits) return made;
  wait(*made);
  made->end();
  return made;
}

}  // namespace

void add_view(py::module_& module) {
  py::class_<View, std::shared_ptr<View>>(module, "View", "A page that shows something, until it is closed.")
      .def_property_readonly("url", &View::url, "the address of the page; only this machine can open it")
      .def_property_readonly("is_open", &View::is_open, "the page has not been closed")
      .def("close", &View::end, "Ends the page.")
      .def("__enter__", [](const std::shared_ptr<View>& view) { return view; })
      .def(
          "__exit__", [](View& view, const py::object&, const py::object&, const py::object&) { view.end(); },
          py::arg("type"), py::arg("value"), py::arg("traceback"))
      .def(
          "_repr_html_",
          [](const View& view) {
            return "<iframe src=\"" + view.url() + "\" width=\"100%\" height=\"480\" frameborder=\"0\"></iframe>";
          },
          "the page in a frame, for notebooks")
      .def("__repr__", [](const View& view) { return "<glissade.View at " + view.url() + ">"; });
  module.def("view", &view, py::arg("shown"), py::arg("scene") = py::none(), py::kw_only(), py::arg("port") = 0,
             py::arg("browser") = true, py::arg("wait") = false,
             R"(Shows a Scene, Simulation, HapticServer or Recording on the page of `glissade view`, and returns a View.

scene: that of a recording, which plays once, at its own pace, when the page is open. port: 0: any free one. browser:
opens the page in a browser; a notebook shows the result of the call in a frame instead. wait: returns only after Ctrl-C
or View.close(). Without it, the program goes on, and the page ends with the View or the program. Raises ValueError for
a port that cannot be opened.)");
}

}  // namespace glissade::python
