/// Ports that are not there, not ours, or vanish; and what is said about them.

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <glissade/bridges/opengloves.h>
#include <glissade/bridges/serial_ports.h>
#include <glissade/bridges/serial_stream.h>
#include <glissade/bridges/wire.h>

#include "emulation/emulated_port.h"
#include "stream/baud_rate.h"
#include "stream/time_limit.h"
#include "temporary_folder.h"

namespace glissade::bridges {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

SerialStream stream_to(const std::string& port) {
  return SerialStream(port, kOpenGlovesBaudRate, kOpenGlovesTcpPort);
}

/// The sentence of the error when the port is opened.
std::string trouble_with(const std::string& port) {
  try {
    stream_to(port).open();
  } catch (const WireError& error) {
    return error.what();
  }
  return "no error";
}

std::string read_text(SerialStream& stream) {
  return stream.read(milliseconds(2000));
}

TEST(SerialStream, PassesBytesBothWays) {
  for (const bool is_tcp : {false, true}) {
    EmulatedPort device = is_tcp ? EmulatedPort::tcp(0) : EmulatedPort::terminal("");
    device.plug();
    SerialStream stream = stream_to(device.name());
    stream.open();
    device.read();  // takes the connection
    device.write("A1\r\n\x03\x11");
    EXPECT_EQ(read_text(stream), "A1\r\n\x03\x11") << "as they are";
    stream.write("B2\n");
    std::string heard;
    while (heard.empty())
      heard = device.read();
    EXPECT_EQ(heard, "B2\n");
  }
}

TEST(SerialStream, WaitsNoLongerThanItMay) {
  EmulatedPort device = EmulatedPort::terminal("");
  device.plug();
  SerialStream stream = stream_to(device.name());
  stream.open();
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(stream.read(milliseconds(20)), "");
  EXPECT_GE(std::chrono::steady_clock::now() - start, milliseconds(20));
  device.write("later");
  EXPECT_EQ(read_text(stream), "later") << "nothing is lost between two reads";
}

TEST(SerialStream, ReadsWhatHasArrivedWithoutPatience) {
  EmulatedPort device = EmulatedPort::terminal("");
  device.plug();
  SerialStream stream = stream_to(device.name());
  stream.open();
  for (int i = 0; i < 50; ++i) {
    const std::string sent = "number " + std::to_string(i);
    device.write(sent);
    ASSERT_EQ(stream.read(milliseconds(0)), sent);
    ASSERT_EQ(stream.read(milliseconds(0)), "");
  }
}

TEST(SerialStream, SetsAnyBaudRate) {
  EmulatedPort device = EmulatedPort::terminal("");
  device.plug();
  // 3 Mbaud is that of the servos; the others have no constant in termios.
  for (const unsigned rate : {115200U, 3000000U, 250000U, 4500000U}) {
    SerialStream stream(device.name(), rate);
    stream.open();
    EXPECT_EQ(baud_rate(stream.descriptor()), rate);
    EXPECT_EQ(device.baud_rate(), rate);
    device.write("\xFF\xFD");
    EXPECT_EQ(read_text(stream), "\xFF\xFD");
  }
}

TEST(SerialStream, WaitsForNoNameWithoutEnd) {
  const auto start = std::chrono::steady_clock::now();
  const auto slow = [] {
    std::this_thread::sleep_for(std::chrono::seconds(3));
    return 1;
  };
  EXPECT_EQ(within(milliseconds(10), slow), std::nullopt);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(3));
  EXPECT_EQ(within(std::chrono::seconds(20), [] { return 2; }), 2);
}

TEST(SerialStream, SaysWhatIsWrongWithAPort) {
  EXPECT_THAT(trouble_with("/dev/ttyUSB99"), HasSubstr("/dev/ttyUSB99: there is no such port"));
  EXPECT_THAT(trouble_with("/dev/null"), HasSubstr("/dev/null: this is no serial port"));
  EXPECT_THAT(trouble_with("tcp:127.0.0.1:1"), HasSubstr("nothing listens there"));
  EXPECT_THAT(port_trouble("/dev/null", std::errc::permission_denied), HasSubstr("usermod -aG root $USER"));
}

TEST(SerialStream, RefusesAddressesThatAreNone) {
  for (const char* port : {"tcp:glove:", "tcp:glove:0", "tcp:glove:65536", "tcp:glove:6a"})
    EXPECT_THROW(stream_to(port), std::invalid_argument) << port;
  EXPECT_THROW(SerialStream("tcp:glove", 3000000), std::invalid_argument) << "no port, and no default";
}

TEST(SerialStream, HasThePortForItself) {
  EmulatedPort device = EmulatedPort::terminal("");
  device.plug();
  SerialStream stream = stream_to(device.name());
  stream.open();
  EXPECT_THAT(trouble_with(device.name()), HasSubstr("another program uses the port"));
  stream.close();
  EXPECT_EQ(trouble_with(device.name()), "no error");
}

TEST(SerialStream, NoticesThatThePlugIsPulled) {
  for (const bool is_tcp : {false, true}) {
    EmulatedPort device = is_tcp ? EmulatedPort::tcp(0) : EmulatedPort::terminal("");
    device.plug();
    SerialStream stream = stream_to(device.name());
    stream.open();
    device.read();
    device.unplug();
    EXPECT_THROW(read_text(stream), WireError);
    EXPECT_THROW(for (int i = 0; i < 3; ++i) stream.write("A0B0C0D0E0\n"), WireError);
  }
}

TEST(SerialPorts, AreListedWithWhatIsKnown) {
  const test_support::TemporaryFolder folder;
  namespace fs = std::filesystem;
  fs::create_directories(folder.path("dev/serial/by-id"));
  fs::create_directories(folder.path("sys/devices/usb1/interface/ttyUSB0"));
  fs::create_directories(folder.path("sys/class/tty/ttyUSB0"));
  for (const char* name : {"dev/ttyUSB0", "dev/ttyACM1", "dev/tty0", "dev/rfcomm0"})
    folder.write(name, "");
  folder.write("sys/devices/usb1/product", "CP2102 USB to UART\n");
  folder.write("sys/devices/usb1/manufacturer", "Silicon Labs\n");
  fs::create_symlink(folder.path("sys/devices/usb1/interface/ttyUSB0"), folder.path("sys/class/tty/ttyUSB0/device"));
  fs::create_symlink("../../ttyUSB0", folder.path("dev/serial/by-id/usb-Silicon_Labs-port0"));
  const std::vector<SerialPort> ports = serial_ports(folder.path(""));
  ASSERT_EQ(ports.size(), 3);
  EXPECT_THAT(ports[0].path, HasSubstr("dev/rfcomm0"));
  EXPECT_EQ(ports[0].device, "Bluetooth");
  EXPECT_THAT(ports[1].path, HasSubstr("dev/ttyACM1"));
  EXPECT_EQ(ports[1].device, "");
  EXPECT_EQ(ports[2].device, "Silicon Labs CP2102 USB to UART");
  EXPECT_THAT(ports[2].lasting, HasSubstr("by-id/usb-Silicon_Labs-port0"));
  EXPECT_EQ(ports[2].trouble, "");
  EXPECT_TRUE(serial_ports(folder.path("nowhere")).empty());
}

}  // namespace
}  // namespace glissade::bridges
