#include "gloves.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include <glissade/devices/glove_model.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/devices/simulated_glove_service.h>
#include <glissade/realtime/clock.h>

#include "arrays.h"
#include "mesh_files.h"
#include "module.h"
#include "unlocked.h"

namespace glissade::python {

namespace {

template <typename Part>
Part& living(const std::unique_ptr<Part>& part) {
  if (part == nullptr) throw std::runtime_error("the glove has ended: the program ends, or is a forked child");
  return *part;
}

/// Waits without the interpreter lock, up to 0.1 s, for the end of the threads of a bus.
template <typename Part>
void end_unlocked(std::unique_ptr<Part>& part) noexcept {
  std::unique_ptr<Part> ending = std::move(part);
  if (ending == nullptr) return;
  const Unlocked unlocked;
  ending.reset();
}

/// A simulated glove with its thread and its link. Members are destroyed from the last to the first.
struct SimulatedLink {
  explicit SimulatedLink(const devices::SimulatedGlove& simulated)
      : service(bus, simulated, clock), glove(bus, simulated.descriptor()) {}

  std::shared_ptr<devices::LcmBus> bus = std::make_shared<devices::LcmBus>("memq://");
  realtime::SteadyClock clock;
  devices::SimulatedGloveService service;
  devices::LcmGlove glove;
};

class SimulatedGlove final : public Glove {
 public:
  explicit SimulatedGlove(const devices::SimulatedGlove& simulated)
      : link_(std::make_unique<SimulatedLink>(simulated)) {}
  ~SimulatedGlove() override { end(); }

  devices::GloveDevice& device() override { return living(link_).glove; }
  double script_time_s() const { return std::chrono::duration<double>(living(link_).service.script_time()).count(); }

  void end() noexcept override { end_unlocked(link_); }
  void abandon() noexcept override { static_cast<void>(link_.release()); }

 private:
  std::unique_ptr<SimulatedLink> link_;
};

devices::SimulatedGlove simulated_from(const py::object& times_s, const py::object& X_WH, const py::object& model,
                                       const py::object& angles) {
  const geometry::PoseTrajectory script = trajectory_from(times_s, "times_s", X_WH, "X_WH");
  devices::SimulatedGloveParameters parameters;
  if (!angles.is_none()) {
    const Numbers rows = numbers_from(angles, "angles");
    if (rows.ndim() != 2 || rows.shape(0) != std::ssize(script.rows()) || rows.shape(1) != hands::kJoints)
      throw std::invalid_argument("angles must have the shape (n, 22), with a row for each of times_s");
    check_finite(rows, "angles");
    for (const geometry::TimedPose& row : script.rows()) {
      devices::TimedAngles& timed = parameters.fingers.emplace_back(devices::TimedAngles{.time = row.time});
      std::copy_n(rows.data(std::ssize(parameters.fingers) - 1, 0), hands::kJoints, timed.angles.begin());
    }
  }
  if (model.is_none()) return devices::SimulatedGlove(script, parameters);
  const devices::GloveModel read = devices::read_glove_model(path_from(model));
  return devices::SimulatedGlove(script, parameters, read);
}

std::shared_ptr<SimulatedGlove> make_simulated(const py::object& times_s, const py::object& X_WH,
                                               const py::object& model, const py::object& angles) {
  return make_running<SimulatedGlove>(simulated_from(times_s, X_WH, model, angles));
}

/// A glove of another process. Members are destroyed from the last to the first.
class LcmGlove final : public Glove {
 public:
  LcmGlove(std::shared_ptr<devices::LcmBus> bus, const devices::GloveInfo& info)
      : glove_(std::make_unique<devices::LcmGlove>(
            std::move(bus), info.descriptor,
            devices::LcmGloveOptions{.device = info.device, .glove_session = info.session})) {}
  ~LcmGlove() override { end(); }

  devices::GloveDevice& device() override { return living(glove_); }

  void end() noexcept override { end_unlocked(glove_); }
  void abandon() noexcept override { static_cast<void>(glove_.release()); }

