// The program adit-gui from outside: arguments, exit codes, what it links.

#include <gtest/gtest.h>

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <memory>
#include <string>

namespace {

struct Ended {
  int code = -1;
  std::string words;  ///< stdout and stderr
};

Ended ran(const std::string& command) {
  Ended ended;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return ended;
  std::array<char, 4096> part{};
  while (const std::size_t got = std::fread(part.data(), 1, part.size(), pipe)) ended.words.append(part.data(), got);
  const int status = pclose(pipe);
  ended.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return ended;
}

const std::string gui = ADIT_GUI_PROGRAM;

TEST(GuiProgram, HelpAndVersionNeedNoScreen) {
  EXPECT_EQ(ran("env -u DISPLAY " + gui + " --help").code, 0);
  const Ended version = ran("env -u DISPLAY " + gui + " --version");
  EXPECT_EQ(version.code, 0);
  EXPECT_NE(version.words.find("adit-gui "), std::string::npos);
}

TEST(GuiProgram, RefusesUnknownArguments) {
  EXPECT_EQ(ran(gui + " --colour").code, 2);
  EXPECT_EQ(ran(gui + " one two").code, 2);
}

TEST(GuiProgram, WithoutAScreenSaysSo) {
  const Ended unset = ran("env -u DISPLAY -u WAYLAND_DISPLAY " + gui);
  EXPECT_EQ(unset.code, 2);
  EXPECT_NE(unset.words.find("DISPLAY"), std::string::npos) << unset.words;
  const Ended dead = ran("env -u WAYLAND_DISPLAY DISPLAY=:8765 " + gui);
  EXPECT_EQ(dead.code, 2);
  EXPECT_NE(dead.words.find(":8765"), std::string::npos) << dead.words;
}

TEST(GuiProgram, OurProgramsDoNotLinkQt) {
  for (const std::string& program : {gui, std::string(ADIT_PROGRAM)}) {
    const Ended needed = ran("readelf -d " + program);
    ASSERT_EQ(needed.code, 0) << needed.words;
    ASSERT_NE(needed.words.find("(NEEDED)"), std::string::npos);
    EXPECT_EQ(needed.words.find("libQt"), std::string::npos) << needed.words;
  }
}

TEST(GuiProgram, TheWindowLeavesTheDriverToTheMachine) {
  EXPECT_EQ(ran("readelf -d " + gui).words.find("libOSMesa"), std::string::npos);
}

}  // namespace
