/// Each option means one thing: in all commands, in help, man page, completion and documents.

#include "cli/options/option_table.h"
#include "cli/options/retired_spellings.h"
#include "tests/programs/program.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>

namespace stadion {
namespace {

/// All that have commands, with their names.
std::map<std::string, std::string> programs() {
  std::map<std::string, std::string> paths;
  for (const char* name : {"stadion", "stadion-measure", "stadion-bench"})
    paths[name] = std::filesystem::path(stadionPath()).replace_filename(name);
  return paths;
}

/// An option of a command, as the program itself has it.
struct OptionUse {
  std::string name, command, text;
};

std::vector<OptionUse> allUses() {
  std::vector<OptionUse> uses;
  for (const auto& [name, program] : programs()) {
    std::istringstream lines(runProgram({{program, "manual", "uses"}}).out);
    for (OptionUse use; std::getline(lines, use.name, '\t');) {
      std::string shown;
      std::getline(lines, use.command, '\t'), std::getline(lines, use.text, '\t'), std::getline(lines, shown);
      uses.push_back(use);
    }
  }
  return uses;
}

/// The subcommands that help lists.
std::set<std::string> commandsInHelp(const std::vector<std::string>& words, const std::string& prefix) {
  std::istringstream lines(stadionProgram(words).out);
  std::set<std::string> commands;
  bool listed = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == "Subcommands:") listed = true;
    if (!listed || !line.starts_with("  ") || line[2] == ' ') continue;
    commands.insert(prefix + line.substr(2, line.find(' ', 2) - 2));
  }
  return commands;
}

TEST(ProgramOptionTable, HasEachNameOnceAndNoTextTwice) {
  std::set<std::string_view> names, texts;
  for (const OptionRow& row : optionTable()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_FALSE(row.text.empty()) << row.name;
    const bool hasTwin = row.name == "--walls";  // the argument WALLS
    EXPECT_TRUE(hasTwin || texts.insert(row.text).second) << row.name;
  }
}

TEST(ProgramOptionTable, AnOptionMeansTheSameInEveryCommand) {
  for (const OptionUse& use : allUses()) {
    const OptionRow* row = findOption(use.name);
    ASSERT_TRUE(row) << use.command << " has " << use.name << ", which the table has not";
    if (use.text == row->fullText()) continue;
    EXPECT_FALSE(row->value.words.empty()) << use.command << " " << use.name;
    std::istringstream parts(use.text);  // a command leaves out words that it does not accept
    for (std::string part; std::getline(parts, part, ';');)
      EXPECT_TRUE(has(row->fullText(), part.substr(part.find(": ") == part.npos ? 0 : part.find(": "))))
          << use.command << " " << use.name << ": " << part;
  }
}

TEST(ProgramOptionTable, EveryCommandIsLookedAtAndEveryRowIsUsed) {
  std::set<std::string> commands = commandsInHelp({"--help"}, ""), used, names;
  commands.erase("bench");
  for (const std::string& bench : commandsInHelp({"bench", "--help"}, "bench ")) commands.insert(bench);
  for (const OptionUse& use : allUses()) used.insert(use.command), names.insert(use.name);
  EXPECT_EQ(used, commands);
  EXPECT_GT(commands.size(), 20u);
  for (const OptionRow& row : optionTable()) EXPECT_TRUE(names.contains(std::string(row.name))) << row.name;
}

TEST(ProgramOptionTable, ACommandExplainsOnlyWordsThatItAccepts) {
  const std::string mode = findOption("--mode")->textFor("pipelined|sequential");
  EXPECT_TRUE(has(mode, "pipelined: ") && has(mode, "; sequential: ") && !has(mode, "all: ")) << mode;
  EXPECT_EQ(findOption("--stereo")->textFor("pair|off"),
            "pair: a picture or a buffer for each eye; off: one eye");
  EXPECT_FALSE(has(findOption("--stereo")->textFor("pair|top-bottom"), "interlaced"));
  EXPECT_EQ(findOption("--rate")->textFor(""), findOption("--rate")->fullText());
  for (const char* command : {"run", "view", "hash"})
    EXPECT_FALSE(has(stadionProgram({command, "--help"}).out, "all: both")) << command;
  EXPECT_FALSE(has(stadionProgram({"run", "--help"}).out, "Excludes:"));
  EXPECT_FALSE(has(stadionProgram({"walls", "--help"}).out, "800x800"));
}

