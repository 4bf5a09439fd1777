/// `stadion view` on a display in memory, driven by keys and mouse as a person would.

#include "pipeline/picture/picture.h"
#include "tests/programs/desk.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <lo/lo.h>
#include <optional>
#include <sstream>

namespace stadion {
namespace {

/// The number behind `word` in the text.
double numberAfter(const std::string& text, const std::string& word) {
  const std::size_t at = text.rfind(word);
  return at == text.npos ? std::nan("") : std::strtod(text.c_str() + at + word.size(), nullptr);
}

/// A show that somebody views, in a folder of its own.
class Viewing {
public:
  Viewing(const Display& display, std::string show, std::vector<std::string> more = {"--walls", "desktop"})
      : display_(display), program_(onDisplay(display, words(std::move(show), std::move(more)))) {
    playing_ = program_.says("playing ");
    display_.hands({"mousemove", "200", "150"});
  }

  bool playing() const { return playing_; }
  std::filesystem::path folder() const { return folder_.path(); }
  RunningProgram& program() { return program_; }
  void hands(std::vector<std::string> what) { display_.hands(std::move(what)); }
  void press(const std::string& key) { hands({"key", key}); }
  bool pressed(const std::string& key, const std::string& answer, int times = 1) {
    press(key);
    return program_.says(answer, times);
  }
  /// Walks forward for 90 frames, however long the machine takes for them, and plays on.
  bool walks() {
    if (!pressed("space", "paused at") || !pressed("period", "one frame, to ")) return false;
    const auto reached = [&] { return numberAfter(program_.err(), "one frame, to "); };
    const double end = reached() + 90.0 / 60;
    hands({"keydown", "w", "key", "--delay", "4", "--repeat", "90", "period"});
    const bool there = program_.waitUntil([&] { return reached() > end - 0.5 / 60; });
    hands({"keyup", "w"});
    return there && pressed("space", "going on at");
  }
  /// Quits, and returns what it said of the whole.
  std::string end() {
    press("Escape");
    EXPECT_EQ(program_.status(), 0) << program_.err();
    return program_.out();
  }
  std::string log() const { return folder_.path() / "desk.input"; }
  /// The screenshot of the window with that number.
  Picture shot(int number, const std::string& what = "window") const {
    char name[64];
    std::snprintf(name, sizeof name, "shots/%03d-%s.png", number, what.c_str());
    auto picture = readPng(folder_.path() / name);
    EXPECT_TRUE(picture) << name;
    return picture ? picture.value() : Picture{};
  }

private:
  /// In the look that costs less, unless another one is asked for.
  std::vector<std::string> words(std::string show, std::vector<std::string> more) {
    if (std::ranges::find(more, "--look") == more.end()) more.insert(more.end(), {"--look", "plain"});
    std::vector<std::string> w{
        "view",    std::move(show), "--asset-root",           assetFolder(),    "--window",
        "400x300", "--out",         folder_.path() / "shots", "--record-input", log()};
    w.insert(w.end(), more.begin(), more.end());
    return w;
  }

