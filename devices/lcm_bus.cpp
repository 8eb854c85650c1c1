#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <lcm/lcm.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <glissade/base/assert.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/realtime/periodic_thread.h>

#include "lcm/lcm_packet.h"
#include "lcm/lcm_url.h"
#include "lcm/message_seal.h"
#include "lcm/udpm_socket.h"

namespace glissade::devices {
namespace {

constexpr int kRetryMilliseconds = 10;

/// liblcm interprets the channel of a subscription as a regular expression, so only plain characters are allowed.
void check_channel(const std::string& channel) {
  const auto is_allowed = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; };
  if (!channel.empty() && channel.size() <= kLongestChannelName &&
      std::all_of(channel.begin(), channel.end(), is_allowed)) {
    return;
  }
  throw std::invalid_argument("The LCM channel '" + channel + "' must have 1 to 15 characters of A-Z, 0-9 and _.");
}

struct DestroyLcm {
  void operator()(lcm_t* lcm) const { lcm_destroy(lcm); }
};
using LcmHandle = std::unique_ptr<lcm_t, DestroyLcm>;

LcmHandle connect_to(const std::string& url) {
  LcmHandle lcm(lcm_create(url.c_str()));
  if (!lcm) throw std::invalid_argument("The LCM address '" + url + "' does not work: liblcm cannot open it.");
  return lcm;
}

[[noreturn]] void refuse_to_receive(const std::string& url, const std::string& reason) {
  throw std::invalid_argument("The LCM address '" + url + "' does not work: nothing can be received from it" + reason +
                              ".");
}

}  // namespace

class LcmBus::Connection {
 public:
  Connection(const std::string& url, const std::optional<LcmKey>& key);
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection();

  const std::string& url() const noexcept { return url_; }
  std::int64_t subscribe(const std::string& channel, Handler handler);
  void unsubscribe(const std::string& channel, std::int64_t id);
  bool publish(const std::string& channel, std::span<const std::uint8_t> message);
  std::uint64_t refused_packets() const noexcept { return refused_packets_.load(std::memory_order_relaxed); }

 private:
  static void take_from_memq(const lcm_recv_buf_t* buffer, const char* channel, void* connection);
  bool take_from_udpm() noexcept;
  void dispatch(std::string_view channel, std::span<const std::uint8_t> message) noexcept;
  void start_receiving();
  void receive(int fd, realtime::FifoShare& share);

  std::string url_;
  std::optional<MessageSeal> seal_;     ///< with a key
  std::optional<UdpmAddress> udpm_;     ///< none over memq
  LcmHandle lcm_;                       ///< sends; over memq it receives too
  std::unique_ptr<UdpmSocket> socket_;  ///< receives over udpm, from the first subscription on
  std::atomic<std::uint64_t> refused_packets_{0};
  int wake_fd_ = -1;
  std::mutex set_up_mutex_;  ///< one subscription at a time
  std::thread thread_;

  // liblcm may still call a subscription that another thread has just ended. So liblcm's subscriptions, one for each
  // channel, last as long as the bus, and handlers are added and removed here.
  std::mutex handlers_mutex_;  ///< held while handlers run, so that a removed handler is not running
  std::map<std::string, std::vector<std::pair<std::int64_t, Handler>>, std::less<>> handlers_;
  std::int64_t next_id_ = 0;
};

LcmBus::Connection::Connection(const std::string& url, const std::optional<LcmKey>& key)
    : url_(url), udpm_(check_lcm_url(url)), lcm_(connect_to(url)) {
  if (key) seal_.emplace(key->bytes);
  wake_fd_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (wake_fd_ < 0) throw std::system_error(errno, std::generic_category(), "No eventfd for the LCM receive thread");
}

LcmBus::Connection::~Connection() {
  if (thread_.joinable()) {
    eventfd_write(wake_fd_, 1);
    thread_.join();
  }
  close(wake_fd_);
}

std::int64_t LcmBus::Connection::subscribe(const std::string& channel, Handler handler) {
  check_channel(channel);
  if (!handler) throw std::invalid_argument("The subscription to the LCM channel '" + channel + "' needs a handler.");
  const std::lock_guard set_up_lock(set_up_mutex_);
  GLISSADE_ASSERT(std::this_thread::get_id() != thread_.get_id());
  const bool is_new = [&] {
    const std::lock_guard lock(handlers_mutex_);
    return !handlers_.contains(channel);
  }();
  if (is_new && !udpm_ && lcm_subscribe(lcm_.get(), channel.c_str(), take_from_memq, this) == nullptr) {
    refuse_to_receive(url_, "");
  }
  if (!thread_.joinable()) start_receiving();
  const std::lock_guard lock(handlers_mutex_);
  handlers_[channel].emplace_back(next_id_, std::move(handler));
  return next_id_++;
}

