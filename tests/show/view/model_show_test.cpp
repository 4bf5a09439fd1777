/// The show that `stadion view MODEL` makes of a model.

#include "show/view/model_show.h"

#include "engine/asset/import.h"
#include "show/player/show_check.h"
#include "tests/programs/program.h"

#include <filesystem>
#include <gtest/gtest.h>

namespace stadion {
namespace {

std::unique_ptr<ModelShow> showOf(const std::string& model, Diagnostics& findings) {
  return ModelShow::make(model, Importer::installedProgram(), findings);
}

TEST(ShowOfAModel, HasNoMistakesAndGoesWithItsOwner) {
  const TestFolder folder;
  const std::string model = folder.path() / "a ball.3ds";
  std::filesystem::copy_file(assetFolder() + "/football.3ds", model);
  ASSERT_TRUE(ModelShow::isModel(model));
  Diagnostics findings;
  auto show = showOf(model, findings);
  ASSERT_TRUE(show) << findings.all().front().message;
  const std::string script = show->script();
  EXPECT_TRUE(checkShow(script, {show->assetRoot()}, standardNodes()).all().empty()) << fileContent(script);
  EXPECT_NE(fileContent(script).find("file=\"a ball.3ds\""), std::string::npos);
  show.reset();
  EXPECT_FALSE(std::filesystem::exists(script));
}

TEST(ShowOfAModel, TellsWhatIsWrongWithTheModel) {
  const TestFolder folder;
  const std::string broken = folder.write("broken.obj", "v 0 0 0\nf 1 2 3\n"),
                    quoted = folder.write("a\"b.obj", "");
  for (const std::string& model :
       {broken, quoted, std::string(folder.path() / "missing.glb"),
        std::string(folder.path() / "nowhere/x.glb"), folder.write("scan.blend", "x")}) {
    Diagnostics findings;
    EXPECT_FALSE(showOf(model, findings)) << model;
    ASSERT_EQ(findings.errorCount(), 1u) << model;
    EXPECT_FALSE(findings.all().front().message.empty());
  }
  EXPECT_FALSE(ModelShow::isModel("show.evs"));
}

}  // namespace
}  // namespace stadion
