/// A short soak, and one that is taken up again.

#include "tests/programs/desk.h"

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

namespace stadion {
namespace {

bool holds(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

TEST(ProgramSoak, SomeThousandFramesAreTheSameInEveryWayAndInEveryProcess) {
  const TestFolder folder;
  const std::string record = folder.path() / "soak.record";
  const ProgramResult first =
      stadionProgram({"soak", "--frames", "3000", "--visit", "1000", "--no-memory", "--record", record});
  EXPECT_EQ(first.status, 0) << first.out << first.err;
  EXPECT_TRUE(holds(first.out, "3000 frames in 3 visits by 1 processes")) << first.out;
  EXPECT_TRUE(holds(first.out, "states: 0 of 4 histories compared differ")) << first.out;
  EXPECT_TRUE(holds(first.out, "time steps: 0 of 3000")) << first.out;
  EXPECT_TRUE(holds(first.out, " 1 walls' processes killed")) << first.out;
  EXPECT_FALSE(holds(first.out, " 0 throws")) << first.out;
  EXPECT_FALSE(holds(first.out, " 0 measurements refused")) << first.out;
  std::ofstream(record, std::ios::app) << "{\"sample\": [0, 12";  // as a killed run leaves it
  const ProgramResult more =
      stadionProgram({"soak", "--frames", "5000", "--visit", "1000", "--no-memory", "--record", record});
  EXPECT_EQ(more.status, 0) << more.out << more.err;
  EXPECT_TRUE(holds(more.out, "by 2 processes")) << more.out;
  EXPECT_TRUE(holds(more.out, "states: 0 of ")) << more.out;
}

TEST(ProgramSoak, ThatIsFinishedIsNotPlayedAgainAndHasTheSameVerdict) {
  const TestFolder folder;
  const std::string record = folder.path() / "soak.record";
  // Ends in a visit without samples.
  const std::vector<std::string> words{"soak", "--frames",    "2500",     "--visit",
                                       "1000", "--no-memory", "--record", record};
  const ProgramResult first = stadionProgram(words);
  ASSERT_EQ(first.status, 0) << first.out << first.err;
  const std::string kept = fileContent(record);
  const ProgramResult again = stadionProgram(words);
  EXPECT_EQ(again.status, 0) << again.out << again.err;
  EXPECT_EQ(again.out, first.out);
  EXPECT_TRUE(holds(again.err, "soak: it is finished")) << again.err;
  EXPECT_EQ(fileContent(record), kept + "\n");
}

std::vector<std::string> shortSoak(const std::string& record, const char* frames) {
  return {"soak", "--frames", frames, "--visit", "1000", "--no-memory", "--record", record};
}

/// More samples might hide what has grown.
TEST(ProgramSoak, WhatHasFailedOnceHasFailed) {
  const TestFolder folder;
  const std::string record = folder.path() / "soak.record";
  const auto words = [&](const char* frames) { return shortSoak(record, frames); };
  ASSERT_EQ(stadionProgram(words("1000")).status, 0);
  std::string text = fileContent(record);
  const std::size_t at = text.find("\"failed\":[");
  ASSERT_NE(at, std::string::npos) << text;
  folder.write("soak.record", text.insert(text.find('[', at) + 1, "\"threads: +1 of 9\""));
  for (const char* frames : {"1000", "1100"}) {
    const ProgramResult r = stadionProgram(words(frames));
    EXPECT_EQ(r.status, 1) << r.out << r.err;
    EXPECT_TRUE(holds(r.out, "FAILED before: threads: +1 of 9")) << r.out;
  }
}

TEST(ProgramSoak, MemoryThatCouldNotBeJudgedIsNoPass) {
  const ProgramResult r = stadionProgram({"soak", "--frames", "1000", "--visit", "1000"});
  EXPECT_EQ(r.status, 1) << r.out << r.err;
  EXPECT_TRUE(holds(r.out, "FAILED memory was not judged")) << r.out;
  EXPECT_TRUE(holds(r.out, "time steps: 0 of 1000")) << r.out;
}

TEST(ProgramSoak, ARecordOfAnotherSoakIsRefusedAndLeftAlone) {
  const TestFolder folder;
  const std::string record = folder.write("notes.txt", "not a record\n");
  const ProgramResult r = stadionProgram({"soak", "--frames", "1000", "--no-memory", "--record", record});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(holds(r.err, "is no record of this soak")) << r.err;
  EXPECT_EQ(fileContent(record), "not a record\n");
}

TEST(ProgramSoak, AStateThatIsNotThatOfBeforeFails) {
  const TestFolder folder;
  const std::string record = folder.path() / "soak.record";
  ASSERT_EQ(stadionProgram({"soak", "--frames", "1000", "--visit", "1000", "--no-memory", "--record", record})
                .status,
            0);
  std::string text = fileContent(record);
  const std::size_t at = text.find("\"history\":");
  ASSERT_NE(at, std::string::npos);
  text.insert(text.find_first_of("0123456789", at), "1");
  folder.write("soak.record", text.substr(0, text.find('\n', at) + 1));
  const ProgramResult r =
      stadionProgram({"soak", "--frames", "1000", "--visit", "1000", "--no-memory", "--record", record});
  EXPECT_EQ(r.status, 1) << r.out << r.err;
  EXPECT_TRUE(holds(r.err, "has another history of states than before")) << r.err;
  const ProgramResult more =
      stadionProgram({"soak", "--frames", "1200", "--visit", "1000", "--no-memory", "--record", record});
  EXPECT_EQ(more.status, 1) << "it has failed: " << more.out << more.err;
}

TEST(ProgramSoak, AStateThatIsNotThatOfBeforeIsNotForgottenWhenTheSoakIsKilled) {
  const TestFolder folder;
  const std::string record = folder.path() / "soak.record";
  const auto words = [&](const char* frames) { return shortSoak(record, frames); };
  ASSERT_EQ(stadionProgram(words("1000")).status, 0);
  std::string text = fileContent(record);
  // That of frame 500: no sample is taken soon after it.
  const std::size_t history = text.find("\"history\":", text.find("\"frame\":500"));
  ASSERT_NE(history, std::string::npos) << text;
  text.insert(history + 10, "1");
  folder.write("soak.record", text.substr(0, text.find('\n', history) + 1));
  {
    auto all = words("1000000000");
    all.insert(all.begin(), stadionPath());
    RunningProgram soak({all});
    ASSERT_TRUE(soak.says("has another history of states than before"));
    soak.kill();
    soak.status();
  }
  // Nothing it compared before it was killed shows it any more.
  text = fileContent(record);
  text.erase(history + 10, 1);
  folder.write("soak.record", text);
  const ProgramResult r = stadionProgram(words("1200"));
  EXPECT_EQ(r.status, 1) << r.out << r.err;
  EXPECT_FALSE(holds(r.out, "FAILED states: 0")) << r.out;
}

/// A record of a soak of some frames, and soaks that go on with it.
class ProgramSoakRecord : public testing::Test {
protected:
  static std::vector<std::string> words(const std::string& record, const std::string& frames = "1000") {
    return {"soak", "--frames", frames, "--visit", "1000", "--no-memory", "--record", record};
  }
  void SetUp() override {
    ASSERT_EQ(stadionProgram(words(record_)).status, 0);
    whole_ = fileContent(record_);
    head_ = whole_.substr(0, whole_.find('\n') + 1);
  }
  /// That first history with another figure.
  std::string withAnotherState() const {
    std::string text = whole_;
    const std::size_t at = text.find("\"history\":");
    text.insert(text.find_first_of("0123456789", at), "1");
    return text.substr(0, text.find('\n', at) + 1);
  }
  ProgramResult soakWith(const std::string& text, const std::string& frames = "1000") const {
    return stadionProgram(words(folder_.write("soak.record", text), frames));
  }

  TestFolder folder_;
  std::string record_ = folder_.path() / "soak.record";
  std::string whole_, head_;
};

TEST_F(ProgramSoakRecord, WhoseFirstLineIsOfSomethingElseIsRefused) {
  for (const char* line : {R"({"stadion-soak":2,"what":5})", R"({"stadion-soak":"x"})",
                           R"({"stadion-soak":2})", R"({"what":{}})", "[]", "2", "null", "\"x\""}) {
    const ProgramResult r = soakWith(std::string(line) + "\n" + whole_.substr(head_.size()));
    EXPECT_EQ(r.status, 2) << line << r.err;
    EXPECT_TRUE(holds(r.err, "soak.record: error: is no record of this soak")) << line << r.err;
  }
}

TEST_F(ProgramSoakRecord, InWhichALineIsWrongIsRefusedWithThatLineAndLeftAlone) {
  const std::string well = R"({"counts":[51,0,1,0,0,0,0,0,0,0.5],"sample":[0,0,51,9,9,9,9]})";
  const auto counts = [](const std::string& text) {
    return R"({"sample":[0,0,51,9,9,9,9],"counts":)" + text + "}";
  };
  const auto sample = [](const std::string& text) {
    return R"({"counts":[51,0,1,0,0,0,0,0,0,0.5],"sample":)" + text + "}";
  };
  for (const std::string& line : {
           counts("[-1,0,1,0,0,0,0,0,0,0.5]"),
           counts("[51,0,1,0,-2,0,0,0,0,0.5]"),
           counts("[51,0,1,0,0,0,0,0,0,-0.5]"),
           counts("[51,0,1,0,0,0,0,0,0,\"0.5\"]"),
           counts("[51,0,1.5,0,0,0,0,0,0,0.5]"),
           counts("[51,0,1,0,0,0,0,0,0]"),
           counts("[52,0,1,0,0,0,0,0,0,0.5]"),
           counts("[51,0,18446744073709551615,0,0,0,0,0,0,0.5]"),
           counts("{}"),
           sample("[0,0,51,9,9,9]"),
           sample("[0,0,51,9,9,9,null]"),
           sample("[0,0,51,-9,9,9,9]"),
           sample("[7,0,51,9,9,9,9]"),
           sample("[0,1,51,9,9,9,9]"),
           sample("5"),
           std::string(R"({"sample":[0,0,51,9,9,9,9]})"),
           std::string(R"({"counts":[41,0,1,0,0,0,0,0,0,0.5],"sample":[0,0,41,9,9,9,9]})"),
           std::string(R"({"counts":[51,0,1,0,0,0,0,0,0,0.5]})"),
           std::string(R"({"counts":[51,0,1],"process":0})"),
           std::string(R"({"counts":[51,0,1,0,0,0,0,0,0,0.5],"process":2})"),
           std::string(R"({"counts":[41,0,1,0,0,0,0,0,0,0.5],"process":0})"),
           std::string(R"({"counts":[51,0,1,0,0,0,0,0,0,0.5],"process":0,"failed":5})"),
           std::string(R"({"counts":[51,0,1,0,0,0,0,0,0,0.5],"process":0,"failed":[5]})"),
           std::string(R"({"counts":[51,0,1,0,0,0,0,0,0,0.5],"process":0,"failed":[ "thr"eads"]})"),
           std::string(R"({"show":"a.evs","frame":-1,"history":5})"),
           std::string(R"({"show":"a.evs","frame":1,"history":0.5})"),
           std::string(R"({"show":7,"frame":1,"history":5})"),
           std::string(R"({"show":"a.evs","frame":1})"),
           std::string("{}"),
           std::string("[1]"),
           std::string("5"),
       }) {
    const std::string text = head_ + well + "\n" + line + "\n" + well + "\n";
    const ProgramResult r = soakWith(text);
    EXPECT_EQ(r.status, 2) << line << r.out << r.err;
    EXPECT_TRUE(holds(r.err, "soak.record:3: error: ")) << line << r.err;
    EXPECT_TRUE(holds(r.err, "is no record of this soak")) << line << r.err;
    EXPECT_EQ(fileContent(record_), text);
  }
}

TEST_F(ProgramSoakRecord, WithLinesThatKilledRunsHaveLeftHalfIsOne) {
  const std::string half = R"({"counts":[51,0,1,0,0,)";
  const ProgramResult r = soakWith(head_ + half + "\n\n" + whole_.substr(head_.size()) + half, "2000");
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(holds(r.out, "by 2 processes")) << r.out;
  EXPECT_FALSE(holds(r.out, "states: 0 of 0")) << r.out;
}

TEST_F(ProgramSoakRecord, OfAShowWhoseNameIsNoTextIsRefused) {
  std::vector<std::string> all = words(record_);
  all.push_back(folder_.write("a\xff.evs", "object( file=ball.3ds )\n"));
  const ProgramResult r = stadionProgram(all);
  EXPECT_EQ(r.status, 2) << r.err;
  EXPECT_TRUE(holds(r.err, "a name that is not UTF-8")) << r.err;
  EXPECT_EQ(fileContent(record_), whole_);
}

TEST_F(ProgramSoakRecord, IsThatOfOneProcessAtATime) {
  RunningProgram first({[&] {
    auto all = words(record_, "1000000000");
    all.insert(all.begin(), stadionPath());
    return all;
  }()});
  ASSERT_TRUE(first.says("soak: "));
  const ProgramResult second = stadionProgram(words(record_));
  EXPECT_EQ(second.status, 2) << second.out << second.err;
  EXPECT_TRUE(holds(second.err, "soak.record: another process is writing it")) << second.err;
  ::kill(-first.pid(), SIGINT);
  EXPECT_EQ(first.status(), 130) << first.err();
}

TEST_F(ProgramSoakRecord, OfAStateThatDiffersFailsAlsoWhenTheSoakIsStopped) {
  folder_.write("soak.record", withAnotherState());
  RunningProgram soak({[&] {
    auto all = words(record_, "1000000000");
    all.insert(all.begin(), stadionPath());
    return all;
  }()});
  ASSERT_TRUE(soak.says("has another history of states than before"));
  ::kill(-soak.pid(), SIGTERM);
  EXPECT_EQ(soak.status(), 1) << soak.out();
  EXPECT_TRUE(holds(soak.out(), "FAILED states: ")) << soak.out();
}

TEST(ProgramSoak, ThatIsStoppedBeforeMemoryCouldBeJudgedHasNotFailed) {
  RunningProgram soak({{stadionPath(), "soak", "--frames", "1000000000", "--visit", "1000"}});
  ASSERT_TRUE(soak.says("soak: "));
  ::kill(-soak.pid(), SIGINT);
  EXPECT_EQ(soak.status(), 130) << soak.out();
  EXPECT_FALSE(holds(soak.out(), "FAILED")) << soak.out();
  EXPECT_TRUE(holds(soak.out(), "memory was not judged: the soak was stopped")) << soak.out();
}

}  // namespace
}  // namespace stadion