void LcmBus::Connection::unsubscribe(const std::string& channel, std::int64_t id) {
  GLISSADE_ASSERT(std::this_thread::get_id() != thread_.get_id());
  const std::lock_guard lock(handlers_mutex_);
  std::erase_if(handlers_.at(channel), [id](const auto& handler) { return handler.first == id; });
}

bool LcmBus::Connection::publish(const std::string& channel, std::span<const std::uint8_t> message) {
  check_channel(channel);
  std::vector<std::uint8_t> sealed;
  if (seal_) {
    sealed = seal_->sealed(channel, message);
    message = sealed;
  }
  return lcm_publish(lcm_.get(), channel.c_str(), message.data(), static_cast<unsigned int>(message.size())) == 0;
}

void LcmBus::Connection::take_from_memq(const lcm_recv_buf_t* buffer, const char* channel, void* connection) {
  static_cast<Connection*>(connection)
      ->dispatch(channel, {static_cast<const std::uint8_t*>(buffer->data), buffer->data_size});
}

bool LcmBus::Connection::take_from_udpm() noexcept {
  LcmPacket packet;
  const UdpmSocket::Outcome outcome = socket_->receive(packet);
  if (outcome == UdpmSocket::Outcome::kMessage) dispatch(packet.channel, packet.message);
  if (outcome == UdpmSocket::Outcome::kRefused) refused_packets_.fetch_add(1, std::memory_order_relaxed);
  return outcome != UdpmSocket::Outcome::kError;
}

void LcmBus::Connection::dispatch(std::string_view channel, std::span<const std::uint8_t> message) noexcept {
  if (seal_) {
    const auto opened = seal_->opened(channel, message);
    if (!opened) {
      refused_packets_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    message = *opened;
  }
  const std::lock_guard lock(handlers_mutex_);
  const auto entry = handlers_.find(channel);
  if (entry == handlers_.end()) return;
  for (const auto& [id, handler] : entry->second) {
    // An exception must not pass through liblcm: it would leave its locks taken.
    try {
      handler(message);
    } catch (...) {  // NOLINT(bugprone-empty-catch): promised by Handler
    }
  }
}

void LcmBus::Connection::start_receiving() {
  int fd = -1;
  if (udpm_) {
    try {
      socket_ = std::make_unique<UdpmSocket>(*udpm_);
    } catch (const std::system_error& error) {
      refuse_to_receive(url_, std::string(" (") + error.what() + ")");
    }
    fd = socket_->fd();
  } else {
    fd = lcm_get_fileno(lcm_.get());
    if (fd < 0) refuse_to_receive(url_, "");
  }
  thread_ = std::thread([this, fd] {
    realtime::name_this_thread("lcm-receive");
    realtime::FifoShare share(realtime::kLinkPriority, realtime::kLinkShare);
    receive(fd, share);
  });
}

void LcmBus::Connection::receive(int fd, realtime::FifoShare& share) {
  pollfd files[2] = {{.fd = wake_fd_, .events = POLLIN, .revents = 0}, {.fd = fd, .events = POLLIN, .revents = 0}};
  const auto take = [this] { return socket_ ? take_from_udpm() : lcm_handle(lcm_.get()) >= 0; };
  for (;;) {
    if (poll(files, 2, -1) >= 0) {
      if (files[0].revents != 0) return;
      const bool is_well = files[1].revents == 0 || take();
      share.check();  // others may send as much as they like
      if (is_well) continue;
    } else if (errno == EINTR) {
      continue;
    }
    // Something failed, perhaps for lack of memory. Try again, because a glove must not fall silent for good.
    std::this_thread::sleep_for(std::chrono::milliseconds(kRetryMilliseconds));
    eventfd_t wakes = 0;
    if (eventfd_read(wake_fd_, &wakes) == 0) return;
  }
}

LcmBus::LcmBus(const std::string& url, const std::optional<LcmKey>& key)
    : connection_(std::make_unique<Connection>(url, key)) {}

LcmBus::~LcmBus() = default;

const std::string& LcmBus::url() const noexcept {
  return connection_->url();
}

std::uint64_t LcmBus::refused_packets() const noexcept {
  return connection_->refused_packets();
}

std::unique_ptr<LcmBus::Subscription> LcmBus::subscribe(const std::string& channel, Handler handler) {
  const std::int64_t id = connection_->subscribe(channel, std::move(handler));
  return std::make_unique<Subscription>(*connection_, channel, id);
}

bool LcmBus::publish(const std::string& channel, std::span<const std::uint8_t> message) {
  return connection_->publish(channel, message);
}

LcmBus::Subscription::Subscription(Connection& connection, std::string channel, std::int64_t id)
    : connection_(connection), channel_(std::move(channel)), id_(id) {}

LcmBus::Subscription::~Subscription() {
  connection_.unsubscribe(channel_, id_);
}

}  // namespace glissade::devices