 private:
  std::unique_ptr<devices::LcmGlove> glove_;
};

/// Waits without the interpreter lock for the announcement of the glove.
std::shared_ptr<LcmGlove> find_lcm_glove(const std::string& url, std::int64_t device, double timeout_s,
                                         const py::object& key_file) {
  if (!(timeout_s >= 0.0 && timeout_s <= 1e6)) throw std::invalid_argument("timeout_s must be from 0 to 1e6");
  std::optional<devices::LcmKey> key;
  if (!key_file.is_none()) key = devices::read_lcm_key(path_from(key_file));
  std::shared_ptr<devices::LcmBus> bus;
  std::optional<devices::GloveInfo> info;
  std::vector<std::string> troubles;
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout_s);
  do {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    const Unlocked unlocked;
    if (!bus) bus = std::make_shared<devices::LcmBus>(url, key);
    devices::GloveSearch search(bus);
    info = search.wait_for(device, std::chrono::milliseconds(300));  // announcements come every 200 ms
    troubles = search.troubles();
  } while (!info && std::chrono::steady_clock::now() < end);
  if (info) return make_running<LcmGlove>(std::move(bus), *info);
  std::string message = "glove " + std::to_string(device) + " is silent at " + url;
  for (const std::string& trouble : troubles)
    message += "; " + trouble;
  throw std::runtime_error(message);
}

}  // namespace

pybind11::tuple names_of(const devices::LimitReasons& reasons) {
  py::list names;
  for (const devices::NamedReason& reason : devices::kLimitReasons) {
    if (reasons.*reason.flag) names.append(std::string(reason.name));
  }
  return py::tuple(names);
}

void add_gloves(py::module_& module) {
  py::tuple reasons(devices::kLimitReasons.size());
  for (std::size_t r = 0; r < devices::kLimitReasons.size(); ++r)
    reasons[r] = std::string(devices::kLimitReasons[r].name);
  module.attr("LIMIT_REASONS") = reasons;
  py::list presets;
  for (const std::string_view preset : devices::glove_presets())
    presets.append(std::string(preset));
  module.attr("GLOVE_PRESETS") = py::tuple(presets);

  py::class_<Glove, std::shared_ptr<Glove>>(module, "Glove",
                                            "A glove for a HapticServer: SimulatedGlove, RelayGlove or LcmGlove.");
  py::class_<SimulatedGlove, Glove, std::shared_ptr<SimulatedGlove>>(
      module, "SimulatedGlove", "A simulated glove and its wearer, in a thread of its own.")
      .def(py::init(&make_simulated), py::arg("times_s"), py::arg("X_WH"), py::kw_only(), py::arg("model") = py::none(),
           py::arg("angles") = py::none(),
           R"(The wearer follows a script, and yields to the forces.

times_s: (n,) seconds, ascending. X_WH: the poses of the hand root at these times, (n, 7) or (n, 4, 4). The hand waits at
the first pose until a server runs. model: one of GLOVE_PRESETS, or the file of a model; None: an ideal arm of 20 N and
1 Nm at 1000 Hz. angles: (n, 22) rad of the joints at these times; None: a closed hand.)")
      .def_property_readonly("script_time_s", &SimulatedGlove::script_time_s,
                             "the wearer's present time in the script");
  py::class_<LcmGlove, Glove, std::shared_ptr<LcmGlove>>(module, "LcmGlove", "A glove of another process, over LCM.")
      .def(py::init(&find_lcm_glove), py::arg("url") = "udpm://239.255.76.67:7667?ttl=0", py::kw_only(),
           py::arg("device") = devices::kDefaultDevice, py::arg("timeout_s") = 5.0, py::arg("key_file") = py::none(),
           R"(Waits for the announcement of the glove.

url: of the LCM bus. device: the number of the glove. key_file: of a bus with a key. Raises RuntimeError if the glove is
silent for timeout_s, and ValueError for a wrong url.)");
  add_relay_glove(module);
}

}  // namespace glissade::python
