/// A live run and its operator, over the network and at a terminal.

#include "pipeline/picture/picture.h"
#include "tests/programs/desk.h"

#include <atomic>
#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <lo/lo.h>
#include <nlohmann/json.hpp>
#include <pty.h>
#include <sys/wait.h>
#include <termios.h>
#include <thread>
#include <unistd.h>
#include <utmp.h>

namespace stadion {
namespace {

using nlohmann::json;

/// A ball that falls, and that the visitor pushes about by walking near it.
constexpr const char* kOperated = R"(forcelinear( name=gravity, direction="0, 0, -1" )
forcelinear( name=push, direction="0, 0, 3", initstate=off, duration=0.1 )
object( name=floor, file=plane.3ds )
dynobject( name=ball, file=football.3ds, position="0, 4, 2", density=0.1, restitution=0.8, hook=gravity, hook=push )
dynamics( collider=floor, collidee=ball )
wandtrigger( sphere="0, 0, 0, 100", eventmessage="button1, push, enable" )
sound( file=thud.wav, loop=on )
)";

/// A show that runs beside the test.
class LiveShow {
public:
  explicit LiveShow(std::vector<std::string> more, const std::string& look = "plain") {
    show_ = folder_.write("show.evs", kOperated);
    ProgramRun run;
    run.words = {stadionPath(), "run",    show_,   "--asset-root", assetFolder(), "--walls",
                 "desktop",     "--size", "64x48", "--json",       "--osc",       std::to_string(port_)};
    run.words.insert(run.words.end(), {"--look", look});
    run.words.insert(run.words.end(), more.begin(), more.end());
    run.environment = {"ALSOFT_DRIVERS=null"};
    program_ = std::make_unique<RunningProgram>(run);
    to_ = lo_address_new("127.0.0.1", std::to_string(port_).c_str());
  }
  ~LiveShow() { lo_address_free(to_); }

  /// It hears the operator, and plays or waits for the start.
  bool hears() const { return program_->says("playing until Ctrl-C"); }
  bool says(const std::string& text) const { return program_->says(text); }

  void send(const char* path) { lo_send(to_, path, ""); }
  void send(const char* path, double value) { lo_send(to_, path, "d", value); }
  /// Ends it, however often that must be said until it hears.
  json finish() {
    program_->waitUntil([&] { return send("/stadion/end"), !program_->runs(); });
    EXPECT_EQ(program_->status(), 0) << program_->err();
    err = program_->err();
    return json::parse(program_->out(), nullptr, false);
  }
  std::string file(const char* name) const { return folder_.path() / name; }
  const std::string& show() const { return show_; }

  std::string err;

private:
  TestFolder folder_;
  std::string show_;
  std::uint16_t port_ = freePort();
  std::unique_ptr<RunningProgram> program_;
  lo_address to_ = nullptr;
};

void wait(int milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

/// The last line of `stadion hash`.
std::string hashAtTheEnd(const std::string& show, const std::string& log) {
  const ProgramResult r =
      stadionProgram({"hash", show, "--input", log, "--asset-root", assetFolder(), "--walls", "desktop"});
  EXPECT_EQ(r.status, 0) << r.err;
  const std::size_t end = r.out.size() < 2 ? std::string::npos : r.out.rfind('\n', r.out.size() - 2);
  return end == std::string::npos ? r.out : r.out.substr(end + 1);
}

std::string lastOf(const json& summary) {
  return fmt::format("{} {}\n", summary.at("last_frame").get<int>(),
                     summary.at("state_hash").get<std::string>());
}

TEST(ProgramOperator, EveryGroupsRecordReplaysToItsOwnState) {
  const TestFolder records;
  const std::string record = records.path() / "visit.input";
  const std::uint16_t trackers = freePort();
  LiveShow live({"--record-input", record, "--tracker", fmt::format("osc:{}", trackers)});
  const lo_address wand = lo_address_new("127.0.0.1", std::to_string(trackers).c_str());
  const auto visit = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      const double t = 0.01 * i;
      lo_send(wand, "/tracker/head/pose", "ddddddd", 0.3 * t, 0.0, 1.7, 0.0, 0.0, 0.0, 1.0);
      lo_send(wand, "/tracker/wand/pose", "ddddddd", 0.5, 0.2 * t, 1.2, 0.0, 0.0, 0.0, 1.0);
      lo_send(wand, "/tracker/wand/button", "ii", 1, i / 10 % 2);
      lo_send(wand, "/tracker/stray/pose", "ddddddd", 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0);
      if (i == 40)
        live.send("/stadion/pause", 1), live.send("/stadion/step"), live.send("/stadion/freeze-head", 1);
      if (i == 60)
        live.send("/stadion/pause", 0), live.send("/stadion/volume", 0.5),
            live.send("/stadion/freeze-head", 0);
      wait(10);
    }
  };
  ASSERT_TRUE(live.hears());
  visit(150);
  ASSERT_TRUE(live.says("operator: volume 50 %"));
  live.send("/stadion/next-group");
  visit(100);
  ASSERT_TRUE(live.says("group 2 begins"));
  const json summary = live.finish();
  lo_address_free(wand);
  ASSERT_TRUE(summary.is_object()) << live.err;
  EXPECT_EQ(summary.at("groups"), 2) << live.err;
  EXPECT_NE(live.err.find("group 2 begins"), std::string::npos) << live.err;
  EXPECT_NE(live.err.find("\"stray\" is not in the rig file"), std::string::npos) << live.err;
  const std::string second = records.path() / "visit-2.input";
  EXPECT_EQ(hashAtTheEnd(live.show(), second), lastOf(summary)) << fileContent(second).substr(0, 2000);
  EXPECT_NE(fileContent(second).find("order 0 volume 0.5"), std::string::npos)
      << "what stands when a group begins is in its record";
  EXPECT_FALSE(hashAtTheEnd(live.show(), record).empty());
}

