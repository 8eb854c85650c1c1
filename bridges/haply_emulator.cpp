#include <algorithm>
#include <future>
#include <map>
#include <mutex>
#include <optional>
#include <random>
#include <stdexcept>
#include <thread>
#include <utility>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <fcntl.h>

#include <glissade/bridges/haply_emulator.h>
#include <glissade/devices/glove_model.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/periodic_thread.h>

#include "haply/client_message.h"
#include "haply/emulated_arm.h"
#include "haply/emulated_session.h"
#include "haply/service_message.h"

namespace glissade::bridges {
namespace {

namespace asio_io = boost::asio;
using asio_io::ip::tcp;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

/// A device that gets no more messages lets go. After how long is not documented.
constexpr milliseconds kForceLasts{20};

constexpr const char* kArmId = "049D";
constexpr const char* kHandleId = "61548";

}  // namespace

devices::SimulatedGlove resting_haply_hand() {
  Eigen::Isometry3d X_DC = Eigen::Isometry3d::Identity();
  X_DC.translation() = Eigen::Vector3d(0.0, -0.12, 0.15);  // an example of Haply's documentation
  return devices::SimulatedGlove(geometry::PoseTrajectory({{nanoseconds(0), X_DC}}), {},
                                 devices::read_glove_model(kInverse3Preset));
}

/// All but the functions that others call belongs to the thread.
class HaplyEmulator::Service {
 public:
  explicit Service(HaplyEmulatorOptions options)
      : options_(std::move(options)),
        random_(options_.seed),
        arm_(options_.hand, options_.filters, clock_.now()),
        endpoint_(asio_io::ip::address_v4::loopback(), options_.port) {
    listen();
    endpoint_ = acceptor_.local_endpoint();
    tick();
    thread_ = std::thread([this] {
      realtime::schedule_this_thread(realtime::kLinkPriority);  // as a device, which is never late
      context_.run();
    });
  }
  ~Service() {
    in_thread([this] {
      end();
      timer_.cancel();
      is_over_ = true;
    });
    thread_.join();
  }
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  std::string address() const { return "127.0.0.1:" + std::to_string(endpoint_.port()); }
  EmulatedHaply state() const {
    const std::scoped_lock lock(mutex_);
    return state_;
  }
  /// Waits until the thread has done it.
  template <typename Work>
  void in_thread(Work work) {
    std::packaged_task<void()> task(std::move(work));
    asio_io::post(context_, [&] { task(); });
    task.get_future().get();
  }

  void listen();
  void end();
  void begin_script() { starts_ = clock_.now(); }
  void set_plugged(bool is_plugged) { is_plugged_ = is_plugged; }
  void set_calibrated(bool is_calibrated) { is_calibrated_ = is_calibrated; }

 private:
  /// What a program wants.
  struct Wish {
    std::shared_ptr<EmulatedSession> session;
    Eigen::Vector3d f_C_D = Eigen::Vector3d::Zero();
    nanoseconds heard{0};
  };

  void accept();
  void tick();
  void advance();
  std::string hear(std::uint64_t session, const std::string& text);
  std::string spoiled(std::string text);
  ServiceMessage message(bool is_inventory) const;
  bool happens(double share) { return std::uniform_real_distribution<>()(random_) < share; }

