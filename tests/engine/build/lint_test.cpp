#include "engine/build/lint.h"
#include "engine/script/script.h"
#include "tests/node_types.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace stadion {
namespace {

std::vector<std::string> warningsOf(std::string_view text, bool alone = true) {
  Diagnostics findings;
  const Document document = checkScript(std::move(SourceText::make("a.evs", text).value()), testTypes(), findings);
  for (const Diagnostic& d : findings.all()) ADD_FAILURE() << format(d);
  Diagnostics warnings;
  lint(document, alone, warnings);
  std::vector<std::string> messages;
  for (const Diagnostic& d : warnings.all()) {
    EXPECT_EQ(d.severity, Severity::Warning);
    messages.push_back(d.message);
  }
  return messages;
}

using Messages = std::vector<std::string>;

TEST(ScriptLint, AFieldThatNothingHooksIsNamed) {
  const std::string_view wind = "forcelinear(name=wind, direction=\"1 0 0\")";
  EXPECT_EQ(warningsOf(wind), Messages{"the forcelinear \"wind\" is never hooked to a body"});
  EXPECT_TRUE(warningsOf(wind, false).empty());  // another file may hook it
}

TEST(ScriptLint, ATrackerOfAFieldNeedsAnAxis) {
  const std::string body = "dynobject(name=b, file=b.obj, hook=push) dynamics(collidee=b)\n";
  const std::string push = "forcelinear(name=push, direction=\"1 0 0\", tracker=left";
  EXPECT_EQ(warningsOf(body + push + ")"), Messages{"the tracker has no effect without strengthaxis"});
  EXPECT_TRUE(warningsOf(body + push + ", strengthaxis=7)").empty());
}

TEST(ScriptLint, AFieldHookedByMessageIsUsed) {
  EXPECT_TRUE(warningsOf("forcelinear(name=wind, direction=\"1 0 0\") dynobject(name=b, file=b.obj)\n"
                         "dynamics(collidee=b) timer(period=1, eventmessage=\"timesup, b, hook wind\")")
                  .empty());
}

TEST(ScriptLint, ABodyInNoDynamicsNodeIsNamed) {
  EXPECT_EQ(warningsOf("dynobject(name=b, file=b.obj)").size(), 1U);
}

TEST(ScriptLint, ATriggerOrTimerWithoutMessageHasNoEffect) {
  EXPECT_EQ(warningsOf("usertrigger(sphere=\"0 0 0 1\")"),
            Messages{"this usertrigger has no eventmessage and so no effect"});
  EXPECT_EQ(warningsOf("timer(period=1)").size(), 1U);
}

TEST(ScriptLint, WhatIsOffAndNeverEnabledIsNamed) {
  const std::string lamp = "light(name=lamp, initstate=off)\n";
  EXPECT_EQ(warningsOf(lamp), Messages{"the light \"lamp\" is off at the start and nothing enables it"});
  EXPECT_TRUE(warningsOf(lamp + "timer(period=1, eventmessage=\"timesup, lamp, toggle\")").empty());
}

TEST(ScriptLint, AttributesWithoutEffectAreNamed) {
  EXPECT_EQ(warningsOf("light(intensity=0)").size(), 1U);
  EXPECT_EQ(warningsOf("light(type=point, direction=\"0 0 1\", angle=20, range=3)").size(), 2U);
  EXPECT_EQ(warningsOf("dynobject(name=b, file=b.obj, mass=2, density=3) dynamics(collidee=b)").size(), 1U);
}

TEST(ScriptLint, MoreLightsThanShineAreTold) {
  std::string text;
  for (int i = 0; i < 16; ++i) text += "light( position=\"0,0,3\" )\n";
  EXPECT_TRUE(warningsOf(text).empty());
  text += "light( name=off, initstate=off )\n";
  text += "timer( period=1, eventmessage=\"timesup, off, enable\" )\n";
  EXPECT_TRUE(warningsOf(text).empty());
  text += "light()\nlight()\n";
  const auto warnings = warningsOf(text);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("18 lights are on at the start, but only 16"), std::string::npos) << warnings[0];
}

TEST(ScriptLint, ALatencyShorterThanAFrameIsTold) {
  const auto warningsAt = [](double rate) {
    Diagnostics findings, warnings;
    const std::string_view text = "light(name=lamp)\n"
                                  "timer(period=1, eventmessage=\"timesup, lamp, hide, latency=0.02\",\n"
                                  "  eventmessage=\"timesup, lamp, show, 0.02, latency=0.02\")";
    const Document document = checkScript(std::move(SourceText::make("a.evs", text).value()), testTypes(), findings);
    EXPECT_FALSE(findings.hasErrors());
    lintLatencies(document, fromSeconds(1 / rate), warnings);
    std::string all;
    for (const Diagnostic& d : warnings.all()) all += fmt::format("{}: {}\n", d.where.line, d.message);
    return all;
  };
  EXPECT_EQ(warningsAt(60), "");
  EXPECT_EQ(warningsAt(50), "");
  EXPECT_EQ(warningsAt(30),
            "2: the latency of 0.02 s is shorter than a frame (0.0333 s at 30 Hz), so that the "
            "command waits for the next frame; state 0.034 or more\n");
  EXPECT_EQ(warningsAt(20),
            "2: the latency of 0.02 s is shorter than a frame (0.0500 s at 20 Hz), so that the "
            "command waits for the next frame; state 0.050 or more; so are 1 more in this file\n")
      << "once a file";
}