TEST(ProgramOperator, ANextGroupWhoseScriptHasErrorsWaitsForItToBeMended) {
  const TestFolder folder;
  const std::string show = folder.write("show.evs", kOperated), port = std::to_string(freePort());
  ProgramRun run{{stadionPath(), "run", show, "--asset-root", assetFolder(), "--walls", "desktop", "--size",
                  "64x48", "--look", "plain", "--no-sound", "--osc", port}};
  RunningProgram program(run);
  const lo_address to = lo_address_new("127.0.0.1", port.c_str());
  ASSERT_TRUE(program.says("operator: OSC on UDP port"));  // the first show is loaded
  folder.write("show.evs", std::string(kOperated) + "object( positon=\"0, 1, 1\" )\n");
  lo_send(to, "/stadion/next-group", "");
  EXPECT_TRUE(program.says("begins once it is saved without them"));
  folder.write("show.evs", kOperated);
  EXPECT_TRUE(program.says("group 2 begins: "));
  lo_send(to, "/stadion/end", "");
  EXPECT_EQ(program.status(), 0) << program.err();
  lo_address_free(to);
}

TEST(ProgramOperator, AShowThatWaitsStandsAtTheFirstFrameUntilTheStart) {
  LiveShow waiting({"--wait"});
  ASSERT_TRUE(waiting.says("waiting for start"));
  const json summary = waiting.finish();
  EXPECT_EQ(summary.at("last_frame"), 0) << waiting.err;
  EXPECT_NE(waiting.err.find("waiting for start"), std::string::npos);

  LiveShow started({"--wait"});
  ASSERT_TRUE(started.says("waiting for start"));
  started.send("/stadion/start");
  ASSERT_TRUE(started.says("operator: start"));
  wait(300);
  EXPECT_GT(started.finish().at("last_frame"), 0) << started.err;
}

// Contexts, programs and meshes are those of the groups before, whose drawings were given up.
TEST(ProgramOperator, TheNextGroupSeesTheSamePictures) {
  LiveShow first({"--wait"}, "full");
  ASSERT_TRUE(first.says("waiting for start"));
  const json seen = first.finish();
  LiveShow second({"--wait"}, "full");
  ASSERT_TRUE(second.says("waiting for start"));
  second.send("/stadion/next-group");
  ASSERT_TRUE(second.says("group 2 begins"));
  const json seenAgain = second.finish();
  ASSERT_GT(seenAgain.at("groups"), 1) << second.err;
  EXPECT_EQ(seenAgain.at("image_hashes").size(), 2u);
  EXPECT_EQ(seenAgain.at("image_hashes"), seen.at("image_hashes"));
}

TEST(ProgramOperator, OrdersOfALogAreObeyedInTheirFrame) {
  const TestFolder folder;
  const std::string show = folder.write("show.evs", kOperated);
  const auto picturesWith = [&](const std::string& orders) {
    const std::string log =
        folder.write("orders.input", "stadion-input 2\nrate 60\n" + orders + "frame 6 0.1\n");
    const ProgramResult r =
        stadionProgram({"run", show, "--input", log, "--asset-root", assetFolder(), "--walls", "desktop",
                        "--size", "64x48", "--look", "plain", "--json"});
    EXPECT_EQ(r.status, 0) << r.err;
    const json images = json::parse(r.out).at("image_hashes");
    return std::pair(images.at(0).at("hash").get<std::string>(), images.at(1).at("hash").get<std::string>());
  };
  const auto [left, right] = picturesWith("");
  EXPECT_NE(left, right);
  EXPECT_EQ(picturesWith("order 3 swap-eyes 1\n"), std::pair(right, left));
  EXPECT_EQ(picturesWith("order 3 swap-eyes 1\norder 5 swap-eyes 0\n"), std::pair(left, right));
  const auto together = picturesWith("order 0 eye-separation 0\n");
  EXPECT_EQ(together.first, together.second);
  Picture black(64, 48);
  for (std::size_t i = 0; i < black.rgba.size(); ++i) black.rgba[i] = i % 4 == 3 ? 255 : 0;
  const std::string dark = fmt::format("{:016x}", imageHash(black));
  EXPECT_EQ(picturesWith("order 4 black 1\n"), std::pair(dark, dark));
}

