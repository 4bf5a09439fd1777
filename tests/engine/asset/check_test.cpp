// Whole folders of models, and models broken on purpose.

#include "tests/engine/asset/importing.h"

#include "engine/asset/check.h"
#include "tests/engine/asset/gltf_builder.h"
#include "tests/engine/asset/written_models.h"
#include "tests/mutations.h"

#include <map>

namespace stadion::test {
namespace {

TEST(AssetCheck, CountsWhatLoadsAndWhatDoesNot) {
  TestFolder folder;
  std::filesystem::copy(models(), folder.path() / "models");
  folder.write("horse.blend", "x");
  folder.write("notes.txt", "x");
  std::map<std::string, AssetFinding> told;
  const auto counts = checkAssets(Importer::installedProgram(), folder.path(), [&](const AssetFinding& f) {
    EXPECT_EQ(f.mesh != nullptr, f.verdict == AssetVerdict::Loaded);
    EXPECT_EQ(f.message.empty(), f.verdict == AssetVerdict::Loaded);
    told[f.file] = f;
  });
  ASSERT_TRUE(counts);
  EXPECT_EQ(counts.value().loaded, 15u);
  EXPECT_EQ(counts.value().refused, 1u);
  EXPECT_EQ(counts.value().failed, 2u);
  EXPECT_EQ(counts.value().faults, 0u);
  EXPECT_EQ(told.size(), 18u);
  EXPECT_EQ(told["models/empty.stl"].verdict, AssetVerdict::Failed);
  EXPECT_FALSE(checkAssets(Importer::installedProgram(), "/nonexistent", [](const AssetFinding&) {}));
}

TEST(AssetCheck, ASingleFileIsChecked) {
  TestFolder folder;
  std::filesystem::copy(models(), folder.path() / "models");
  std::vector<std::string> told;
  const auto check = [&](const char* file) {
    return checkAssets(Importer::installedProgram(), folder.path() / file,
                       [&](const AssetFinding& f) { told.push_back(f.file); });
  };
  EXPECT_EQ(check("models/empty.stl").value().failed, 1U);
  folder.write("horse.blend", "x");
  EXPECT_EQ(check("horse.blend").value().refused, 1U);
  folder.write("notes.txt", "x");
  EXPECT_EQ(check("notes.txt").value().refused, 1U);
  EXPECT_EQ(told, (std::vector<std::string>{"empty.stl", "horse.blend", "notes.txt"}));
}

TEST(AssetCheck, TheModelsOfTheAssimpPackageNeitherCrashNorHang) {
  const std::filesystem::path folder = "/usr/share/assimp";
  if (!std::filesystem::exists(folder / "models"))
    GTEST_SKIP() << "the package assimp-testmodels is not installed";
  const auto counts = checkAssets(Importer::installedProgram(), folder, [](const AssetFinding& f) {
    EXPECT_EQ(f.message.empty(), f.verdict == AssetVerdict::Loaded) << f.file;
  });
  ASSERT_TRUE(counts);
  EXPECT_GE(counts.value().loaded, 75u);
  EXPECT_GE(counts.value().refused, 200u);
  RecordProperty("loaded", static_cast<int>(counts.value().loaded));
  RecordProperty("refused", static_cast<int>(counts.value().refused));
  RecordProperty("failed", static_cast<int>(counts.value().failed));
  RecordProperty("faults", static_cast<int>(counts.value().faults));
}

class Mutator {
public:
  explicit Mutator(std::uint64_t seed) : state_(seed + 42) {}
  std::string operator()(std::string bytes) {
    for (std::size_t n = 1 + roll(6); n > 0 && !bytes.empty(); --n) {
      const std::size_t at = roll(bytes.size());
      switch (roll(6)) {
      case 0: bytes[at] = static_cast<char>(roll(256)); break;
      case 1: bytes[at] = static_cast<char>(bytes[at] ^ (1 << roll(8))); break;
      case 2: bytes.resize(at); break;
      case 3: bytes.insert(at, bytes.substr(at, 1 + roll(64))); break;
      case 4: bytes.erase(at, 1 + roll(16)); break;
      default:
        for (std::size_t i = at; i < std::min(at + 4, bytes.size()); ++i) bytes[i] = static_cast<char>(0xff);
      }
    }
    return bytes;
  }

private:
  std::size_t roll(std::size_t sides) {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<std::size_t>(state_ >> 33) % sides;
  }
  std::uint64_t state_;
};

/// A GLB with what the reader does most with: a strip, a sparse accessor, small integers, a skin and a clip.
std::string richGlb() {
  GltfBuilder b;
  using B = GltfBuilder;
  b.square();
  b.attribute("NORMAL", std::vector<std::int8_t>(16, 64), B::kByte, "VEC3", 4);
  b.json["bufferViews"].back()["byteStride"] = 4;
  b.json["accessors"].back()["normalized"] = true;
  b.attribute("COLOR_0", std::vector<std::uint16_t>(16, 999), B::kUnsignedShort, "VEC4", 4);
  b.attribute("JOINTS_0", std::vector<std::uint8_t>(16, 0), B::kUnsignedByte, "VEC4", 4);
  b.attribute("WEIGHTS_0", std::vector<float>(16, 0.25f), B::kFloat, "VEC4", 4);
  b.primitive()["indices"] = b.accessor(std::vector<std::uint8_t>{0, 1, 3, 2}, B::kUnsignedByte, "SCALAR", 4);
  b.primitive()["mode"] = 5;
  const std::vector<std::uint8_t> places{1};
  const std::vector<float> values{1, 0, 1};
  const auto placeView = b.view(places.data(), 1), valueView = b.view(values.data(), 12);
  b.json["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", placeView}, {"componentType", B::kUnsignedByte}}},
      {"values", {{"bufferView", valueView}}}};
  const auto times = b.accessor(std::vector<float>{0, 1}, B::kFloat, "SCALAR", 2);
  const auto moves = b.accessor(std::vector<float>(6, 0.0f), B::kFloat, "VEC3", 2);
  b.json["nodes"] =
      nlohmann::json::parse(R"([{"mesh": 0, "skin": 0, "children": [1]}, {"rotation": [0, 0, 1, 0]}])");
  b.json["skins"] = nlohmann::json::parse(R"([{"joints": [1]}])");
  b.json["animations"] = {
      {{"samplers", {{{"input", times}, {"output", moves}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}}};
  return b.glb();
}

/// Names and bytes of the models that are damaged.
std::vector<std::pair<std::string, std::string>> soundModels() {
  std::vector<std::pair<std::string, std::string>> seeds;
  for (const char* name : {"arms.obj", "arms.3ds", "arms.gltf", "arms.glb", "arms_zup_cm.dae", "arms.stl",
                           "mask.gltf", "lamp.gltf"})
    seeds.emplace_back(name, bytesOf(models() / name));
  seeds.emplace_back("rich.glb", richGlb());
  seeds.emplace_back("wedge.fbx", fbxZUpCentimetres());
  seeds.emplace_back("wedge.ply", plyWedge());
  return seeds;
}

TEST(AssetCheck, MutatedModelsNeverHarmTheShow) {
  const auto [count, seed] = mutations(200);
  TestFolder folder;
  std::filesystem::copy_file(models() / "arms.bin", folder.path() / "arms.bin");
  ImportLimits limits;
  limits.timeout = std::chrono::milliseconds(2000);
  Importer importer = importerOf(folder.path(), limits);
  Mutator mutate(seed);
  int loaded = 0, failed = 0;
  const auto seeds = soundModels();
  for (int i = 0; i < count; ++i) {
    const auto& [name, bytes] = seeds[static_cast<std::size_t>(i) % seeds.size()];
    folder.write(name, mutate(bytes));
    const auto mesh = importer.load(name);
    ++(mesh ? loaded : failed);
    if (mesh)
      for (auto index : mesh.value()->indices) ASSERT_LT(index, mesh.value()->positions.size());
    else
      ASSERT_FALSE(mesh.error().message.empty());
  }
  EXPECT_EQ(loaded + failed, count);
  std::printf("%d mutated models: %d loaded, %d refused, %d importer programs lost\n", count, loaded, failed,
              importer.started() - 1);
  EXPECT_TRUE(importerOf(models()).load("arms.obj"));
}

}  // namespace
}  // namespace stadion::test