TEST(ProgramOptionTable, CommandsTakeTheirOptionsFromIt) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(STADION_SOURCE_DIR "/cli")) {
    if (entry.path().extension() != ".cpp" || entry.path().filename() == "command_options.cpp") continue;
    const std::string code = fileContent(entry.path());
    for (const char* call : {"add_option", "add_flag"})
      EXPECT_FALSE(has(code, call)) << entry.path() << ": " << call;
  }
}

TEST(ProgramOptionTable, ThePageOfOptionsIsWhatTheProgramPrints) {
  EXPECT_EQ(fileContent(STADION_SOURCE_DIR "/docs/options.md"), stadionProgram({"manual", "options"}).out)
      << "update it: ./stadion manual options > docs/options.md";
}

std::string sampleOf(std::string_view value) {
  if (value == "<number>") return "4";
  if (value == "<list>") return "cave4,powerwall";
  if (value == "<word>") return "results.json";
  return value == "<node>" ? "ball" : value.empty() ? "1" : std::string(value);
}

TEST(ProgramRetiredSpellings, AreErrorsThatNameThePresentOne) {
  for (const RetiredSpelling& r : retiredSpellings()) {
    std::istringstream commands{std::string(r.commands)};
    for (std::string command; std::getline(commands, command, '|');) {
      std::vector<std::string> words;
      std::istringstream parts(command);
      for (std::string part; parts >> part;) words.push_back(part);
      words.insert(words.end(), {std::string(r.option), sampleOf(r.value)});
      const ProgramResult result = stadionProgram(words);
      EXPECT_EQ(result.status, 2) << command << " " << r.option;
      EXPECT_TRUE(has(result.err, std::string(r.option)) && has(result.err, std::string(r.now)))
          << command << ": " << result.err;
      EXPECT_EQ(result.out.empty(), r.option != "--json") << result.out;
    }
  }
}

TEST(ProgramRetiredSpellings, NameOptionsThatTheCommandHas) {
  std::set<std::pair<std::string, std::string>> present;
  for (const OptionUse& use : allUses()) present.insert({use.command, use.name});
  for (const RetiredSpelling& r : retiredSpellings()) {
    const std::string command(r.commands.substr(0, r.commands.find('|')));
    const std::string now(r.now.substr(0, r.now.find(' ')));
    EXPECT_TRUE(present.contains({command, now})) << command << " " << now;
    EXPECT_EQ(present.contains({command, std::string(r.option)}), !r.value.empty())
        << command << " " << r.option;
  }
}

TEST(ProgramRetiredSpellings, LeavePresentOnesAlone) {
  const auto finds = [](const std::vector<std::string>& words) {
    return retiredSpellingIn(words).has_value();
  };
  EXPECT_FALSE(finds({"run", "show.evs", "--trace", "events.json", "--track", "ball"}));
  EXPECT_FALSE(finds({"run", "show.evs", "--trace=/dev/null"}));
  EXPECT_FALSE(finds({"bench", "dynamics", "--json", "C05"}));
  EXPECT_FALSE(finds({"plan", "show.evs", "--walls", "cave4"}));
  EXPECT_FALSE(finds({"profile", "show.evs", "--tolerance", "5"}));
  EXPECT_TRUE(finds({"run", "show.evs", "--trace=ball"}));
  for (const char* command : {"run", "cluster", "profile", "merge-traces"}) {
    EXPECT_FALSE(finds({command, "show.evs", "--trace", "out/trace"})) << command;
    EXPECT_FALSE(finds({command, "show.evs", "--trace", "/tmp"})) << command;
    EXPECT_TRUE(finds({command, "show.evs", "--trace", "ball"})) << command;
  }
  EXPECT_TRUE(finds({"bench", "--json", "flight", "x.json"}));
  EXPECT_FALSE(finds({"bench", "--json", "flight"}));
  EXPECT_FALSE(finds({"bench", "dynamics", "--out", "walls", "--only", "C05"}));
}