  HaplyEmulatorOptions options_;
  std::mt19937_64 random_;
  realtime::SteadyClock clock_;
  EmulatedArm arm_;
  double damping_N_s_per_m_ = options_.filters.damping_N_s_per_m;
  std::optional<nanoseconds> starts_;  // the script of the hand
  bool is_plugged_ = true;
  bool is_calibrated_ = true;
  bool is_over_ = false;
  asio_io::io_context context_{1};
  tcp::endpoint endpoint_;
  tcp::acceptor acceptor_{context_};
  asio_io::steady_timer timer_{context_};
  std::map<std::uint64_t, Wish> wishes_;  // by the number of the session
  std::uint64_t sessions_ = 0;
  mutable std::mutex mutex_;
  EmulatedHaply state_;  // what others see
  std::thread thread_;
};

void HaplyEmulator::Service::listen() {
  try {
    acceptor_.open(endpoint_.protocol());
    fcntl(acceptor_.native_handle(), F_SETFD, FD_CLOEXEC);  // a program that is started would keep the port
    acceptor_.set_option(tcp::acceptor::reuse_address(true));
    acceptor_.bind(endpoint_);
    acceptor_.listen();
  } catch (const std::exception& error) {
    throw std::runtime_error("TCP port " + std::to_string(endpoint_.port()) + ": " + error.what());
  }
  accept();
}

void HaplyEmulator::Service::end() {
  acceptor_.close();
  for (auto& [number, wish] : wishes_)
    wish.session->cut();
  wishes_.clear();
}

void HaplyEmulator::Service::accept() {
  acceptor_.async_accept([this](const boost::system::error_code& error, tcp::socket socket) {
    if (error) return;  // the service ends
    boost::system::error_code ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    const std::uint64_t number = ++sessions_;
    SessionAnswers answers;
    answers.inventory = [this] {
      constexpr bool kIsInventory = true;
      return encode_service_message(message(kIsInventory));
    };
    answers.answer = [this, number](const std::string& text) { return hear(number, text); };
    answers.end = [this, number] { wishes_.erase(number); };
    answers.version =
        options_.is_before_3_5 ? R"({"project_version": "3.4.0.0"})" : R"({"project_version": "3.5.0.0"})";
    answers.delay = options_.faults.delay;
    wishes_[number].session = serve(std::move(socket), std::move(answers));
    accept();
  });
}

void HaplyEmulator::Service::tick() {
  timer_.expires_after(milliseconds(1));
  timer_.async_wait([this](const boost::system::error_code&) {
    if (is_over_) return;
    advance();
    tick();
  });
}

void HaplyEmulator::Service::advance() {
  const nanoseconds now = clock_.now();
  Eigen::Vector3d f_C_D = Eigen::Vector3d::Zero();
  for (const auto& [number, wish] : wishes_) {
    if (now - wish.heard < kForceLasts) f_C_D += wish.f_C_D;
  }
  if (!is_plugged_) f_C_D.setZero();
  const bool goes_on = starts_ && now >= *starts_;
  arm_.advance(now, f_C_D, wishes_.empty() ? 0.0 : damping_N_s_per_m_, goes_on);
  const std::scoped_lock lock(mutex_);
  state_.f_C_D = arm_.force();
  state_.p_DC = arm_.state().X_WH.translation();
  state_.is_pressed = arm_.state().grip % 2 == 1;
}

std::string HaplyEmulator::Service::hear(std::uint64_t session, const std::string& text) {
  const ForceKey key = options_.is_before_3_5 ? ForceKey::kValues : ForceKey::kVector;
  bool is_known = false;
  try {
    const ClientMessage heard = decode_client_message(text);
    const auto wish = wishes_.find(session);
    is_known = heard.force_key == key && heard.arm == kArmId && wish != wishes_.end();
    if (is_known) {
      wish->second.f_C_D = heard.f_C_D;
      wish->second.heard = clock_.now();
      damping_N_s_per_m_ = heard.damping_N_s_per_m.value_or(damping_N_s_per_m_);
      if (!starts_) starts_ = clock_.now() + options_.wait;
    }
  } catch (const std::invalid_argument&) {  // the service answers nevertheless
  }
  {
    const std::scoped_lock lock(mutex_);
    ++(is_known ? state_.messages : state_.other_messages);
  }
  advance();
  constexpr bool kIsInventory = false;
  return spoiled(encode_service_message(message(kIsInventory)));
}

std::string HaplyEmulator::Service::spoiled(std::string text) {
  const std::size_t size = text.size();
  if (happens(options_.faults.cut)) text.resize(random_() % size);
  if (!happens(options_.faults.garbage)) return text;
  std::string garbage(1 + random_() % size, '\0');
  constexpr unsigned kPrintable = '~' - ' ' + 1;  // a WebSocket takes no text of other bytes
  std::generate(garbage.begin(), garbage.end(), [this] { return static_cast<char>(' ' + random_() % kPrintable); });
  return garbage;
}

ServiceMessage HaplyEmulator::Service::message(bool is_inventory) const {
  ServiceMessage message;
  message.force_key = options_.is_before_3_5 ? ForceKey::kValues : ForceKey::kVector;
  const devices::GloveState& state = arm_.state();
  if (is_plugged_) {
    HaplyArm arm{.id = kArmId};
    arm.status.is_calibrated = is_calibrated_;
    arm.p_DC = state.X_WH.translation();
    arm.v_DC = state.v_WH;
    if (!options_.is_before_3_5) arm.f_C_D = arm_.force();
    if (is_inventory) arm.config = {.type = "inverse3", .port = "emulated", .handedness = "right", .hardware = 7};
    if (is_inventory && !options_.is_before_3_5) {
      arm.config->force_gate = options_.filters.force_gate;
      arm.config->damping_N_s_per_m = damping_N_s_per_m_;
    }
    message.arms.push_back(arm);
  }
  if (options_.has_handle) {
    constexpr bool kIsWireless = true;
    message.handles.push_back({.id = kHandleId,
                               .is_wireless = kIsWireless,
                               .R_DG = Eigen::Quaterniond(state.X_WH.linear()),
                               .is_pressed = state.grip % 2 == 1});
  }
  return message;
}

HaplyEmulator::HaplyEmulator(HaplyEmulatorOptions options) : service_(std::make_unique<Service>(std::move(options))) {}

HaplyEmulator::~HaplyEmulator() = default;

std::string HaplyEmulator::service() const {
  return service_->address();
}

EmulatedHaply HaplyEmulator::state() const {
  return service_->state();
}

void HaplyEmulator::begin_script() {
  service_->in_thread([this] { service_->begin_script(); });
}

void HaplyEmulator::unplug() {
  service_->in_thread([this] { service_->set_plugged(false); });
}

void HaplyEmulator::plug() {
  service_->in_thread([this] { service_->set_plugged(true); });
}

void HaplyEmulator::set_calibrated(bool is_calibrated) {
  service_->in_thread([this, is_calibrated] { service_->set_calibrated(is_calibrated); });
}

void HaplyEmulator::stop_service() {
  service_->in_thread([this] { service_->end(); });
}

void HaplyEmulator::start_service() {
  service_->in_thread([this] { service_->listen(); });
}

}  // namespace glissade::bridges
