/// What a show plays, and what is watched, while somebody saves its scripts.

#include "show/player/script_watch.h"
#include "tests/programs/program.h"
#include "tests/show/player/played_show.h"

#include <filesystem>
#include <gtest/gtest.h>

namespace stadion {
namespace {

namespace fs = std::filesystem;

constexpr const char* kShow = "scene( name=part, file=part.evs, initstate=off, ready=0 )\n"
                              "timer( period=0.1, eventmessage=\"timesup, part, load\" )\n";

TEST(ShowTexts, ASubSceneIsLoadedAsItWasWhenTheShowWasOpenedWhateverBecomesOfItsFile) {
  for (const char* later : {"dynobj(", ""}) {
    const TestFolder folder;
    const std::string part = folder.write("part.evs", "timer( name=inside, period=1 )\n");
    const auto player = openShow(folder.write("show.evs", kShow));
    ASSERT_TRUE(player);
    *later ? static_cast<void>(folder.write("part.evs", later)) : static_cast<void>(fs::remove(part));
    bool loaded = false;
    ShowParts parts = player->parts(StereoLayout::Pair);
    parts.observer = [&](const TimeSignature&, const InputSample&, const Scene& scene) {
      for (const EventRecord& e : scene.events()) loaded |= e.event == Event("loaded");
    };
    ShowStages stages(std::move(parts));
    EXPECT_FALSE(play(stages, Mode::Sequential, 1, 30).failure);
    EXPECT_TRUE(loaded) << "part.evs with \"" << later << '"';
    EXPECT_TRUE(player->scene().find(player->scene().tree().resolve("part/inside", {1, 0})));
  }
}

TEST(ShowTexts, ArePartsOfPartsToo) {
  const TestFolder folder;
  folder.write("b.evs", "timer( name=b, period=1 )\n");
  folder.write("a.evs", "scene( file=b.evs )\nscene( file=missing.evs )\n");
  const std::string show = folder.write("show.evs", "scene( file=a.evs )\n");
  const auto texts = ScriptTexts::read(show, AssetRoots::ofScript(show), *standardNodes());
  EXPECT_EQ(texts->parts(), (std::vector<std::string>{"a.evs", "b.evs", "missing.evs"}));
  EXPECT_TRUE(texts->part("b.evs"));
  ASSERT_FALSE(texts->part("missing.evs"));
  EXPECT_NE(texts->part("missing.evs").error().message.find("missing.evs"), std::string::npos);
}

TEST(ShowTexts, OfLargePartsAreReadAgainAndMustBeWhatTheyWere) {
  const TestFolder folder;
  const std::string large(std::size_t{1} << 20, '#'), name = "large.evs";
  folder.write(name, "timer( name=b, period=1 )\n" + large);
  folder.write("small.evs", "timer( name=b, period=1 )\n");
  const std::string show = folder.write("show.evs", "scene( file=large.evs )\nscene( file=small.evs )\n");
  const AssetRoots roots = AssetRoots::ofScript(show);
  const auto rest = ScriptTexts::read(show, roots, *standardNodes())->without(name)->without("small.evs");
  EXPECT_TRUE(rest->part("small.evs"));
  EXPECT_FALSE(rest->part(name)) << "it is not kept";
  ASSERT_TRUE(rest->part(name, roots));
  EXPECT_EQ(rest->part(name, roots).value().text().substr(26), large);
  folder.write(name, "timer( name=b, period=2 )\n" + large);
  folder.write("small.evs", "timer( name=b, period=2 )\n");
  ASSERT_FALSE(rest->part(name, roots));
  EXPECT_NE(rest->part(name, roots).error().message.find("has changed"), std::string::npos);
  EXPECT_NE(rest->part("small.evs", roots).value().text().find("period=1"), std::string::npos);
}

/// How often it must be asked until it says something; 0: it says nothing in ten times.
int asked(ScriptWatch& watch, std::string& said) {
  for (int n = 1; n <= 10; ++n)
    if (const auto what = watch.changed()) return said = *what, n;
  return 0;
}

/// Expects that the watch tells once that the file was saved.
void expectToldOnce(ScriptWatch& watch, const std::string& file) {
  std::string said;
  EXPECT_EQ(asked(watch, said), 2);
  EXPECT_EQ(said, file + " was saved");
  watch.reset();
  EXPECT_EQ(asked(watch, said), 0);
}

class SavedScripts : public testing::Test {
protected:
  TestFolder folder_;
  const std::string part_ = folder_.write("part.evs", "timer( period=1 )\n");
  const std::string show_ = folder_.write("show.evs", kShow);
  ScriptWatch watch_{show_, {}, standardNodes()};
  std::string said_;
};

TEST_F(SavedScripts, AreToldOfWithTheirNameOnceTheyStayAsTheyAre) {
  EXPECT_EQ(asked(watch_, said_), 0);
  folder_.write("part.evs", "timer( period=20 )\n");
  expectToldOnce(watch_, part_);
}

TEST_F(SavedScripts, ThatAreGoneAreToldOfAndWhenTheyAreBack) {
  for (const std::string& file : {part_, show_}) {
    const std::string text = fileContent(file);
    fs::remove(file);
    EXPECT_EQ(asked(watch_, said_), ScriptWatch::kGoneFor + 1);
    EXPECT_EQ(said_, file + " is gone");
    watch_.reset();
    EXPECT_EQ(asked(watch_, said_), 0) << "once is enough";
    folder_.write(fs::path(file).filename(), text);
    EXPECT_EQ(asked(watch_, said_), 2);
    EXPECT_EQ(said_, file + " was saved");
    watch_.reset();
  }
}

TEST(SavedModels, AreToldOfAsWell) {
  const TestFolder folder;
  const std::string model = folder.write("wall.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.write("part.evs", "object( file=wall.obj )\n");
  ScriptWatch watch(folder.write("show.evs", kShow), {}, standardNodes());
  folder.write("wall.obj", "v 0 0 0\nv 1 0 0\nv 0 2.5 0\nf 1 2 3\n");
  expectToldOnce(watch, model);
}

// Editors write another file and put it in the place of the first, which may be away for a moment.
TEST_F(SavedScripts, ThatAreReplacedAreNotTakenForGone) {
  fs::rename(part_, part_ + "~");
  EXPECT_FALSE(watch_.changed());
  EXPECT_FALSE(watch_.changed());
  folder_.write("part.evs", "timer( period=30 )\n");
  EXPECT_EQ(asked(watch_, said_), 2);
  EXPECT_EQ(said_, part_ + " was saved");
}

}  // namespace
}  // namespace stadion
