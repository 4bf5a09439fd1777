/// Address, token, log, copies of views, metrics: the parts of the operator's page without its network.

#include "show/web/view_tap.h"
#include "show/web/view_thumbnails.h"
#include "show/web/web_address.h"
#include "show/web/web_log.h"
#include "show/web/web_metrics.h"
#include "show/web/web_token.h"
#include "tests/programs/program.h"

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <thread>

namespace stadion {
namespace {

TEST(WebAddress, APortAloneIsOnLoopback) {
  const auto port = WebAddress::parse("8080");
  ASSERT_TRUE(port);
  EXPECT_EQ(port.value().authority(), "127.0.0.1:8080");
  EXPECT_TRUE(port.value().isLoopback());
  EXPECT_EQ(WebAddress::parse("[::1]:80").value().authority(), "[::1]:80");
  EXPECT_FALSE(WebAddress::parse("0.0.0.0:80").value().isLoopback());
  for (const char* wrong : {"", "x", "70000", "localhost:80", "1.2.3.4", "1.2.3.4:", "::1:80", "[::1]",
                            "[::1]x:80", "1.2.3.4:80:90", "-1", "80 "})
    EXPECT_FALSE(WebAddress::parse(wrong)) << wrong;
}

TEST(WebAddress, AForeignNameIsNotOurHost) {
  const std::vector<std::string> names{"hall.example"};
  for (const char* own : {"127.0.0.1:8080", "127.0.0.1", "localhost", "LOCALHOST:1", "[::1]:8080",
                          "10.0.0.7:80", "Hall.Example", "hall.example:443"})
    EXPECT_TRUE(isOwnHost(own, names)) << own;
  for (const char* foreign : {"", "evil.example", "evil.example:8080", "127.0.0.1.evil.example",
                              "localhost.evil", "[::1", "[x]:80", "localhost:x", "hall.example.evil"})
    EXPECT_FALSE(isOwnHost(foreign, names)) << foreign;
}

TEST(WebToken, TwoTokensDifferAndOnlyTheSameMatches) {
  const auto a = WebToken::make(), b = WebToken::make();
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a.value().text().size(), 32u);
  EXPECT_NE(a.value().text(), b.value().text());
  EXPECT_TRUE(a.value().matches(a.value().text()));
  const std::string text = a.value().text();
  for (const std::string& wrong :
       {std::string(), text.substr(1), text + "0", b.value().text(), text + std::string(1, '\0')})
    EXPECT_FALSE(a.value().matches(wrong)) << wrong;
}

TEST(WebToken, AFileGivesItsFirstLineOrAReason) {
  const TestFolder folder;
  Diagnostics findings;
  const std::string good = folder.write("good", "0123456789abcdef+/=\r\nmore\n");
  chmod(good.c_str(), 0600);
  EXPECT_EQ(WebToken::load(good, findings).value().text(), "0123456789abcdef+/=");
  EXPECT_TRUE(findings.all().empty());
  chmod(good.c_str(), 0644);
  EXPECT_TRUE(WebToken::load(good, findings));
  EXPECT_EQ(findings.all().size(), 1u) << "others can read it";
  EXPECT_FALSE(WebToken::load(folder.write("short", "abc\n"), findings));
  EXPECT_FALSE(WebToken::load(folder.write("long", std::string(5000, 'a')), findings));
  const auto odd = WebToken::load(folder.write("odd", "0123456789abcdef<>\n"), findings);
  ASSERT_FALSE(odd);
  EXPECT_EQ(odd.error().where.column, 17u);
  EXPECT_FALSE(WebToken::load((folder.path() / "none").string(), findings));
}

TEST(WebLog, KeepsTheLastLinesInTheirOrder) {
  WebLog log;
  log.add(1, "one");
  log.add(2, "two");
  const auto lines = log.linesAfter(0);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[1].text, "two");
  EXPECT_EQ(log.linesAfter(1).size(), 1u);
  for (std::size_t i = 0; i < 2 * WebLog::kMost; ++i) log.add(3, std::string(1000, 'x'));
  EXPECT_GT(log.dropped(), 0u) << "no reader has come";
  EXPECT_EQ(log.linesAfter(0).size(), WebLog::kMost);
  EXPECT_EQ(log.linesAfter(0).back().text.size(), WebLog::kLongest);
}

TEST(ThreadsWebLog, WritersAndReadersLoseNoLine) {
  WebLog log;
  std::vector<std::thread> writers;
  for (int w = 0; w < 3; ++w)
    writers.emplace_back([&log] {
      for (int i = 0; i < 100; ++i) log.add(i, std::to_string(i));
    });
  std::uint64_t seen = 0;
  while (seen < 300)
    for (const WebLogLine& line : log.linesAfter(seen)) EXPECT_EQ(line.number, ++seen);
  for (std::thread& w : writers) w.join();
  EXPECT_EQ(log.dropped(), 0u);
}