  TestFolder folder_;
  const Display& display_;
  RunningProgram program_;
  bool playing_ = false;
};

#define REQUIRE_DISPLAY(display)                                                                             \
  const auto display = Display::open();                                                                      \
  if (!display) GTEST_SKIP() << "needs Xvfb, xdotool and import: apt-get install xvfb xdotool imagemagick"

std::string hashIn(const std::string& text) {
  const std::string word = "state hash ";
  return text.substr(text.find(word) + word.size(), 16);
}

TEST(ProgramView, WithoutADisplaySaysWhatToDo) {
  ProgramRun run{{stadionPath(), "view", testShow("desk.evs"), "--asset-root", assetFolder()}};
  run.environment = {"DISPLAY="};
  const ProgramResult r = runProgram(run);
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("there is no display"), r.err.npos) << r.err;
  EXPECT_NE(r.err.find("--out DIR"), r.err.npos) << r.err;
}

TEST(ProgramView, HelpTellsEveryKey) {
  const std::string help = stadionProgram({"view", "--help"}).out;
  for (const char* key : {"F1", "F2", "F5", "F12", "W S A D", "space", "[ ]", "Esc", "wheel", "gamepad",
                          "next group", "freeze the head", "--osc", "--no-sound"})
    EXPECT_NE(help.find(key), help.npos) << key;
}

TEST(ProgramView, ShowsAModelAndTheOneThatIsSavedInItsPlace) {
  REQUIRE_DISPLAY(display);
  const TestFolder folder;
  const std::string model = folder.path() / "model.glb";
  std::filesystem::copy_file(assetFolder() + "/discus.glb", model);
  Viewing view(*display, model);
  ASSERT_TRUE(view.playing());
  ASSERT_TRUE(view.pressed("F12", "screenshot:"));
  const auto discus = view.shot(1);
  std::filesystem::copy_file(assetFolder() + "/judge.glb", model,
                             std::filesystem::copy_options::overwrite_existing);
  ASSERT_TRUE(view.program().says(model + " was saved"));
  ASSERT_TRUE(view.program().says("playing " + model, 2));
  ASSERT_TRUE(view.pressed("F12", "screenshot:", 2));
  EXPECT_NE(view.shot(2).rgba, discus.rgba);
  view.end();
}

TEST(ProgramView, PausesGoesFrameByFrameAndSlowly) {
  REQUIRE_DISPLAY(display);
  Viewing view(*display, testShow("desk.evs"));
  ASSERT_TRUE(view.playing());
  ASSERT_TRUE(view.pressed("space", "paused at"));
  ASSERT_TRUE(view.pressed("bracketleft", "speed 1/2"));
  ASSERT_TRUE(view.pressed("bracketleft", "speed 1/4"));
  ASSERT_TRUE(view.pressed("bracketright", "speed 1/2", 2));
  ASSERT_TRUE(view.pressed("space", "going on at"));
  view.end();
}

TEST(ProgramView, ASingleStepIsOneFrame) {
  REQUIRE_DISPLAY(display);
  Viewing view(*display, testShow("desk.evs"));
  ASSERT_TRUE(view.playing());
  ASSERT_TRUE(view.pressed("space", "paused at"));
  ASSERT_TRUE(view.pressed("period", "one frame, to "));
  ASSERT_TRUE(view.pressed("F12", "screenshot:"));  // takes a while, in which the show must stand still
  ASSERT_TRUE(view.pressed("period", "one frame, to ", 2));
  const std::string said = view.program().err();
  const double second = numberAfter(said, "one frame, to ");
  const double first = numberAfter(said.substr(0, said.rfind("one frame, to ")), "one frame, to ");
  EXPECT_NEAR(second - first, 1.0 / 60, 0.0011);  // told in milliseconds
  view.end();
}

/// A show in which something can be taken and thrown, and what the visitor does to come to it.
struct Throw {
  const char* name;
  std::string show;
  int walk;            ///< frames with the joypad held forward
  int right, down;     ///< how far the hand is dragged to it [pixels]
  int wait;            ///< frames until all is there
  const char* letGo;   ///< X's number of the mouse button that lets it fly; "": the one that took it, let go
  std::string thrown;  ///< what flies then
};

void PrintTo(const Throw& t, std::ostream* out) {
  *out << t.name;
}

class ProgramViewThrow : public testing::TestWithParam<Throw> {
protected:
  /// Goes on by that many single frames, so that the machine's speed decides nothing.
  void go(Viewing& view, int frames) {
    reached_ += frames / 60.0;
    view.hands({"key", "--delay", "4", "--repeat", std::to_string(frames), "period"});
    view.program().waitUntil(
        [&] { return numberAfter(view.program().err(), "one frame, to ") > reached_ - 0.5 / 60; });
  }
  double reached_ = 0;
};

// The visitor takes what lies before the hand, swings it and lets go; the record tells the same again.
TEST_P(ProgramViewThrow, FliesWithTheHandsSpeedAndTheRecordRepeatsIt) {
  REQUIRE_DISPLAY(display);
  const Throw& t = GetParam();
  Viewing view(*display, t.show);
  ASSERT_TRUE(view.playing());
  ASSERT_TRUE(view.pressed("space", "paused at"));
  ASSERT_TRUE(view.pressed("period", "one frame, to "));
  reached_ = numberAfter(view.program().err(), "one frame, to ");
  if (t.walk > 0) {
    view.hands({"keydown", "w"});
    go(view, t.walk);
    view.hands({"keyup", "w"});
  }
  // The middle button drags without taking anything.
  view.hands({"mousedown", "2", "mousemove_relative", "--", std::to_string(t.right), std::to_string(t.down),
              "mouseup", "2"});
  go(view, 10 + t.wait);
  view.hands({"mousedown", "1"});  // takes it
  go(view, 6);
  for (int i = 0; i < 10; ++i) {  // swings it up and forward
    view.hands({"mousemove_relative", "--", "2", "-12"});
    go(view, 1);
  }
  const bool held = *t.letGo == '\0';
  view.hands({held ? "mouseup" : "mousedown", held ? "1" : t.letGo, "mousemove_relative", "--", "2", "-12"});
  go(view, 1);
  if (!held) view.hands({"mouseup", t.letGo, "mouseup", "1"});
  go(view, 40);
  const std::string told = view.end();

  const std::string out = view.folder() / "again";
  const ProgramResult again = stadionProgram(
      {"run", t.show, "--asset-root", assetFolder(), "--walls", "desktop", "--size", "32x24", "--look",
       "plain", "--pictures", "none", "--input", view.log(), "--out", out, "--track", t.thrown});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_NE(fileContent(out + "/summary.json").find(hashIn(told)), std::string::npos) << told << "\nagainst\n"
                                                                                      << again.out;
  // Held, then in flight, upwards: only the hand can have done that.
  std::string file = t.thrown;
  std::ranges::replace(file, '/', '_');
  std::ifstream table(out + "/track-" + file + ".csv");
  bool wasHeld = false;
  double fastest = 0;
  for (std::string line; std::getline(table, line);) {
    wasHeld |= line.ends_with("held");
    std::vector<double> v;
    std::istringstream fields(line);
    for (std::string f; std::getline(fields, f, ',');) v.push_back(std::strtod(f.c_str(), nullptr));
    if (wasHeld && line.ends_with("flight") && v.size() > 10) fastest = std::max(fastest, v[10]);
  }
  EXPECT_TRUE(wasHeld) << told;
  EXPECT_GT(fastest, 0.5) << "upwards [m/s]";
}

INSTANTIATE_TEST_SUITE_P(Program, ProgramViewThrow,
                         testing::Values(Throw{"desk", testShow("desk.evs"), 0, 0, 0, 0, "3", "ball"},
                                         Throw{"hold", testShow("hold.evs"), 0, 0, 0, 0, "", "ball"}),
                         [](const auto& each) { return std::string(each.param.name); });
INSTANTIATE_TEST_SUITE_P(ProgramFull, ProgramViewThrow,
                         testing::Values(Throw{"olympia", assetFolder() + "/../scripts/olympia.evs", 180, 80,
                                               100, 20, "2", "discus/discus"}),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(ProgramView, KeysWalkAndASavedScriptKeepsTheVisitorsPlace) {
  REQUIRE_DISPLAY(display);
  const TestFolder scripts;
  scripts.write("desk_corner.evs", fileContent(testShow("desk_corner.evs")));
  const std::string text = fileContent(testShow("desk.evs"));
  const std::string show = scripts.write("desk.evs", text);
  Viewing view(*display, show);
  ASSERT_TRUE(view.playing());
  ASSERT_TRUE(view.walks());

  scripts.write("desk.evs",
                text + "object( name=more, file=nowhere_to_be_found.3ds, positon=\"0, 1, 1\" )\n");
  ASSERT_TRUE(view.program().says("the script has errors; the show goes on as it was"));
  EXPECT_NE(view.program().err().find("did you mean \"position\"?"), std::string::npos);
  ASSERT_TRUE(view.pressed("F12", "screenshot:"));

  scripts.write("desk.evs",
                text + "object( name=more, file=football.3ds, position=\"0, 3, 1.7\", scale=4 )\n");
  ASSERT_TRUE(view.program().says("reloaded "));
  const std::string at = "the rig stands at 0.000 ";
  const double walked = numberAfter(view.program().err(), at);
  EXPECT_GT(walked, 0.1);
  ASSERT_TRUE(view.program().says("playing ", 2));
  ASSERT_TRUE(view.pressed("F12", "screenshot:", 2));
  EXPECT_NE(imageHash(view.shot(1, "screen")), imageHash(view.shot(2, "screen"))) << "what was added is seen";
  const std::string told = view.end();
  EXPECT_NEAR(numberAfter(told, at), walked, 1e-3);
}

/// Sends a command of the operator without a figure, or with one.
void order(std::uint16_t port, const char* path, std::optional<double> figure = {}) {
  const lo_address to = lo_address_new("127.0.0.1", std::to_string(port).c_str());
  figure ? lo_send(to, path, "d", *figure) : lo_send(to, path, "");
  lo_address_free(to);
}

std::size_t blackPixels(const Picture& p) {
  std::size_t count = 0;
  for (std::size_t i = 0; i + 3 < p.rgba.size(); i += 4)
    count += p.rgba[i] + p.rgba[i + 1] + p.rgba[i + 2] == 0 ? 1 : 0;
  return count;
}

TEST(ProgramView, TheOperatorsCommandsComeByKeysAndOverTheNetwork) {
  REQUIRE_DISPLAY(display);
  const std::uint16_t port = freePort();
  Viewing view(*display, testShow("desk.evs"),
               {"--walls", "desktop", "--stereo", "anaglyph", "--osc", std::to_string(port)});
  ASSERT_TRUE(view.playing());
  ASSERT_TRUE(view.pressed("b", "operator: black on"));
  ASSERT_TRUE(view.pressed("period", "one frame, to "));  // the black ones have been seen
  ASSERT_TRUE(view.pressed("F12", "screenshot:"));
  order(port, "/stadion/black", 0);
  ASSERT_TRUE(view.program().says("operator: black off"));
  ASSERT_TRUE(view.pressed("period", "one frame, to ", 2));
  ASSERT_TRUE(view.pressed("F12", "screenshot:", 2));
  ASSERT_TRUE(view.pressed("x", "operator: swap-eyes on"));
  ASSERT_TRUE(view.pressed("period", "one frame, to ", 3));
  ASSERT_TRUE(view.pressed("F12", "screenshot:", 3));
  ASSERT_TRUE(view.pressed("braceright", "operator: eye-separation 0.0660 m"));
  order(port, "/stadion/pause", 0);
  ASSERT_TRUE(view.program().says("operator: going on at "));
  order(port, "/stadion/volume", 0.5);
  ASSERT_TRUE(view.program().says("operator: volume 50 %"));
  ASSERT_TRUE(view.pressed("f", "operator: freeze-head on ("));
  view.end();
  const Picture black = view.shot(1, "screen-left");
  EXPECT_EQ(blackPixels(black), std::size_t{black.width} * black.height);
  EXPECT_LT(blackPixels(view.shot(2, "screen-left")), 10u);
  EXPECT_EQ(imageHash(view.shot(3, "screen-left")) == imageHash(view.shot(2, "screen-left")), false);
  EXPECT_NE(fileContent(view.log()).find(" black 1"), std::string::npos) << "it is in the record";
}

TEST(ProgramView, TheNextGroupFindsTheShowAtItsStartAndHasARecordOfItsOwn) {
  REQUIRE_DISPLAY(display);
  Viewing view(*display, testShow("desk.evs"));
  ASSERT_TRUE(view.playing());
  ASSERT_TRUE(view.walks());
  ASSERT_TRUE(view.pressed("n", "group 2 begins: reset in "));
  ASSERT_TRUE(view.program().says("playing ", 2));
  ASSERT_TRUE(view.pressed("space", "paused at"));
  ASSERT_TRUE(view.pressed("period", "one frame, to "));
  const std::string told = view.end();
  EXPECT_NEAR(numberAfter(told, "the rig stands at 0.000 "), 0, 1e-3) << told;
  const std::string second = (view.folder() / "desk-2.input").string();
  for (const std::string& log : {view.log(), second}) {
    const ProgramResult again = stadionProgram(
        {"hash", testShow("desk.evs"), "--asset-root", assetFolder(), "--walls", "desktop", "--input", log});
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(again.out.ends_with(hashIn(told) + "\n"), log == second) << again.out << told;
  }
}

TEST(ProgramView, AGroupsDistancesAreToldWhenItEnds) {
  REQUIRE_DISPLAY(display);
  const TestFolder scripts;
  Viewing view(*display, scripts.write("drop.evs", R"(forcelinear( name=gravity, direction="0, 0, -1" )
object( name=floor, file=plane.3ds )
dynobject( name=ours, file=football.3ds, position="-1, 4.37, 1", hook=gravity )
dynobject( name=theirs, file=football.3ds, position="1, 4.12, 2", hook=gravity )
dynamics( collider=floor, collidee=ours, collidee=theirs )
measure( name=visitor, body=ours )
measure( name=athlete, body=theirs )
timer( period=0.1, repeat=off, eventmessage="timesup, visitor, start", eventmessage="timesup, athlete, start" )
)"));
  ASSERT_TRUE(view.playing());
  double reached = 0;  // the balls take less than a second
  for (int i = 1; i < 100 && !(reached > 1.5); ++i) {
    ASSERT_TRUE(view.pressed("space", "paused at", i));
    reached = numberAfter(view.program().err(), "paused at ");
    ASSERT_TRUE(view.pressed("space", "going on at", i));
  }
  ASSERT_TRUE(view.pressed("n", "group 1 ends at "));
  ASSERT_TRUE(view.program().says("visitor 4.370 m, athlete 4.120 m")) << view.program().err();
  view.end();
}

TEST(ProgramView, ANextGroupWhoseScriptHasErrorsWaitsForItToBeMended) {
  REQUIRE_DISPLAY(display);
  const TestFolder scripts;
  scripts.write("desk_corner.evs", fileContent(testShow("desk_corner.evs")));
  const std::string text = fileContent(testShow("desk.evs"));
  const std::string show = scripts.write("desk.evs", text);
  Viewing view(*display, show);
  ASSERT_TRUE(view.playing());
  scripts.write("desk.evs", text + "object( positon=\"0, 1, 1\" )\n");
  ASSERT_TRUE(view.program().says("the script has errors; the show goes on as it was"));
  ASSERT_TRUE(view.pressed("n", "the next group's show begins once it is saved without them"));
  scripts.write("desk.evs", text);
  ASSERT_TRUE(view.program().says("reloaded "));
  ASSERT_TRUE(view.program().says("playing ", 2));
  view.end();
}

/// Everything of it changes no state, but for what the script says.
constexpr const char* kCountingShow =
    "object( name=floor, file=plane.3ds )\n"
    "dynobject( name=ball, file=football.3ds, position=\"0, 3, 9\", density=0.1 )\n"
    "forcelinear( name=gravity, direction=\"0, 0, -1\" )\n"
    "dynamics( collider=floor, collidee=ball )\n"
    "scene( name=part, file=part.evs, initstate=off, ready=0 )\n"
    "wandtrigger( sphere=\"0, 0, 0, 100\", eventmessage=\"button1, part, load\" )\n";

TEST(ProgramView, ABrokenScriptThatIsSavedCostsNothingOfTheRecord) {
  REQUIRE_DISPLAY(display);
  const TestFolder scripts;
  scripts.write("part.evs", "timer( name=inside, period=1 )\n");
  const std::string show = scripts.write("show.evs", kCountingShow);
  Viewing view(*display, show);
  ASSERT_TRUE(view.playing());
  scripts.write("show.evs", std::string(kCountingShow) + "dynobj(");
  ASSERT_TRUE(view.program().says("the script has errors; the show goes on as it was"));
  ASSERT_TRUE(view.pressed("space", "paused at"));
  ASSERT_TRUE(view.pressed("period", "one frame, to "));
  const double reached = numberAfter(view.program().err(), "one frame, to ");
  const std::string told = view.end();  // with exit code 0
  EXPECT_EQ(view.program().err().find("cannot be written"), std::string::npos) << view.program().err();
  scripts.write("show.evs", kCountingShow);
  const ProgramResult again = stadionProgram(
      {"hash", show, "--asset-root", assetFolder(), "--walls", "desktop", "--input", view.log()});
  EXPECT_TRUE(again.out.ends_with(hashIn(told) + "\n")) << again.out << told << reached;
}

TEST(ProgramView, ARecordEndsOnceWhereAnotherScriptBegins) {
  REQUIRE_DISPLAY(display);
  const TestFolder scripts;
  scripts.write("part.evs", "timer( name=inside, period=1 )\n");
  const std::string show = scripts.write("show.evs", kCountingShow);
  Viewing view(*display, show);
  ASSERT_TRUE(view.playing());
  ASSERT_TRUE(view.pressed("F5", "reloaded "));
  ASSERT_TRUE(view.program().says("playing ", 2));
  scripts.write("show.evs", std::string(kCountingShow) + "dynobj(");
  ASSERT_TRUE(view.program().says("the script has errors; the show goes on as it was"));
  ASSERT_TRUE(view.pressed("n", "the next group's show begins once it is saved without them"));
  view.end();
  EXPECT_FALSE(fileContent(view.log()).empty());
}

TEST(ProgramView, TheOldShowPlaysWithTheSubScenesThatItWasCheckedWith) {
  REQUIRE_DISPLAY(display);
  const TestFolder scripts;
  const std::string part = scripts.write("part.evs", "timer( name=inside, period=1 )\n");
  Viewing view(*display, scripts.write("show.evs", kCountingShow));
  ASSERT_TRUE(view.playing());
  scripts.write("part.evs", "object( file=nowhere_to_be_found.3ds )\n");
  ASSERT_TRUE(view.program().says("the script has errors; the show goes on as it was"));
  std::filesystem::remove(part);
  ASSERT_TRUE(view.program().says("part.evs is gone"));
  ASSERT_TRUE(view.program().says("the script has errors; the show goes on as it was", 2));
  // Frame by frame: a button that goes down and up within one would not be seen.
  ASSERT_TRUE(view.pressed("space", "paused at"));
  view.hands({"mousedown", "1"});
  ASSERT_TRUE(view.pressed("period", "one frame, to "));
  ASSERT_TRUE(view.pressed("period", "one frame, to ", 2));
  view.hands({"mouseup", "1"});
  ASSERT_TRUE(view.pressed("period", "one frame, to ", 3));
  const std::string told = view.end();
  EXPECT_NE(told.find("loaded     part"), std::string::npos) << told << view.program().err();
  EXPECT_EQ(view.program().err().find("stand-in"), std::string::npos) << view.program().err();
}

TEST(ProgramView, AServerThatEndsEndsTheShowWithItsRecordWritten) {
  REQUIRE_DISPLAY(display);
  Viewing view(*display, testShow("desk.evs"), {"--walls", "cave4", "--windows", "walls"});
  ASSERT_TRUE(view.playing());
  display->breakDown();
  EXPECT_EQ(view.program().status(), 3) << view.program().err();
  EXPECT_TRUE(view.program().says("stadion: the connection to the display is lost: "));
  EXPECT_NE(view.program().out().find("state hash"), std::string::npos);
  EXPECT_FALSE(fileContent(view.log()).empty());
}

TEST(ProgramView, ASubSceneThatIsSavedIsReadAgainToo) {
  REQUIRE_DISPLAY(display);
  const TestFolder scripts;
  const std::string corner = fileContent(testShow("desk_corner.evs"));
  scripts.write("desk_corner.evs", corner);
  Viewing view(*display, scripts.write("desk.evs", fileContent(testShow("desk.evs"))));
  ASSERT_TRUE(view.playing());
  scripts.write("desk_corner.evs", corner + "light( name=lamp, position=\"0, 0, 3\" )\n");
  ASSERT_TRUE(view.program().says("reloaded "));
  view.end();
}

/// How many pixels have the colour of the frame budget's letters: within it, or beyond.
std::size_t budgetLetters(const Picture& p) {
  const auto is = [](const std::uint8_t* c, int r, int g, int b) {
    return c[0] == r && c[1] == g && c[2] == b;
  };
  std::size_t count = 0;
  for (std::uint32_t y = 0; y < p.height; ++y)
    for (std::uint32_t x = 0; x < p.width; ++x)
      count += is(p.at(x, y), 120, 230, 120) || is(p.at(x, y), 250, 105, 90) ? 1 : 0;
  return count;
}

TEST(ProgramView, TheFrameBudgetAndTheOverviewAreOnTheScreenshot) {
  REQUIRE_DISPLAY(display);
  Viewing view(*display, testShow("desk.evs"), {"--walls", "desktop", "--look", "full"});
  ASSERT_TRUE(view.playing());
  ASSERT_TRUE(view.pressed("F12", "screenshot:"));
  view.press("F2");
  ASSERT_TRUE(view.pressed("F12", "screenshot:", 2));
  view.press("o");
  ASSERT_TRUE(view.pressed("F12", "screenshot:", 3));
  view.hands({"mousedown", "3", "mousemove_relative", "60", "10", "mouseup", "3", "click", "4"});
  ASSERT_TRUE(view.pressed("F12", "screenshot:", 4));
  view.end();
  EXPECT_EQ(budgetLetters(view.shot(1)), 0u);
  EXPECT_GT(budgetLetters(view.shot(2)), 300u);
  EXPECT_EQ(view.shot(1).width, 400u);
  EXPECT_NE(imageHash(view.shot(3)), imageHash(view.shot(2)));
  EXPECT_TRUE(std::filesystem::exists(view.folder() / "shots" / "001-screen.png"));
}

TEST(ProgramView, WhatTakesTooLongGivesUpAndTheRecordObeys) {
  REQUIRE_DISPLAY(display);
  const TestFolder folder;
  const std::string script = folder.path() / "dear.evs";
  std::ofstream(script)
      << "forcelinear( name=gravity, direction=\"0, 0, -1\" )\n"
         "object( name=ground, file=plane.3ds )\n"
         "dynobject( name=ball, file=football.3ds, position=\"0, 3, 2\", restitution=1, hook=gravity )\n"
         "dynamics( name=game, collider=ground, collidee=ball, budget=0.001, onoverrun=\"half\" )\n";
  Viewing view(*display, script, {"--walls", "desktop", "--hud"});
  ASSERT_TRUE(view.playing());
  ASSERT_TRUE(view.program().says("game"));
  view.program().waitUntil([&] { return view.program().err().find("half") != std::string::npos; });
  ASSERT_TRUE(view.pressed("F12", "screenshot:"));
  const std::string hash = hashIn(view.end());
  const std::string log = fileContent(view.log());
  EXPECT_NE(log.find("\nrelief "), log.npos) << log;
  const ProgramResult replay = stadionProgram({"run", script, "--asset-root", assetFolder(), "--input",
                                               view.log(), "--gl", "none", "--walls", "desktop", "--json"});
  EXPECT_EQ(replay.status, 0) << replay.err;
  EXPECT_NE(replay.out.find(hash), replay.out.npos) << replay.out;
}

TEST(ProgramView, WhyFramesWereLateIsKept) {
  REQUIRE_DISPLAY(display);
  const TestFolder folder;
  const std::string box = folder.path() / "last.frames";
  Viewing viewing(*display, STADION_SOURCE_DIR "/scripts/kick.evs",
                  {"--walls", "desktop", "--look", "full", "--rate", "1000", "--black-box", box});
  ASSERT_TRUE(viewing.playing()) << viewing.program().err();
  ASSERT_TRUE(viewing.pressed("F5", "reloaded"));  // the show after it keeps its frames in the same place
  ASSERT_TRUE(viewing.program().says("playing ", 2));
  const auto told = [&] { return stadionProgram({"profile", "--black-box", box}); };
  viewing.program().waitUntil([&] { return told().out.find("Draw of") != std::string::npos; });
  viewing.end();
  EXPECT_NE(viewing.program().err().find("profile --black-box " + box), std::string::npos)
      << viewing.program().err();
  EXPECT_EQ(told().status, 0) << told().err;
}

TEST(ProgramView, OlympiaShowsItsBudgetAndIsReadAgainWhenSaved) {
  REQUIRE_DISPLAY(display);
  const TestFolder scripts;
  const std::filesystem::path from = std::filesystem::path(assetFolder()) / "../scripts";
  std::filesystem::copy(from / "olympia", scripts.path() / "olympia",
                        std::filesystem::copy_options::recursive);
  const std::string text = fileContent(from / "olympia.evs");
  Viewing view(*display, scripts.write("olympia.evs", text));
  ASSERT_TRUE(view.playing());
  ASSERT_TRUE(view.pressed("F12", "screenshot:"));
  view.press("F2");
  ASSERT_TRUE(view.pressed("F12", "screenshot:", 2));
  scripts.write("olympia.evs",
                text + "object( name=more, file=football.3ds, position=\"0, 3, 1.7\", scale=4 )\n");
  ASSERT_TRUE(view.program().says("reloaded "));
  ASSERT_TRUE(view.program().says("playing ", 2));
  view.press("F2");
  ASSERT_TRUE(view.pressed("F12", "screenshot:", 3));
  view.end();
  EXPECT_EQ(budgetLetters(view.shot(1)), 0u);
  EXPECT_GT(budgetLetters(view.shot(2)), 300u);
  EXPECT_NE(imageHash(view.shot(3)), imageHash(view.shot(1))) << "what was added is seen";
}

TEST(ProgramView, EachWallMayHaveItsWindowAndEyesAreMixed) {
  REQUIRE_DISPLAY(display);
  Viewing view(*display, testShow("desk.evs"),
               {"--walls", "cave4", "--windows", "walls", "--stereo", "anaglyph"});
  ASSERT_TRUE(view.playing());
  ASSERT_TRUE(view.pressed("F12", "screenshot:"));
  view.end();
  for (const char* wall : {"front", "left", "right", "floor"}) {
    for (const char* eye : {"-left", "-right"}) EXPECT_FALSE(view.shot(1, std::string(wall) + eye).empty());
    EXPECT_FALSE(view.shot(1, std::string("window-") + wall).empty());
  }
}

}  // namespace
}  // namespace stadion