TEST(ScriptLint, ATrackerThatNoDeviceIsCalledIsNamed) {
  const auto warned = [](std::vector<std::string> known, const std::string& log) {
    Diagnostics findings, warnings;
    const std::string_view text = "forcelinear(name=f, direction=\"0 0 -1\", strengthaxis=1, tracker=wnd)\n"
                                  "dynobject(name=ball, file=b.obj, hook=f)\n"
                                  "timer(period=1, eventmessage=\"timesup, ball, grab nosuch\", "
                                  "eventmessage=\"timesup, ball, grab foot\")\n"
                                  "dynamics(collidee=ball)";
    const Document document = checkScript(std::move(SourceText::make("a.evs", text).value()), testTypes(), findings);
    EXPECT_FALSE(findings.hasErrors());
    lintTrackers(document, known, log, warnings);
    std::string all;
    for (const Diagnostic& d : warnings.all()) all += fmt::format("{}: {}\n", d.where.line, d.message);
    return all;
  };
  EXPECT_EQ(warned({"wand", "head"}, "a.input"),
            "1: no device is called \"wnd\": a.input has wand, head; did you mean \"wand\"?\n"
            "3: no device is called \"nosuch\": a.input has wand, head\n");
  EXPECT_EQ(warned({"wand", "nosuch", "wnd"}, "a.input"), "");
  EXPECT_EQ(warned({}, ""), "1: \"wnd\" is no usual name of a device; did you mean \"wand\"?\n")
      << "without a log any other name may be right";
}

TEST(ScriptLint, AFormatThatIsNotReadIsNamed) {
  EXPECT_EQ(warningsOf("object(file=models/Ball.blend)").size(), 1U);
  EXPECT_TRUE(warningsOf("object(file=models/Ball.OBJ)").empty());
  EXPECT_EQ(warningsOf("scene(file=arena.txt)").size(), 1U);
}

TEST(ScriptLint, ContactNodesAreLookedAt) {
  EXPECT_EQ(warningsOf("dynamics()"), Messages{"this dynamics has no collidee and so no effect"});
  EXPECT_EQ(warningsOf("object(name=a, file=a.obj) object(name=b, file=a.obj)\n"
                       "collision(collider=a, collider=a, collidee=b)"),
            Messages{"collider \"a\" is given twice"});
}

TEST(ScriptLint, APathOnABodyIsNamed) {
  const std::string path = "dynobject(name=b, file=b.obj) path(target=b, key=\"0 0 0 0\", key=\"1 0 0 1\")\n";
  EXPECT_EQ(warningsOf(path + "dynamics(collidee=b)"),
            Messages{"\"b\" is moved by a dynamics node, never by this path; make it an object"});
}

TEST(ScriptLint, APathThatMovesNothingIsNamed) {
  EXPECT_EQ(warningsOf("path(name=p, key=\"0, 0 0 0\")").size(), 1U);
  EXPECT_TRUE(warningsOf("path(name=p, key=\"0, 0 0 0\") group(parent=p)").empty());
}

TEST(ScriptLint, APathThatIsToTurnFartherThanItCanBetweenTwoKeysIsNamed) {
  const auto turning = [](const char* to) {
    return warningsOf(
        fmt::format("path(name=p, key=\"0, 0 0 0\", key=\"2, 0 0 0, 0 0 {}\") group(parent=p)", to));
  };
  EXPECT_TRUE(turning("170").empty());
  ASSERT_EQ(turning("360").size(), 1U);
  EXPECT_NE(turning("360").front().find("360 degrees"), std::string::npos);
}

TEST(ScriptLint, CharactersThatTheFontLacksAreNamed) {
  EXPECT_EQ(warningsOf("text(name=board, text=\"Ж 3.5 m\")\n"
                       "timer(period=1, eventmessage=\"timesup, board, say Wien, 2\")"),
            Messages{"the letters of the show have no U+0416; a box stands for it"});
  EXPECT_EQ(warningsOf("text(name=board) timer(period=1, eventmessage=\"timesup, board, say ☺\")"),
            Messages{"the letters of the show have no U+263A; a box stands for it"});
}

TEST(ScriptLint, OnlyADirectionalLightCastsShadows) {
  EXPECT_EQ(warningsOf("light(type=point, shadows=on)"),
            Messages{"shadows has no effect: only a directional light casts them"});
  EXPECT_TRUE(warningsOf("light(shadows=off)").empty());
}

}  // namespace
}  // namespace stadion