TEST(ProgramRetiredSpellings, AreFoundBeforeTheNameOfABench) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"bench", "--only", "a", "walls"}, {"bench", "--rounds", "1", "--only", "a", "walls"}}) {
    const auto wrong = retiredSpellingIn(words);
    ASSERT_TRUE(wrong) << words[1];
    EXPECT_TRUE(has(*wrong, "--only is an earlier spelling; the present one is --scenes")) << *wrong;
  }
}

TEST(ProgramManual, SaysWhichWordsItTakes) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"manual", "bash"}, {"manual"}, {"manual", "man", "run"}}) {
    const ProgramResult r = stadionProgram(words);
    EXPECT_EQ(r.status, 2);
    EXPECT_TRUE(has(r.err, "`manual` takes one word: man ")) << r.err;
  }
}

TEST(ProgramManual, GivesNoCommandATextOfTheWholeProgram) {
  for (const auto& [name, program] : programs()) {
    const std::string page = runProgram({{program, "manual", "man"}}).out;
    EXPECT_FALSE(has(page, "Start with:")) << name;
    EXPECT_FALSE(has(page, "\n  ./stadion ")) << name;
    EXPECT_EQ(page.find("141 "), page.rfind("141 ")) << name << ": exit codes are listed twice";
  }
}

TEST(ValueGrammar, AMistakeNamesTheValueAndWhatIsAllowed) {
  const auto mistake = [](const char* option, const char* value) {
    return findOption(option)->value.mistakeIn(value);
  };
  EXPECT_EQ(mistake("--rate", "60Hz"), "\"60Hz\" is not a number from 1 to 1000");
  EXPECT_EQ(mistake("--rate", "nan"), "\"nan\" is not a number from 1 to 1000");
  EXPECT_EQ(mistake("--latency", "1.5"), "\"1.5\" is not a whole number from 1 to 4");
  EXPECT_EQ(mistake("--look", "nice"), "\"nice\" is not full or plain");
  EXPECT_EQ(mistake("--predict", "101"), "\"101\" is not auto or off, nor a number from 0 to 100");
  EXPECT_EQ(mistake("--pictures", "0"),
            "\"0\" is not last, all or none, nor a whole number from 1 to 1000000000");
  EXPECT_EQ(mistake("--window", "12"),
            "\"12\" is not WIDTHxHEIGHT in pixels from 1x1 to 16384x16384, such as 800x600");
  EXPECT_EQ(mistake("--trace-frames", "9..3"), "\"9..3\" is not a range of frames A..B, such as 100..160");
  EXPECT_EQ(mistake("--out", ""), "\"\" is not the name of a folder: it is empty");
  EXPECT_EQ(mistake("--node", ""), "\"\" is not a NAME: it is empty");
}

TEST(ValueGrammar, AllowsWhatItNames) {
  for (const auto& [option, value] :
       std::vector<std::pair<const char*, const char*>>{{"--rate", "60"},
                                                        {"--frames", "1000000000000"},
                                                        {"--predict", "auto"},
                                                        {"--predict", "12.5"},
                                                        {"--pictures", "30"},
                                                        {"--size", "800x600"},
                                                        {"--trace-frames", "3..3"},
                                                        {"--wind", "-5"},
                                                        {"--stereo", "off"}})
    EXPECT_EQ(findOption(option)->value.mistakeIn(value), "") << option;
}

