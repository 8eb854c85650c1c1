#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <glissade/apps/run/status_line.h>

#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

/// A narrow terminal, unless it is told otherwise.
class Terminal {
 public:
  explicit Terminal(std::uint16_t columns = 40) {
    const winsize size{.ws_row = 24, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
    EXPECT_EQ(openpty(&screen_, &program_, nullptr, nullptr, &size), 0);
  }
  ~Terminal() {
    close_program();
    close(screen_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  int program() const { return program_; }
  void close_program() {
    if (program_ >= 0) close(program_);
    program_ = -1;
  }

  /// What has been written since the last call.
  std::string text() {
    fcntl(screen_, F_SETFL, O_NONBLOCK);
    return read_all();
  }

  /// What is written until every program has closed the terminal.
  std::string text_until_closed() {
    close_program();
    return read_all();
  }

 private:
  std::string read_all() const {
    std::string text;
    std::array<char, 4096> buffer{};
    for (ssize_t size = 0; (size = read(screen_, buffer.data(), buffer.size())) > 0;)
      text.append(buffer.data(), static_cast<std::size_t>(size));
    return text;
  }

  int screen_ = -1;
  int program_ = -1;
};

TEST(StatusLine, IsRenewedInPlaceAndErasedAtTheEnd) {
  Terminal terminal;
  {
    StatusLine line(terminal.program());
    line.show("1.0 s");
    line.show("1.1 s");
    EXPECT_EQ(terminal.text(), "\r\033[K1.0 s\r\033[K1.1 s");
  }
  EXPECT_EQ(terminal.text(), "\r\033[K");
}

TEST(StatusLine, SentencesStandAboveIt) {
  Terminal terminal;
  StatusLine line(terminal.program());
  line.say("it begins");
  line.show("1.0 s");
  line.say("the glove is lost");
  EXPECT_EQ(terminal.text(), "\r\033[Kit begins\r\n\r\033[K1.0 s\r\033[Kthe glove is lost\r\n1.0 s");
  line.show({});
  line.say("it ends");
  EXPECT_EQ(terminal.text(), "\r\033[K\r\033[Kit ends\r\n");
}

TEST(StatusLine, FitsTheTerminal) {
  Terminal terminal;
  StatusLine line(terminal.program());
  line.show(std::string(100, 'x'));
  EXPECT_EQ(terminal.text(), "\r\033[K" + std::string(39, 'x'));
}

TEST(StatusLine, IsCutBetweenCharacters) {
  EXPECT_EQ(cut_to_width("Türgriff", 3), "Tür");
  EXPECT_EQ(cut_to_width("Türgriff", 8), "Türgriff");
  EXPECT_EQ(cut_to_width("Tür", 80), "Tür");
  EXPECT_EQ(cut_to_width("Tür", 0), "");
}

// A program that waited would hang here.
TEST(StatusLine, UnreadTerminalDoesNotBlock) {
  Terminal terminal;
  StatusLine line(terminal.program());
  for (int i = 0; i < 10'000; ++i) {
    line.show(std::to_string(i) + std::string(30, '.'));
    line.say(std::string(100, '-'));
  }
  EXPECT_THAT(terminal.text(), HasSubstr("0......"));
}

TEST(StatusLine, AFileGetsSentencesOnly) {
  test_support::TemporaryFolder folder;
  const std::string path = folder.write("errors", "");
  const int file = open(path.c_str(), O_RDWR);
  {
    StatusLine line(file);
    line.show("1.0 s");
    line.say("the glove is lost");
  }
  std::array<char, 100> buffer{};
  const ssize_t size = pread(file, buffer.data(), buffer.size(), 0);
  close(file);
  EXPECT_EQ(std::string(buffer.data(), static_cast<std::size_t>(size)), "the glove is lost\n");
}

TEST(StatusLine, OfADemonstrationShowsTheLoopForceAndHoldIn80Columns) {
  test_support::TemporaryFolder folder;
  const std::string scene =
      folder.write("scene.yaml",
                   "objects:\n"
                   "  - {name: plate, shape: {type: plate, size_x_m: 0.5, size_y_m: 0.5, triangles: 200}}\n"
                   "  - name: box\n"
                   "    movable: true\n"
                   "    shape: {type: box, size_x_m: 0.1, size_y_m: 0.06, size_z_m: 0.04, triangles: 12}\n"
                   "    pose: {position_m: [0, 0, 0.03]}\n"
                   "script: hand.csv\n");
  folder.write("hand.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0.03,1,0,0,0\n1,0,0,0.03,1,0,0,0\n");
  Terminal terminal(80);
  const pid_t id = fork();
  if (id == 0) {
    dup2(terminal.program(), STDERR_FILENO);
    const int output = open("/dev/null", O_WRONLY);
    dup2(output, STDOUT_FILENO);
    execl(GLISSADE_PROGRAM, GLISSADE_PROGRAM, "demo", "--scene", scene.c_str(), "--seconds", "1", nullptr);
    _exit(127);
  }
  const std::string text = terminal.text_until_closed();
  int status = 0;
  waitpid(id, &status, 0);
  EXPECT_EQ(status, 0) << text;
  EXPECT_THAT(text, ContainsRegex("/1.0 s  [0-9]+ Hz, [0-9]+ late, contacts [0-9.]+ ms old  glove 1: [0-9.]+ N, box"));
  EXPECT_TRUE(text.ends_with("\r\033[K")) << text;
}

}  // namespace
}  // namespace glissade::apps