std::vector<EyePictures> wallsOf(std::uint64_t frame, std::uint32_t width, std::uint32_t height) {
  std::vector<EyePictures> walls(2);
  for (std::size_t w = 0; w < walls.size(); ++w)
    walls[w] = {frame,
                {Picture(width, height, static_cast<std::uint8_t>(10 * w)),
                 Picture(width, height, static_cast<std::uint8_t>(10 * w + 1))}};
  return walls;
}

TEST(ViewTap, CopiesTheViewThatWasAskedForOnce) {
  ViewTap tap;
  TimeSignature now;
  now.frame = 7;
  EXPECT_FALSE(tap.wants(now));
  ASSERT_TRUE(tap.ask(1, 0));
  EXPECT_TRUE(tap.wants(now));
  EXPECT_TRUE(tap.wantsWall(now, 1));
  EXPECT_FALSE(tap.wantsWall(now, 0)) << "the other wall is not read back";
  ViewTap::Copy copy;
  tap.take(now, wallsOf(6, 1600, 1200));
  EXPECT_FALSE(tap.collect(copy)) << "pictures of an earlier frame";
  tap.take(now, wallsOf(7, 1600, 1200));
  ASSERT_TRUE(tap.collect(copy));
  EXPECT_EQ(copy.frame, 7u);
  EXPECT_EQ(copy.picture.width, 533u) << "each third pixel";
  EXPECT_EQ(copy.picture.height, 400u);
  EXPECT_EQ(copy.picture.at(5, 5)[0], 10);
  EXPECT_FALSE(tap.wants(now));
  EXPECT_TRUE(tap.ask(5, 5));
  tap.take(now, wallsOf(7, 16, 12));
  ASSERT_TRUE(tap.collect(copy)) << "a wall that is not there gives no picture";
  EXPECT_TRUE(copy.picture.empty());
}

TEST(ViewThumbnails, ASmallPictureIsTheMeanOfItsPixels) {
  Picture picture(4, 4, 0);
  for (std::uint32_t x = 0; x < 2; ++x) picture.at(x, 0)[0] = 200;
  const Picture small = madeSmall(picture, 2);
  ASSERT_EQ(small.width, 2u);
  EXPECT_EQ(small.at(0, 0)[0], 100);
  EXPECT_EQ(small.at(1, 1)[0], 0);
  EXPECT_EQ(madeSmall(picture, 100).width, 4u);
}

TEST(ThreadsViewThumbnails, PicturesComeWhileSomebodyLooks) {
  ViewTap tap;
  ViewThumbnails thumbnails(tap);
  thumbnails.setViews({2, 2});
  TimeSignature now;
  thumbnails.look();
  while (thumbnails.version(1, 1) == 0) {
    ++now.frame;
    if (tap.wants(now)) tap.take(now, wallsOf(now.frame, 64, 48));
    thumbnails.look();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_TRUE(thumbnails.png(1, 1).starts_with("\x89PNG"));
  EXPECT_EQ(thumbnails.png(7, 0), "");
}

TEST(WebMetrics, TextsAreThoseOfPrometheus) {
  WebMetrics m;
  m.status.show.script = "a\"b\\c.evs";
  m.status.show.walls = {{"front", {"left", "right"}}};
  m.status.phase = BoardPhase::Playing;
  m.frames.late[Cause::Draw] = 3;
  m.frames.stages[{Span::Draw, 0}] = {10, 0.1, 0.01, 0.011, 0.012, 0.02};
  m.frames.drawnAgo[0] = 0.01;
  const std::string text = metricsText(m);
  EXPECT_TRUE(has(text, "show=\"a\\\"b\\\\c.evs\"")) << text;
  EXPECT_TRUE(has(text, "stadion_late_frames_total{cause=\"Draw over\"} 3\n"));
  EXPECT_TRUE(has(text, "stadion_stage_seconds{stage=\"draw\",wall=\"front\",quantile=\"0.99\"} 0.012\n"));
  EXPECT_TRUE(has(text, "stadion_stage_seconds_count{stage=\"draw\",wall=\"front\"} 10\n"));
  EXPECT_TRUE(has(text, "stadion_wall_well{wall=\"front\"} 1\n"));
  EXPECT_TRUE(has(text, "stadion_phase{phase=\"playing\"} 1\n"));
}

}  // namespace
}  // namespace stadion