TEST(ProgramOperator, KeysOfATerminalCommandTheShowAndTheTerminalIsGivenBack) {
  const TestFolder folder;
  const std::string show = folder.write("show.evs", kOperated), out = folder.path() / "out";
  int terminal = -1, other = -1;
  ASSERT_EQ(openpty(&terminal, &other, nullptr, nullptr, nullptr), 0);
  termios before{}, after{};
  tcgetattr(other, &before);
  const pid_t child = fork();
  if (child == 0) {
    close(terminal);
    login_tty(other);
    const int file = open(out.c_str(), O_WRONLY | O_CREAT, 0600);
    dup2(file, 1), dup2(file, 2);
    setenv("ALSOFT_DRIVERS", "null", 1);
    execl(stadionPath().c_str(), "stadion", "run", show.c_str(), "--asset-root", assetFolder().c_str(),
          "--walls", "desktop", "--size", "64x48", "--look", "plain", nullptr);
    _exit(127);
  }
  for (int i = 0; i < 60'000 && fileContent(out).find("operator: keys") == std::string::npos; ++i) wait(10);
  const auto press = [&](const char* keys) { EXPECT_GT(write(terminal, keys, strlen(keys)), 0); };
  press("b\033[A");  // the arrow's [ is no key of ours
  wait(200);
  press("n");
  int status = -1;
  for (int i = 0; i < 60'000 && waitpid(child, &status, WNOHANG) == 0; ++i) {
    if (fileContent(out).find("group 2 begins") != std::string::npos) press("q");
    wait(10);
  }
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << fileContent(out);
  EXPECT_NE(fileContent(out).find("operator: black on"), std::string::npos) << fileContent(out);
  EXPECT_EQ(fileContent(out).find("eye-separation"), std::string::npos) << fileContent(out);
  tcgetattr(other, &after);
  EXPECT_EQ(before.c_lflag, after.c_lflag);
  close(terminal), close(other);
}

TEST(ProgramOperator, WhatNeedsAnOperatorIsRefusedWhereEveryFrameCounts) {
  const TestFolder folder;
  const std::string show = folder.write("show.evs", kOperated);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--osc", "0"}, {"--wait"}, {"--tracker", "osc:0"}}) {
    std::vector<std::string> all{"run", show, "--frames", "3"};
    all.insert(all.end(), words.begin(), words.end());
    const ProgramResult r = stadionProgram(all);
    EXPECT_EQ(r.status, 2);
    EXPECT_NE(r.err.find(words[0] + " is for live runs"), std::string::npos) << r.err;
  }
  EXPECT_NE(stadionProgram({"run", show, "--rig", "x"}).err.find("--rig says where trackers are"),
            std::string::npos);
  EXPECT_NE(stadionProgram({"run", show, "--tracker", "usb:1"}).err.find("is not osc:PORT"),
            std::string::npos);
}

TEST(ProgramTracker, ShowsWhatArrivesAndCalibratesTheRoom) {
  const TestFolder folder;
  const std::uint16_t port = freePort();
  std::atomic<bool> ending = false;
  std::thread sender([&] {
    const lo_address to = lo_address_new("127.0.0.1", std::to_string(port).c_str());
    while (!ending) {
      lo_send(to, "/tracker/wand/pose", "ddddddd", 1.0, 2.0, 0.5, 0.0, 0.0, 0.0, 1.0);
      wait(10);
    }
    lo_address_free(to);
  });
  const std::string device = fmt::format("osc:{}", port), rig = folder.path() / "hall.rig";
  const ProgramResult seen = stadionProgram({"tracker", "--tracker", device, "--seconds", "2", "--json"});
  EXPECT_EQ(seen.status, 0) << seen.err;
  const json last = json::parse(seen.out.substr(seen.out.rfind('\n', seen.out.size() - 2) + 1));
  EXPECT_GT(last.at("taken"), 0) << seen.out;
  EXPECT_EQ(last.at("trackers").at(1).at("name"), "wand");
  EXPECT_EQ(last.at("trackers").at(1).at("as_sent").at("position"), (json{1.0, 2.0, 0.5}));

  const ProgramResult unheld = stadionProgram({"tracker", "--tracker", device, "--rig", rig, "--calibrate"});
  EXPECT_EQ(unheld.status, 1);
  EXPECT_NE(unheld.err.find("Enter was not pressed"), std::string::npos) << unheld.err;
  EXPECT_FALSE(std::filesystem::exists(rig)) << "nothing is left behind";
  ending = true;
  sender.join();
}

}  // namespace
}  // namespace stadion
