/// What all files with one statement a line have in common: their grammar and their messages.

#include "engine/plain_text/statement_reader.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

/// Reads lines such as "hold 0.5", "unit cm" and "lamp NAME [at X] [off]".
class LampParser {
public:
  LampParser(std::string_view text, Diagnostics& out) : in_(text, "a.lamps", out) {}

  bool run() {
    if (!in_.heading("a lamp file", "stadion-lamps", 2)) return false;
    while (in_.next()) in_.read(*this, kStatements);
    return !in_.failed();
  }

  double hold_ = 0, metres_ = 1, at_ = 0;
  bool off_ = false;
  std::string name_;

private:
  static const Statement<LampParser> kStatements[4];
  static const StatementField<LampParser> kFields[2];

  void hold() {
    const auto seconds = in_.number("the time to hold", 0, 60, " s");
    if (seconds && in_.finished()) hold_ = *seconds;
  }
  void unit() {
    const auto unit = lengthUnit(in_);
    if (unit && in_.finished()) metres_ = unit->metres;
  }
  void section() { in_.beginSection(); }
  void lamp() {
    const auto name = in_.name("the lamp's name", "a lamp");
    if (name && in_.fields(*this, kFields, "a lamp")) name_ = *name;
  }
  bool at() {
    const auto x = in_.whole("the place", -9, 9);
    if (x) at_ = static_cast<double>(*x);
    return x.has_value();
  }
  bool off() { return off_ = true; }

  StatementReader in_;
};

constexpr Statement<LampParser> LampParser::kStatements[4] = {{"hold", &LampParser::hold},
                                                              {"unit", &LampParser::unit},
                                                              {"section", &LampParser::section, true},
                                                              {"lamp", &LampParser::lamp, true}};
constexpr StatementField<LampParser> LampParser::kFields[2] = {{"at", &LampParser::at},
                                                               {"off", &LampParser::off}};

/// "LINE:COLUMN: MESSAGE" of the first error.
std::string firstError(const std::string& text) {
  Diagnostics out;
  EXPECT_FALSE(LampParser(text, out).run()) << text;
  if (out.all().empty()) return "no error";
  const Diagnostic& d = out.all()[0];
  return std::to_string(d.where.line) + ":" + std::to_string(d.where.column) + ": " + d.message;
}

TEST(StatementReader, ReadsStatementsAndFieldsInAnyOrder) {
  Diagnostics out;
  LampParser parser(
      "stadion-lamps 2  # of the hall\nlamp left  off  at -3\nunit cm\nhold 0.5\nsection\nhold 2\n", out);
  ASSERT_TRUE(parser.run()) << format(out.all().at(0));
  EXPECT_EQ(parser.name_, "left");
  EXPECT_EQ(parser.at_, -3);
  EXPECT_TRUE(parser.off_);
  EXPECT_EQ(parser.metres_, 0.01);
  EXPECT_EQ(parser.hold_, 2) << "each section may give it once";
}

TEST(StatementReader, SaysWhatIsWrongWithTheHeading) {
  EXPECT_EQ(firstError(""), "1:1: the file is empty; a lamp file begins with the line: stadion-lamps 1");
  EXPECT_EQ(firstError("stadion-rig 1\n"),
            "1:1: this is not a lamp file; one begins with the line: stadion-lamps 1");
  EXPECT_EQ(firstError("stadion-lamps\n"), "1:14: the version of the format is missing");
  EXPECT_EQ(firstError("stadion-lamps 3\n"),
            "1:15: version 3 of the format is newer than this program, which reads 2");
  EXPECT_EQ(firstError("stadion-lamps 1 2\n"), "1:17: \"2\" is one word too many here");
}

TEST(StatementReader, SaysWhatIsWrongWithAStatement) {
  const std::string h = "stadion-lamps 1\n";
  EXPECT_EQ(firstError(h + "holt 1\n"), "2:1: \"holt\" does not begin a statement; did you mean \"hold\"?");
  EXPECT_EQ(firstError(h + "x\n"),
            "2:1: \"x\" does not begin a statement; known are hold, unit, section, lamp");
  EXPECT_EQ(firstError(h + "hold 1\nhold 2\n"), "3:1: \"hold\" is given twice; keep one of them");
  EXPECT_EQ(firstError(h + "hold\n"), "2:5: the time to hold is missing");
  EXPECT_EQ(firstError(h + "hold 61\n"), "2:6: the time to hold must be from 0 s to 60 s, not 61 s");
  EXPECT_EQ(firstError(h + "hold x\n"), "2:6: \"x\" is not a number (the time to hold)");
  EXPECT_EQ(firstError(h + "hold 1 2\n"), "2:8: \"2\" is one word too many here");
  EXPECT_EQ(firstError(h + "unit\n"), "2:5: a unit (m, cm, mm, in, ft) is missing");
  EXPECT_EQ(firstError(h + "unit yard\n"), "2:6: \"yard\" is not a unit; known are m, cm, mm, in, ft");
}

TEST(StatementReader, SaysWhatIsWrongWithAField) {
  const std::string h = "stadion-lamps 1\n";
  EXPECT_EQ(firstError(h + "lamp a  fo\n"), "2:9: \"fo\" is not a field of a lamp; known are at, off");
  EXPECT_EQ(firstError(h + "lamp a  off off\n"),
            "2:13: \"off\" is given twice for this lamp; keep one of them");
  EXPECT_EQ(firstError(h + "lamp a  at\n"), "2:11: the place is missing");
  EXPECT_EQ(firstError(h + "lamp a  at 0.5\n"), "2:12: the place must be a whole number, not 0.5");
}

}  // namespace
}  // namespace stadion
