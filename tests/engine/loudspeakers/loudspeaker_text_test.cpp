/// Loudspeakers in wall files: read, written, checked and aligned.

#include "engine/display/wall_file.h"
#include "engine/display/wall_lint.h"
#include "engine/loudspeakers/loudspeaker_text.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

namespace stadion {
namespace {

const std::string kOneWall =
    "wall front  lower-left -1.5 1.5 0   lower-right 1.5 1.5 0   upper-left -1.5 1.5 3\n";

std::optional<WallFile> readLoudspeakers(const std::string& text, Diagnostics& out) {
  auto walls = parseWalls(kOneWall + text, "hall.walls", out);
  if (walls) lintWalls(*walls, out);
  return walls;
}

std::string loudspeakerFindings(const std::string& text) {
  Diagnostics found;
  readLoudspeakers(text, found);
  std::string all;
  for (const Diagnostic& d : found.all()) all += format(d) + '\n';
  return all;
}

TEST(Loudspeakers, AreReadWithTheirFieldsInTheUnitOfTheFile) {
  Diagnostics found;
  const auto walls = parseWalls(
      "unit cm\nwall front  lower-left -150 150 0  lower-right 150 150 0  upper-left -150 150 300\n"
      "sound  card plughw:2  align off\nvisitor 0 0 160 within 50\n"
      "loudspeaker left   -200 200 160\n"
      "loudspeaker right   200 200 160  channel 5  delay 2.5  gain -6\n"
      "loudspeaker low       0 200  20  subwoofer 90\n",
      "hall.walls", found);
  ASSERT_TRUE(walls && found.all().empty());
  const LoudspeakerSet& hall = walls->loudspeakers;
  ASSERT_EQ(hall.all.size(), 3U);
  EXPECT_EQ(hall.card, "plughw:2");
  EXPECT_FALSE(hall.aligned);
  EXPECT_EQ(hall.ear, Vec3(0, 0, 1.6));
  EXPECT_EQ(hall.reach, 0.5);
  EXPECT_EQ(hall.all[0].place, Vec3(-2, 2, 1.6));
  EXPECT_EQ(hall.all[0].channel, 0U);
  EXPECT_EQ(hall.all[1].channel, 4U);
  EXPECT_EQ(hall.all[2].channel, 5U) << "the one after";
  EXPECT_EQ(hall.channels(), 6U);
  EXPECT_DOUBLE_EQ(hall.all[1].delay, 0.0025);
  EXPECT_NEAR(hall.all[1].gain, 0.501187, 1e-6);
  EXPECT_EQ(hall.all[2].crossover, 90);
  EXPECT_TRUE(hall.all[2].isSubwoofer());
}

TEST(Loudspeakers, AreWrittenAsTheyAreRead) {
  Diagnostics found;
  const auto read =
      readLoudspeakers("sound card hw:1\nvisitor 0.1 0 1.6 within 0.5\n"
                       "loudspeaker a -2 2 1.5 channel 3 delay 0.25\nloudspeaker b 2 2.5 1.75 gain -3\n"
                       "loudspeaker c 0 3 0.25 subwoofer 80\n",
                       found);
  ASSERT_TRUE(read && found.all().empty());
  const auto again = parseWalls(formatWalls(*read), "again.walls", found);
  ASSERT_TRUE(again) << formatWalls(*read);
  ASSERT_EQ(again->loudspeakers.all.size(), 3U);
  EXPECT_EQ(again->loudspeakers.card, "hw:1");
  EXPECT_EQ(again->loudspeakers.ear, read->loudspeakers.ear);
  for (std::size_t i = 0; i < 3; ++i) {
    const Loudspeaker &a = read->loudspeakers.all[i], &b = again->loudspeakers.all[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.place, b.place);
    EXPECT_EQ(a.channel, b.channel);
    EXPECT_EQ(a.crossover, b.crossover);
    EXPECT_NEAR(a.delay, b.delay, 1e-12);
    EXPECT_NEAR(a.gain, b.gain, 1e-12);
  }
  Diagnostics none;
  const auto without = readLoudspeakers("", none);
  ASSERT_TRUE(without);
  EXPECT_EQ(formatWalls(*without).find("sound"), std::string::npos);
}

TEST(Loudspeakers, WrongWordsAreErrorsAtTheirPlace) {
  const struct {
    const char *text, *message;
  } cases[] = {
      {"loudspeaker a 0 2\n", "hall.walls:2:"},
      {"loudspeaker a 0 2 1 channel 65\n", "channel"},
      {"loudspeaker a 0 2 1 delay -1\n", "delay"},
      {"loudspeaker a 0 2 1 gain 40\n", "gain"},
      {"loudspeaker a 0 2 1 subwoofer 5\n", "crossover frequency"},
      {"loudspeaker a 0 2 1 channle 2\n", "did you mean \"channel\"?"},
      {"loudspeaker a 0 2 1\nloudspeaker a 1 2 1\n", "a loudspeaker \"a\" already, on line 2"},
      {"loudspeaker a 0 2 1 channel 64\nloudspeaker b 1 2 1\n", "would have channel 65"},
      {"sound\n", "sound says nothing"},
      {"sound align maybe\n", "maybe"},
      {"sound card\n", "the sound card"},
      {"sound card hw:0\nsound card hw:1\n", "sound"},
  };
  for (const auto& c : cases) {
    const std::string found = loudspeakerFindings(c.text);
    EXPECT_NE(found.find(c.message), std::string::npos) << c.text << found;
    EXPECT_NE(found.find("error"), std::string::npos) << c.text << found;
  }
  std::string many;
  for (int i = 0; i < 66; ++i) many += fmt::format("loudspeaker s{} {} 2 1 channel 1\n", i, i);
  EXPECT_NE(loudspeakerFindings(many).find("at most 64 loudspeakers"), std::string::npos);
}

TEST(Loudspeakers, TheCheckFindsWhatIsWrongWithTheWhole) {
  const std::string front = "loudspeaker a -2 2 1.7\nloudspeaker b 2 2 1.7\n";
  EXPECT_EQ(loudspeakerFindings(front), "");
  const struct {
    std::string text;
    const char *severity, *message;
  } cases[] = {
      {front + "loudspeaker c 0 2 2.5 channel 2\n", "error", "\"b\" and \"c\" have the same channel 2"},
      {front + "loudspeaker c -4 4 1.7\n", "error", "\"a\" and \"c\" are in the same direction"},
      {"loudspeaker c 0 2 0.2 subwoofer 100\n", "error", "only subwoofers"},
      {"loudspeaker c 1 -2 1.7\nloudspeaker d -1 -2 1.7\n", "warning", "behind the visitor"},
      {front + "loudspeaker c 0.2 -0.3 1.7\n", "warning", "0.36 m away from a visitor"},
      {front + "loudspeaker c 0 2000 1.7\n", "warning", "check the unit"},
  };
  for (const auto& c : cases) {
    const std::string found = loudspeakerFindings(c.text);
    EXPECT_NE(found.find(c.message), std::string::npos) << c.text << found;
    EXPECT_NE(found.find(c.severity), std::string::npos) << c.text << found;
  }
  EXPECT_EQ(loudspeakerFindings(
                front + "loudspeaker low 0 2 0.1 subwoofer 100\nloudspeaker low2 0 3 -0.7 subwoofer 100\n"),
            "")
      << "subwoofers have no direction";
}

TEST(Loudspeakers, NearerOnesAreDelayedAndSofter) {
  LoudspeakerSet hall;
  hall.ear = Vec3(0, 0, 1.7);
  hall.all.resize(2);
  hall.all[0].place = Vec3(0, 3.43, 1.7);
  hall.all[1].place = Vec3(1.715, 0, 1.7);
  hall.all[1].channel = 1, hall.all[1].delay = 0.001, hall.all[1].gain = 0.5;
  auto aligned = soundAlignment(hall);
  EXPECT_NEAR(aligned[0].delay, 0, 1e-12);
  EXPECT_NEAR(aligned[0].gain, 1, 1e-12);
  EXPECT_NEAR(aligned[1].delay, 0.005 + 0.001, 1e-12);
  EXPECT_NEAR(aligned[1].gain, 0.5 * 0.5, 1e-12);
  hall.aligned = false;
  aligned = soundAlignment(hall);
  EXPECT_EQ(aligned[1].delay, 0.001);
  EXPECT_EQ(aligned[1].gain, 0.5);
}

TEST(Loudspeakers, TheFloorPlanListsThem) {
  Diagnostics found;
  const auto walls =
      readLoudspeakers("loudspeaker a -2 2 1.7\nloudspeaker low 0 1 0 channel 7 subwoofer 90\n", found);
  ASSERT_TRUE(walls);
  const std::string plan = floorPlan(*walls);
  EXPECT_NE(plan.find("channel  1, 2.83 m at azimuth -45, elevation 0 degrees, delay 0.00 ms, gain 0.0 dB\n"),
            std::string::npos)
      << plan;
  EXPECT_NE(plan.find("channel  7, 1.97 m at azimuth 0, elevation -60 degrees"), std::string::npos) << plan;
  EXPECT_NE(plan.find(", below 90 Hz"), std::string::npos) << plan;
}

}  // namespace
}  // namespace stadion
