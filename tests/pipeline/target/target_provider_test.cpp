#include "engine/base/shared_library.h"
#include "pipeline/gl/gl_table.h"
#include "pipeline/gl/picture_size.h"
#include "pipeline/target/rasteriser_settings.h"
#include "tests/pipeline/gl_draw/renderer_scene.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <mutex>

namespace stadion {
namespace {

class TargetProvider : public testing::TestWithParam<GlProviderKind> {};

INSTANTIATE_TEST_SUITE_P(All, TargetProvider, testing::Values(GlProviderKind::OsMesa, GlProviderKind::Egl),
                         [](const auto& kind) {
                           return kind.param == GlProviderKind::Egl ? "Egl" : "OsMesa";
                         });

TEST_P(TargetProvider, OffersAtLeastOpenGl33Core) {
  const auto target = test::provider(GetParam())->create(64, 48);
  ASSERT_TRUE(target) << target.error().message;
  ASSERT_FALSE(target.value()->makeCurrent());
  GLint major = 0, minor = 0, profile = 0;
  const GlTable& gl = target.value()->gl();
  gl.GetIntegerv(GL_MAJOR_VERSION, &major);
  gl.GetIntegerv(GL_MINOR_VERSION, &minor);
  gl.GetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  EXPECT_GE(10 * major + minor, 33);
  EXPECT_EQ(profile, GL_CONTEXT_CORE_PROFILE_BIT);
  EXPECT_NE(describeGl(gl).find("OpenGL"), std::string::npos) << describeGl(gl);
  target.value()->release();
}

/// An implementation that draws less than Stadion would.
class SmallTarget final : public Target {
public:
  SmallTarget(const GlTable& gl, std::mutex& turns) : Target(gl, turns, 1, 1) {}
  std::optional<Diagnostic> makeCurrent() override { return {}; }
  void release() override {}
};

class SmallProvider final : public GlProvider {
public:
  SmallProvider() {
    gl_.GetIntegerv = [](GLenum what, GLint* value) {
      value[0] = what == GL_MAX_TEXTURE_SIZE ? 2048 : 4096;
      if (what == GL_MAX_VIEWPORT_DIMS) value[1] = 1024;
    };
  }
  std::string_view name() const override { return "small"; }
  Result<std::unique_ptr<Target>> create(std::uint32_t, std::uint32_t) override {
    return std::unique_ptr<Target>(std::make_unique<SmallTarget>(gl_, turns_));
  }

private:
  GlTable gl_;
  std::mutex turns_;
};

TEST(TargetSize, IsWhatTheProviderSaysItCanDraw) {
  SmallProvider provider;
  EXPECT_FALSE(checkPictureSize(provider, 2048, 1024));
  for (const auto& [width, height] : {std::pair(2049u, 1u), std::pair(1u, 1025u)}) {
    const auto why = checkPictureSize(provider, width, height);
    ASSERT_TRUE(why);
    EXPECT_NE(why->message.find("too large for small, which draws at most 2048 x 1024"), std::string::npos)
        << why->message;
  }
  EXPECT_TRUE(checkPictureSize(provider, kMaxPictureSide + 1, 1));
}

TEST_P(TargetProvider, SaysBeforehandWhichSizesItDraws) {
  GlProvider& provider = *test::provider(GetParam());
  EXPECT_FALSE(checkPictureSize(provider, 800, 600));
  EXPECT_TRUE(checkPictureSize(provider, kMaxPictureSide, kMaxPictureSide));
  EXPECT_TRUE(checkPictureSize(provider, 0, 1));
}

TEST_P(TargetProvider, RefusesSizesThatCannotBeDrawn) {
  GlProvider& provider = *test::provider(GetParam());
  EXPECT_FALSE(provider.create(0, 10));
  EXPECT_FALSE(provider.create(10, 0));
  EXPECT_FALSE(provider.create(kMaxPictureSide + 1, 1));
  EXPECT_FALSE(provider.create(kMaxPictureSide, kMaxPictureSide));
  const auto wide = provider.create(20000, 1);
  ASSERT_FALSE(wide);
  EXPECT_EQ(wide.error().message,
            "a picture of 20000 x 1 pixels cannot be drawn: each side must be 1 to 16384");
  EXPECT_TRUE(provider.create(kMaxPictureSide, 1));
}

TEST_P(TargetProvider, LeavesNoContextBehindAfterRelease) {
  GlProvider& provider = *test::provider(GetParam());
  auto first = std::move(provider.create(8, 8).value());
  auto second = std::move(provider.create(8, 8).value());
  for (int i = 0; i < 3; ++i) {
    ASSERT_FALSE(first->makeCurrent());
    EXPECT_NE(first->gl().GetString(GL_VERSION), nullptr);
    first->release();
    ASSERT_FALSE(second->makeCurrent());
    EXPECT_NE(second->gl().GetString(GL_VERSION), nullptr);
    second->release();
  }
  EXPECT_EQ(first->gl().GetString(GL_VERSION), nullptr);
}

/// The description of what draws on that card, or the reason why nothing does.
std::string drawnOn(GlProvider& provider, std::optional<std::uint32_t> card) {
  const auto target = provider.createOn(card, 8, 8);
  if (!target) return target.error().message;
  if (const auto why = target.value()->makeCurrent()) return why->message;
  std::string description = describeGl(target.value()->gl());
  target.value()->release();
  return description;
}

TEST(TargetCard, EachListedCardCanBeChosenAndNoOther) {
  GlProvider& egl = *test::provider(GlProviderKind::Egl);
  const std::vector<std::string> cards = egl.cards();
  if (cards.empty()) GTEST_SKIP() << "this EGL lists no cards";
  for (std::uint32_t card = 0; card < cards.size(); ++card) {
    EXPECT_NE(cards[card], "");
    EXPECT_NE(drawnOn(egl, card).find("OpenGL"), std::string::npos) << drawnOn(egl, card);
  }
  const auto none = static_cast<std::uint32_t>(cards.size());
  EXPECT_EQ(
      drawnOn(egl, none).find("there is no graphics card " + std::to_string(none) + "; EGL has these: 0 ("),
      0u)
      << drawnOn(egl, none);
}

TEST(TargetCard, AnImplementationWithoutCardsIgnoresTheirNumbers) {
  GlProvider& osMesa = *test::provider(GlProviderKind::OsMesa);
  EXPECT_TRUE(osMesa.cards().empty());
  EXPECT_EQ(drawnOn(osMesa, 7), drawnOn(osMesa, {}));
}

TEST(TargetLibrary, NamesThePackageOfAMissingLibrary) {
  const auto library = SharedLibrary::open("libnowhere.so.8", "nowhere6");
  ASSERT_FALSE(library);
  EXPECT_EQ(library.error().message, "libnowhere.so.8 is missing: apt-get install nowhere6");
}

TEST(TargetLibrary, NamesTheFunctionThatAnImplementationLacks) {
  const auto table = loadGlTable([](const char* name) -> GlSymbol {
    return std::string_view(name) == "glDrawElementsInstanced" ? nullptr : +[] {};
  });
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().message, "this OpenGL has no function glDrawElementsInstanced");
}

/// Puts a variable of the environment back at the end.
class ProviderEnvironment {
public:
  explicit ProviderEnvironment(const char* name) : name_(name) {
    if (const char* value = std::getenv(name)) before_ = value;
    unsetenv(name);
  }
  ~ProviderEnvironment() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
  ProviderEnvironment(const ProviderEnvironment&) = delete;
  ProviderEnvironment& operator=(const ProviderEnvironment&) = delete;

private:
  const char* name_;
  std::optional<std::string> before_;
};

TEST(TargetRasteriser, IsPinnedTo256BitsAndAThreadPerCore) {
  const ProviderEnvironment width("LP_NATIVE_VECTOR_WIDTH"), threads("LP_NUM_THREADS");
  EXPECT_FALSE(pinRasteriser());
  EXPECT_STREQ(std::getenv("LP_NATIVE_VECTOR_WIDTH"), "256");
  EXPECT_GE(std::atoi(std::getenv("LP_NUM_THREADS")), 1);
}

TEST(TargetRasteriser, KeepsWhatTheUserChose) {
  const ProviderEnvironment width("LP_NATIVE_VECTOR_WIDTH"), threads("LP_NUM_THREADS");
  setenv("LP_NATIVE_VECTOR_WIDTH", "128", 1);
  setenv("LP_NUM_THREADS", "0", 1);
  EXPECT_FALSE(pinRasteriser());
  EXPECT_STREQ(std::getenv("LP_NATIVE_VECTOR_WIDTH"), "128");
  EXPECT_STREQ(std::getenv("LP_NUM_THREADS"), "0");
}

TEST(TargetRasteriser, KnowsWhetherTheUserChoseItsThreads) {
  const ProviderEnvironment width("LP_NATIVE_VECTOR_WIDTH"), threads("LP_NUM_THREADS");
  EXPECT_FALSE(rasteriserThreadsGiven());
  setenv("LP_NUM_THREADS", "", 1);
  EXPECT_FALSE(rasteriserThreadsGiven());
  EXPECT_FALSE(pinRasteriser());
  EXPECT_GE(std::atoi(std::getenv("LP_NUM_THREADS")), 1);
  setenv("LP_NUM_THREADS", "0", 1);
  EXPECT_EQ(rasteriserThreadsGiven(), 0u);
  setenv("LP_NUM_THREADS", "999", 1);
  EXPECT_EQ(rasteriserThreadsGiven(), 32u);  // Mesa takes no more
  setRasteriserThreads(3);
  EXPECT_STREQ(std::getenv("LP_NUM_THREADS"), "3");
}

TEST(TargetRasteriser, RefusesAVectorWidthWithWhichMesaCrashes) {
  const ProviderEnvironment width("LP_NATIVE_VECTOR_WIDTH"), threads("LP_NUM_THREADS");
  setenv("LP_NATIVE_VECTOR_WIDTH", "512", 1);
  const auto problem = pinRasteriser();
  ASSERT_TRUE(problem);
  EXPECT_NE(problem->message.find("LP_NATIVE_VECTOR_WIDTH=512"), std::string::npos);
  EXPECT_FALSE(openOsMesa());
  EXPECT_FALSE(openEgl());
}

}  // namespace
}  // namespace stadion