TEST(ProgramCompletion, KnowsCommandsOptionsAndValues) {
  const auto complete = [](std::vector<std::string> words) {
    words.insert(words.begin(), "complete");
    return stadionProgram(words).out;
  };
  EXPECT_EQ(complete({"pr"}), "profile\nprojectors\n");
  EXPECT_EQ(complete({"run", "--trace-"}), "--trace-frames\n--trace-limit\n");
  EXPECT_EQ(complete({"run", "a.evs", "--mode", ""}), "pipelined\nsequential\n");
  EXPECT_EQ(complete({"plan", "--mode", "a"}), "all\n");
  EXPECT_EQ(complete({"run", "--pictures", ""}), "last\nall\nnone\n");
  EXPECT_EQ(complete({"run", "--out", ""}), ":folders\n");
  EXPECT_EQ(complete({"run", "--walls", ""}), ":files\ncave-blended\ncave4\ncave6\ncylinder-180\ncylinder-"
                                              "360\ndesktop\ndome-5\ndome-master\nequirectangular\nirregular-4\npowerwall\n"
                                              "powerwall-2x3\n");
  EXPECT_EQ(complete({"run", "--walls", "cave"}), ":files\ncave-blended\ncave4\ncave6\n");
  EXPECT_EQ(complete({"walls", "d"}), ":files\ndesktop\ndome-5\ndome-master\n");
  EXPECT_TRUE(has(complete({"doctor", "--for", ""}), "\nsound\n"));
  EXPECT_EQ(complete({"doctor", "--for", "clu"}), ":files\ncluster\n");
  EXPECT_EQ(complete({"run", "--pace="}), "free\nlock\nfloat\n");
  EXPECT_EQ(complete({"run", "--pace=f"}), "free\nfloat\n");
  EXPECT_EQ(complete({"run", "--pace", "=", "f"}), "free\nfloat\n") << "as bash splits it";
  EXPECT_EQ(complete({"run", "--pace", "="}), "free\nlock\nfloat\n");
  EXPECT_EQ(complete({"run", "--out="}), ":folders\n");
  EXPECT_EQ(complete({"run", ""}), ":files\n");
  EXPECT_EQ(complete({"bench", "wa"}), "walls\n");
  EXPECT_EQ(complete({"bench", "walls", "--scene-"}), "--scene-nodes\n");
  EXPECT_EQ(complete({"run", "--ends-"}), "") << "an internal option";
  EXPECT_EQ(complete({"nodes", "dyno"}), "dynobject\n");
}

TEST(ProgramManPage, HasEachOptionOnce) {
  for (const auto& [name, program] : programs()) {
    const std::string page = runProgram({{program, "manual", "man"}}).out;
    EXPECT_TRUE(page.starts_with(".TH " + name + " 1")) << page.substr(0, 40);
    const std::string entry = "\n.TP\n.B \\-\\-json\n";
    ASSERT_NE(page.find(entry), std::string::npos);
    EXPECT_EQ(page.find(entry), page.rfind(entry));
    const std::string status = page.substr(page.find(".SH EXIT STATUS"));
    EXPECT_TRUE(has(status, "5 with") && !has(status, "Start with")) << status;
  }
  EXPECT_TRUE(has(stadionProgram({"--help"}).out, "5 with --guard"));
}

TEST(ProgramOptions, AFlagTakesNoValue) {
  for (const char* flag : {"--json=x", "--guard=off", "--json=true"}) {
    const ProgramResult r = stadionProgram({"run", "show.evs", flag});
    EXPECT_EQ(r.status, 2) << flag;
    EXPECT_TRUE(has(r.err, "takes no value")) << r.err;
  }
}

TEST(ProgramOptions, AWrongValueNamesOptionValueAndWhatIsAllowed) {
  const ProgramResult r = stadionProgram({"walls", "cave4", "--pattern", "--size", "12x12"});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "--size: \"12x12\" is not WIDTHxHEIGHT in pixels from 16x16 to 16384x16384"))
      << r.err;
}

}  // namespace
}  // namespace stadion
