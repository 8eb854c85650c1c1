#include "server.h"

#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>

#include <pybind11/stl.h>

#include <glissade/realtime/periodic_thread.h>

#include "arrays.h"
#include "for_each.h"
#include "mesh_files.h"
#include "module.h"
#include "unlocked.h"

namespace glissade::python {

Server::Server(const simulation::Scene& scene, std::vector<std::shared_ptr<Glove>> gloves, std::string record)
    : scene_(scene), gloves_(std::move(gloves)), record_(std::move(record)) {
  if (gloves_.empty() || gloves_.size() > devices::kHapticHands)
    throw std::invalid_argument("a server takes 1 to " + std::to_string(devices::kHapticHands) + " gloves, not " +
                                std::to_string(gloves_.size()));
  if (scene_.hands.size() > gloves_.size())
    throw std::invalid_argument("the scene has " + std::to_string(scene_.hands.size()) + " hands, but there are " +
                                std::to_string(gloves_.size()) + " gloves");
  simulation_ = std::make_unique<simulation::Simulation>(scene_);
  const contact::MultiPartSliding& parts = simulation_->engine().parts();
  devices::HapticState start;
  start.part_count = static_cast<std::int32_t>(parts.part_count());
  start.hand_count = static_cast<std::int32_t>(gloves_.size());
  for (std::size_t p = 0; p < parts.part_count(); ++p)
    start.parts[p].X_WV = start.parts[p].X_WG = parts.result(p).X_WV;
  frames_.publish(start);
}

void Server::start() {
  if (phase_ != Phase::kNew) throw std::runtime_error("a server starts once; make another one");
  Claims claims;
  Hands hands;
  haptics::RecordingHead head;
  for (std::size_t g = 0; g < gloves_.size(); ++g) {
    claims.push_back(gloves_[g]->claim("glove " + std::to_string(g)));
    devices::GloveDevice& device = gloves_[g]->device();
    hands.emplace_back(&device);
    const auto number = static_cast<std::int64_t>(g) + 1;
    head.gloves.push_back({.device = number, .session = number, .descriptor = device.descriptor()});
  }
  phase_ = Phase::kStarting;
  try {
    std::unique_lock starting(loop_mutex_);  // before other threads run, which may wait for the end of the start
    const Unlocked unlocked;
    start_loop(std::move(starting), std::move(claims), hands, std::move(head));
  } catch (...) {
    if (phase_ == Phase::kStarting) phase_ = Phase::kNew;
    throw;
  }
  if (phase_ == Phase::kStarting) phase_ = Phase::kRunning;  // else another thread has ended it
}

/// The recording is opened last: a start that fails leaves an older one alone.
void Server::start_loop(std::unique_lock<std::mutex> /*starting*/, Claims claims, const Hands& hands,
                        haptics::RecordingHead head) {
  std::unique_ptr<LateRecorder> recorder;
  std::unique_ptr<haptics::BackgroundObserver> observer;
  std::unique_ptr<haptics::HapticServer> loop;
  std::unique_lock<std::mutex> opening;
  if (!record_.empty()) {
    recorder = std::make_unique<LateRecorder>();
    observer = std::make_unique<haptics::BackgroundObserver>(std::vector<haptics::LoopObserver*>{recorder.get()});
    opening = recorder->hold();
  }
  loop = std::make_unique<haptics::HapticServer>(
      hands, simulation_->engine(),
      haptics::HapticServerOptions{.sink = [this](const devices::HapticState& state) { frames_.publish(state); },
                                   .observer = observer.get()});
  if (recorder) recorder->open(record_, std::move(head));
  recorder_ = std::move(recorder);
  observer_ = std::move(observer);
  loop_ = std::move(loop);
  claims_ = std::move(claims);
}

void Server::stop() {
  if (phase_ == Phase::kStarting) {
    const Unlocked unlocked;
    const std::lock_guard until_started(loop_mutex_);
  }
  if (phase_ == Phase::kNew) return;
  if (phase_ != Phase::kEnded) {
    phase_ = Phase::kEnding;
    const Unlocked unlocked;  // a driver in Python goes on, so its device feels the force fade
    end_loop();
  }
  phase_ = Phase::kEnded;
  if (const std::unique_ptr<LateRecorder> recorder = std::move(recorder_)) {
    const Unlocked unlocked;
    recorder->close();
  }
}

void Server::end_loop() {
  const std::lock_guard lock(loop_mutex_);
  if (claims_.empty()) return;  // another thread has ended it meanwhile
  loop_->stop();
  claims_.clear();
  show_end();
  if (!observer_) return;
  lost_records_ = observer_->dropped();
  observer_.reset();  // passes on the rest
}

void Server::end() noexcept {
  try {
    stop();
    phase_ = Phase::kEnded;  // also of a server that never started
  } catch (const std::exception&) {
    // The program ends, or nobody holds the server: there is nobody to tell that the recording is not whole.
  }
}

void Server::abandon() noexcept {
  phase_ = Phase::kEnded;
  static_cast<void>(loop_.release());
  static_cast<void>(observer_.release());
  static_cast<void>(recorder_.release());
  static_cast<void>(simulation_.release());  // it may have a search thread
}

haptics::HapticServer& Server::loop() {
  if (!has_loop()) throw std::runtime_error("the server has not started");
  return *loop_;
}

void Server::check() const {
  if (has_loop() && loop_->has_failed()) throw std::runtime_error(loop_->failure());
}

devices::HapticState Server::newest() {
  const std::lock_guard lock(frame_mutex_);
  return frames_.latest();
}

/// The last frame, without the force that has faded since.
void Server::show_end() {
  devices::HapticState last = newest();
  for (devices::HapticHandState& hand : last.hands) {
    hand.force_W.setZero();
    hand.torque_V_W.setZero();
    hand.joint_torques = {};
    hand.reasons.is_stopped = true;
  }
  frames_.publish(last);
}

namespace {

std::shared_ptr<Server> make_server(const simulation::Scene& scene, const py::args& gloves, const py::object& record) {
  std::vector<std::shared_ptr<Glove>> taken;
  for (const py::handle glove : gloves) {
    if (!py::isinstance<Glove>(glove))
      throw py::type_error("argument " + std::to_string(taken.size() + 1) + " after the scene is no Glove");
    taken.push_back(glove.cast<std::shared_ptr<Glove>>());
  }
  const std::string file = record.is_none() ? "" : path_from(record);
  const simulation::Scene own = scene;  // other threads may change the scene meanwhile
  const std::shared_ptr<Server> server = [&] {
    const Unlocked unlocked;
    return std::make_shared<Server>(own, std::move(taken), file);
  }();
  end_with_program(server);
  return server;
}

void warn(const char* sentence) {
  if (PyErr_WarnEx(PyExc_RuntimeWarning, sentence, 1) != 0) throw py::error_already_set();
}

void start(Server& server) {
  server.start();
  if (server.loop().scheduling().is_fifo) return;
  try {
    warn(
        "SCHED_FIFO is not granted: any busy program can hold up the haptic thread for milliseconds. "
        "docs/real_time.md says how to get it");
  } catch (const py::error_already_set&) {
    server.stop();  // the warning is an error here, so nobody would stop the loop
    throw;
  }
}

void stop(Server& server) {
  server.stop();
  if (server.lost_records() > 0) warn("the recording is not whole: the machine was too busy to record all ticks");
}

devices::HapticState frame(Server& server) {
  server.check();
  return server.newest();
}

void run_for(Server& server, double seconds) {
  if (!(seconds >= 0.0 && seconds <= 1e9)) throw std::invalid_argument("seconds must be from 0 to 1e9");
  if (!server.is_running() && !server.has_ended()) throw std::runtime_error("the server has not started");
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  constexpr std::chrono::milliseconds kTurn{20};
  while (std::chrono::steady_clock::now() < end) {
    server.check();
    if (server.has_ended()) return;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    const Unlocked unlocked;
    std::this_thread::sleep_until(std::min<std::chrono::steady_clock::time_point>(
        std::chrono::time_point_cast<std::chrono::steady_clock::duration>(end),
        std::chrono::steady_clock::now() + kTurn));
  }
  server.check();
}

double microseconds(std::chrono::nanoseconds time) {
  return std::chrono::duration<double, std::micro>(time).count();
}

py::dict statistics(Server& server) {
  haptics::HapticServer& loop = server.loop();
  py::dict figures;
  figures["ticks"] = loop.ticks();
  figures["late_ticks"] = loop.late_ticks();
  figures["has_real_time_priority"] = loop.scheduling().is_fifo;
  figures["has_locked_memory"] = loop.scheduling().has_locked_memory;
  if (!server.has_ended()) return figures;
  const haptics::HapticServerStatistics& all = loop.statistics();
  figures["lateness_p50_us"] = microseconds(all.haptic.lateness.quantile(0.5));
  figures["lateness_p99_us"] = microseconds(all.haptic.lateness.quantile(0.99));
  figures["tick_p50_us"] = microseconds(all.haptic.duration.quantile(0.5));
  figures["tick_p99_us"] = microseconds(all.haptic.duration.quantile(0.99));
  figures["contact_set_age_p99_us"] = microseconds(all.contact_set_age.quantile(0.99));
  figures["unsolved_ticks"] = all.unsolved_ticks;
  figures["lost_records"] = server.lost_records();
  return figures;
}

void grasp(Server& server, std::size_t hand, std::size_t part) {
  if (!server.is_running()) throw std::runtime_error("the server does not run");
  if (!server.loop().grasp(hand, part))
    throw std::invalid_argument("hand " + std::to_string(hand) + " cannot take part " + std::to_string(part) +
                                ": one of them does not exist, or the hand has fingers");
}

void release(Server& server, std::size_t hand) {
  if (!server.is_running()) throw std::runtime_error("the server does not run");
  if (!server.loop().release(hand)) throw std::invalid_argument("there is no hand " + std::to_string(hand));
}

using ServerType = py::class_<Server, std::shared_ptr<Server>>;

void add_life(ServerType& type) {
  type.def(py::init(&make_server), py::arg("scene"), py::arg("record") = py::none(),
           R"(Builds the trees of the scene, which takes most of the time.

gloves: first those of the scene's hands. A hand without fingers takes the first part if its glove is closed at the start;
later, its grip decides. The scene should have the rules of SlidingRules.real_time(). record: a file for an event log of
all ticks; a start that succeeds overwrites it. Raises ValueError for a scene that cannot be simulated, and for a wrong number of gloves.)");
  type.def("start", &start, R"(Starts the loop, once; `with` does so too.

Warns (RuntimeWarning) if the system does not grant real-time priority. Raises ValueError for a glove in use.)");
  type.def("stop", &stop, R"(Lets the forces fade, and ends the loop, which takes some milliseconds.

`with` does so at its end, and the end of the program for a server that still runs. Raises RuntimeError if the recording
could not be written.)");
  type.def("__enter__", [](const py::object& self) {
    start(self.cast<Server&>());
    return self;
  });
  type.def(
      "__exit__",
      [](Server& server, const py::object& type_of_error, const py::object&, const py::object&) {
        stop(server);
        if (type_of_error.is_none()) server.check();
      },
      py::arg("type"), py::arg("value"), py::arg("traceback"));
  type.def("run_for", &run_for, py::arg("seconds"),
           "Sleeps while the loop runs; other Python threads and Ctrl-C work. Raises RuntimeError if the loop fails.");
  type.def(
      "emergency_stop", [](Server& server) { server.loop().emergency_stop(); },
      "All forces fade to zero and stay there; the loop goes on.");
}

void add_reading(ServerType& type) {
  type.def("frame", &frame, R"(The newest Frame, for a reader at its own rate. Never waits for the loop.

Before the start, it shows the scene as it begins; after the end, the last tick without force. Raises RuntimeError, with
the reason, if the loop has failed.)");
  type.def_property_readonly("is_running", &Server::is_running, "the loop has started and was not stopped");
  type.def("statistics", &statistics, R"(A dict of counts and durations, with units in the names.

ticks, late_ticks (by a period or more), has_real_time_priority, has_locked_memory; after the end also quantiles of
lateness, of the duration of a tick and of the age of the contacts, unsolved_ticks and lost_records.)");
  type.def("grasp", &grasp, py::arg("hand"), py::arg("part"),
           "The hand takes this part in the next tick. For hands without fingers.");
  type.def("release", &release, py::arg("hand"), "The hand lets go of its part in the next tick.");
}

}  // namespace

void add_server(py::module_& module) {
  module.def("lock_memory", &realtime::lock_memory,
             "Locks the memory of this process, so that no thread waits for a page; True if the system grants it.");
  ServerType type(module, "HapticServer",
                  R"(The haptic loop: the forces at 1000 Hz in one thread, the simulation in another.

Both threads are in C++ and run no Python, so neither the interpreter lock nor a halt of the program delays a force.)");
  add_life(type);
  add_reading(type);
}

}  // namespace glissade::python
