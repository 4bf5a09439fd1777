/// Fifty operators beside a running show: no more late frames than without them.

#include "tests/programs/desk.h"
#include "tests/programs/web_client.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <thread>

namespace stadion {
namespace {

constexpr const char* kBusyShow = R"(forcelinear( name=gravity, direction="0, 0, -1" )
forcelinear( name=jump, direction="0, 0, 4", initstate=off, duration=0.25 )
object( name=floor, file=plane.3ds )
dynobject( name=ball, file=football.3ds, position="0, 6, 3", density=0.08, restitution=0.7, hook=gravity, hook=jump )
dynamics( collider=floor, collidee=ball )
timer( period=2, repeat=on, eventmessage="timesup, jump, enable" )
)";
constexpr const char* kLoadToken = "token-of-fifty-operators";
constexpr int kClients = 50;

/// The number in the environment, or the standard.
int wished(const char* name, int standard) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : standard;
}

/// Asks as the page does: the state once a second, then the views. Stands for another machine, so it yields to the show.
void operate(std::uint16_t port, const std::atomic<bool>& over, std::atomic<std::uint64_t>& answered,
             std::atomic<std::uint64_t>& lost) {
  setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), 19);
  const std::string bearer = std::string("Authorization: Bearer ") + kLoadToken + "\r\n";
  for (int turn = 0; !over; ++turn) {
    for (const char* path : {"/state", turn % 2 == 0 ? "/views/0/0" : "/views/0/1"}) {
      const int status = webStatus(webAnswer(port, webRequestText("GET", path, bearer)));
      ++(status == 200 || status == 404 ? answered : lost);  // 404: there is no picture yet
    }
    for (int i = 0; i < 10 && !over; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

struct Visit {
  double late = 0;  ///< late frames in a thousand
  double p99 = 0;   ///< of the frames' periods [ms]
  std::uint64_t answered = 0, lost = 0;
};

Visit played(const std::string& show, const std::string& token, int clients, int seconds) {
  const std::uint16_t port = freePort();
  RunningProgram program({{stadionPath(), "run", show, "--asset-root", assetFolder(), "--walls", "desktop",
                           "--size", "320x240", "--look", "plain", "--rate", "30", "--no-sound", "--json",
                           "--web", std::to_string(port), "--web-token", token}});
  EXPECT_TRUE(program.says("playing until Ctrl-C")) << program.err();
  std::atomic<bool> over = false;
  std::atomic<std::uint64_t> answered = 0, lost = 0;
  std::vector<std::thread> operators;
  for (int i = 0; i < clients; ++i) operators.emplace_back([&] { operate(port, over, answered, lost); });
  std::this_thread::sleep_for(std::chrono::seconds(seconds));
  over = true;
  for (std::thread& t : operators) t.join();
  const std::string end = R"({"command":"end"})";
  const std::string head =
      std::string("Authorization: Bearer ") + kLoadToken + "\r\nContent-Type: application/json\r\n";
  program.waitUntil(
      [&] { return webAnswer(port, webRequestText("POST", "/command", head, end)), !program.runs(); });
  EXPECT_EQ(program.status(), 0) << program.err();
  const auto summary = nlohmann::json::parse(program.out(), nullptr, false);
  if (!summary.is_object()) return {};
  Visit visit;
  visit.late =
      1e3 * summary.at("late_frames").get<double>() / std::max(1.0, summary.at("frames").get<double>());
  visit.p99 = summary.at("frame_ms").at("p99").get<double>();
  visit.answered = answered;
  visit.lost = lost;
  return visit;
}

// With STADION_WEB_ROUNDS and STADION_WEB_SECONDS it is shorter.
TEST(ProgramFullWeb, FiftyOperatorsForTenMinutesMakeNoFrameLate) {
  const TestFolder folder;
  const std::string show = folder.write("show.evs", kBusyShow);
  const std::string token = folder.write("token", std::string(kLoadToken) + "\n");
  const int rounds = wished("STADION_WEB_ROUNDS", 10), seconds = wished("STADION_WEB_SECONDS", 60);
  std::vector<double> alone, other, visited;
  std::uint64_t answered = 0, lost = 0;
  for (int i = 0; i < rounds; ++i) {
    const Visit a = played(show, token, 0, seconds), b = played(show, token, kClients, seconds),
                c = played(show, token, 0, seconds);
    alone.push_back(a.late);
    visited.push_back(b.late);
    other.push_back(c.late);
    answered += b.answered;
    lost += b.lost;
    std::printf(
        "late in a thousand: alone %.2f, with %d operators %.2f, alone %.2f; p99 %.2f, %.2f, %.2f ms; "
        "%llu answers, %llu lost\n",
        a.late, kClients, b.late, c.late, a.p99, b.p99, c.p99, static_cast<unsigned long long>(b.answered),
        static_cast<unsigned long long>(b.lost));
  }
  const auto median = [](std::vector<double> all) {
    std::ranges::sort(all);
    return all[all.size() / 2];
  };
  double spread = 0;
  for (std::size_t i = 0; i < alone.size(); ++i) spread = std::max(spread, std::abs(alone[i] - other[i]));
  EXPECT_LE(median(visited), std::max(median(alone), median(other)) + std::max(spread, 1.0));
  EXPECT_EQ(lost, 0u);
  EXPECT_GE(answered, static_cast<std::uint64_t>(kClients * rounds * seconds / 4));
}

}  // namespace
}  // namespace stadion
