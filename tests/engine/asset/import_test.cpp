#include "tests/engine/asset/importing.h"

#include "engine/asset/mesh_checks.h"

#include <signal.h>
#include <sys/wait.h>

#include <thread>

namespace stadion::test {
namespace {

void expectArms(const Mesh& mesh) {
  const Vec3 size(3, 2, 1);
  EXPECT_TRUE(mesh.bounds.lo.isZero(1e-5)) << mesh.bounds.lo.transpose();
  EXPECT_TRUE(mesh.bounds.hi.isApprox(size, 1e-5)) << mesh.bounds.hi.transpose();
  EXPECT_EQ(mesh.indices.size() / 3, 36u);
  EXPECT_TRUE(closed(mesh));
  EXPECT_NEAR(volume(mesh), 0.04 * (3 + 2 + 1), 1e-5);
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto p = [&](std::size_t k) {
      const auto& v = mesh.positions[mesh.indices[i + k]];
      return Vec3(v[0], v[1], v[2]);
    };
    const Vec3 face = (p(1) - p(0)).cross(p(2) - p(0)).normalized();
    const auto& n = mesh.normals[mesh.indices[i]];
    EXPECT_GT(face.dot(Vec3(n[0], n[1], n[2])), 0.999) << "a box has sharp edges";
  }
}

TEST(AssetImport, EveryFormatPutsTheSameSolidInTheSamePlace) {
  Importer importer = importerOf(models());
  for (const char* name : {"arms.obj", "arms.3ds", "arms.gltf", "arms.glb", "arms.stl", "arms_yup.dae",
                           "arms_zup_cm.dae", "arms_xup.dae"}) {
    SCOPED_TRACE(name);
    auto mesh = importer.load(name);
    ASSERT_TRUE(mesh) << mesh.error().message;
    expectArms(*mesh.value());
    EXPECT_EQ(mesh.value()->name, name);
  }
  EXPECT_EQ(importer.started(), 1) << "one program reads many files";
}

TEST(AssetImport, TheScriptsUnitAndUpAxisOverrideTheFormats) {
  Importer importer = importerOf(models());
  auto millimetres = importer.load("arms_zup_mm.obj", {0.001, UpAxis::Z});
  ASSERT_TRUE(millimetres);
  expectArms(*millimetres.value());
  auto lying = importer.load("arms_xup.obj", {std::nullopt, UpAxis::X});
  ASSERT_TRUE(lying);
  expectArms(*lying.value());
  // The COLLADA file states +Z up and centimetres; the script knows better: +Y up and metres.
  auto stated = importer.load("arms_zup_cm.dae", {1.0, UpAxis::Y});
  ASSERT_TRUE(stated);
  EXPECT_TRUE(stated.value()->bounds.hi.isApprox(Vec3(300, 0, 200), 1e-4))
      << stated.value()->bounds.hi.transpose();
  EXPECT_TRUE(stated.value()->bounds.lo.isApprox(Vec3(0, -100, 0), 1e-4))
      << stated.value()->bounds.lo.transpose();
  auto turned = importer.load("arms.3ds", {2.0, UpAxis::Y});
  ASSERT_TRUE(turned);
  EXPECT_TRUE(turned.value()->bounds.hi.isApprox(Vec3(6, 0, 4), 1e-4))
      << turned.value()->bounds.hi.transpose();
}

TEST(AssetImport, MaterialsColoursAndTexturesArrive) {
  Importer importer = importerOf(models());
  for (const char* name : {"arms.gltf", "arms.glb"}) {
    SCOPED_TRACE(name);
    auto loaded = importer.load(name);
    ASSERT_TRUE(loaded);
    const Mesh& mesh = *loaded.value();
    const Material& m = mesh.materials.at(mesh.submeshes.at(0).material);
    EXPECT_NEAR(m.baseColour[1], 0.5, 1e-6);
    EXPECT_NEAR(m.baseColour[3], 0.5, 1e-6);
    EXPECT_NEAR(m.emissive[2], 0.5, 1e-6);
    EXPECT_NEAR(m.roughness, 0.5, 1e-6);
    EXPECT_NEAR(m.metallic, 0.25, 1e-6);
    EXPECT_TRUE(m.doubleSided && m.partlyTransparent && m.transparent());
    ASSERT_EQ(m.maps[kBaseMap].texture, 0);
    const Texture& picture = mesh.textures.at(0);
    const std::vector<std::uint8_t> pixels{255, 0, 0,   255, 0,   255, 0,   255,
                                           0,   0, 255, 255, 255, 255, 255, 128};
    EXPECT_EQ(picture.rgba, pixels) << "rows from the top";
    EXPECT_NEAR(mesh.uvs.at(0)[0], 0.25, 1e-6);
    EXPECT_NEAR(mesh.uvs.at(0)[1], 0.75, 1e-6) << "v counts from the top";
    EXPECT_EQ(mesh.colours.at(0), (std::array<std::uint8_t, 4>{255, 188, 0, 255}))
        << "linear 0.5 is sRGB 0.737";
  }
  auto obj = importer.load("arms.obj");
  ASSERT_TRUE(obj);
  const Material& m = obj.value()->materials.at(obj.value()->submeshes.at(0).material);
  EXPECT_EQ(m.name, "orange");
  EXPECT_NEAR(m.baseColour[1], 0.214, 1e-3) << "sRGB 0.5 is linear 0.214";
  EXPECT_NEAR(m.baseColour[3], 0.75, 1e-6);
  EXPECT_NEAR(m.roughness, 0.25, 1e-6);
  EXPECT_TRUE(m.doubleSided) << "it is seen through, and OBJ does not say how many sides a surface has";
}

TEST(AssetImport, ASolidOfGlassHasTwoSidesUnlessItsFormatSaysOtherwise) {
  TestFolder folder;
  std::ofstream(folder.path() / "m.mtl") << "newmtl glass\nKd 0 1 0\nd 0.5\nnewmtl stone\nKd 1 0 0\n";
  std::ofstream(folder.path() / "m.obj")
      << "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl glass\nf 1 3 2\nf 1 2 4\nf 2 3 4\n"
         "f 3 1 4\nusemtl stone\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  Importer importer = importerOf(folder.path());
  auto obj = importer.load("m.obj");
  ASSERT_TRUE(obj) << obj.error().message;
  for (const Submesh& part : obj.value()->submeshes) {
    const Material& m = obj.value()->materials.at(part.material);
    EXPECT_EQ(m.doubleSided, m.name == "glass") << m.name;
  }
}

TEST(AssetImport, BadTrianglesAreLeftOutAndCounted) {
  Importer importer = importerOf(models());
  Diagnostics notes;
  auto mesh = importer.load("nan.obj", {}, {"a.evs", 3, 1}, &notes);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh.value()->indices.size() / 3, 2u);
  ASSERT_EQ(notes.all().size(), 2u);
  EXPECT_EQ(notes.all()[0].severity, Severity::Warning);
  EXPECT_EQ(notes.all()[0].where.line, 3u);
}

TEST(AssetImport, FilesOutsideTheFolderAreNotRead) {
  TestFolder outer;
  const auto inner = outer.path() / "inner";
  std::filesystem::create_directory(inner);
  std::filesystem::copy_file(models() / "arms.png", outer.path() / "secret.png");
  std::filesystem::create_symlink(outer.path() / "secret.png", inner / "link.png");
  std::ofstream(inner / "m.mtl")
      << "newmtl a\nmap_Kd ../secret.png\nnewmtl b\nmap_Kd link.png\nnewmtl c\nmap_Kd "
      << (outer.path() / "secret.png").string() << "\n";
  std::ofstream(inner / "m.obj")
      << "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n"
         "usemtl b\nf 1/1 3/1 2/1\nusemtl c\nf 1/1 2/1 3/1\n";
  Importer importer = importerOf(inner);
  Diagnostics notes;
  auto mesh = importer.load("m.obj", {}, {}, &notes);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_TRUE(mesh.value()->textures.empty());
  EXPECT_EQ(notes.all().size(), 3u);
}

TEST(AssetImport, ErrorsAreOneClearSentence) {
  Importer importer = importerOf(models());
  const auto error = [&](const std::string& name, ImportOptions options = {}) {
    const auto mesh = importer.load(name, options, {"kick.evs", 12, 7});
    EXPECT_FALSE(mesh) << name;
    if (mesh) return std::string();
    EXPECT_EQ(mesh.error().where.line, 12u);
    EXPECT_FALSE(contains(mesh.error().message, "\n"));
    return mesh.error().message;
  };
  EXPECT_TRUE(contains(error("arm.3ds"), "did you mean \"arms.3ds\"?"));
  EXPECT_TRUE(contains(error("arm.3ds"), models().string()));
  EXPECT_TRUE(contains(error("README.md"), "not a model file"));
  EXPECT_TRUE(contains(error("../models/arms.3ds"), "\"..\""));
  EXPECT_TRUE(contains(error("/etc/passwd"), "absolute"));
  EXPECT_TRUE(contains(error("empty.stl"), "is empty"));
  EXPECT_TRUE(contains(error("garbage.glb"), "cannot be read as glTF 2.0"));
  EXPECT_TRUE(contains(error("arms.obj", {-1.0, {}}), "unit"));
  EXPECT_TRUE(contains(error("arms.obj", {std::nan(""), {}}), "unit"));
  EXPECT_EQ(importer.started(), 1);
}

TEST(AssetImport, RefusedFormatsAreNamed) {
  TestFolder folder;
  folder.write("horse.BLEND", "whatever");
  Importer importer = importerOf(folder.path());
  const auto mesh = importer.load("horse.BLEND");
  ASSERT_FALSE(mesh);
  EXPECT_TRUE(contains(mesh.error().message, "Blender")) << mesh.error().message;
  EXPECT_EQ(importer.started(), 0);
}

TEST(AssetImport, AFileIsReadOnlyByTheLoaderOfItsName) {
  TestFolder folder;
  folder.write("arms.obj", bytesOf(models() / "arms.3ds"));
  folder.write("ply.stl", "ply\nformat ascii 1.0\nelement vertex 3\n");
  Importer importer = importerOf(folder.path());
  EXPECT_FALSE(importer.load("arms.obj"));
  EXPECT_FALSE(importer.load("ply.stl"));
}

TEST(AssetImport, ANamedPipeDoesNotHoldTheShow) {
  TestFolder folder;
  ASSERT_EQ(::system(("mkfifo " + (folder.path() / "pipe.obj").string()).c_str()), 0);
  Importer importer = importerOf(folder.path());
  const auto mesh = importer.load("pipe.obj");
  ASSERT_FALSE(mesh);
  EXPECT_TRUE(contains(mesh.error().message, "not a regular file"));
}

TEST(AssetImport, AKilledProgramIsReplaced) {
  Importer importer = importerOf(models());
  ASSERT_TRUE(importer.load("arms.obj"));
  for (int i = 0; i < 5; ++i) {
    const pid_t program = importer.pid();
    ::kill(program, SIGKILL);
    const bool hasDied = i % 2 == 1;
    siginfo_t how{};
    if (hasDied) ::waitid(P_PID, static_cast<id_t>(program), &how, WEXITED | WNOWAIT);
    // The death may be noticed before or during the conversation; the import after that succeeds.
    const auto first = importer.load("arms.obj");
    EXPECT_TRUE(first || (!hasDied && contains(first.error().message, "crashed")));
    EXPECT_TRUE(importer.load("arms.obj"));
  }
}

TEST(AssetImport, MemoryAndSizesAreLimited) {
  ImportLimits small;
  small.addressSpace = 16u << 20;
  Importer importer = importerOf(models(), small);
  const auto mesh = importer.load("arms.obj");
  ASSERT_FALSE(mesh);
  EXPECT_TRUE(contains(mesh.error().message, "out of memory")) << mesh.error().message;

  ImportLimits few;
  few.mesh.triangles = 30;
  EXPECT_TRUE(contains(importerOf(models(), few).load("arms.obj").error().message, "more than 30 triangles"));
  ImportLimits shortFiles;
  shortFiles.fileBytes = 100;
  EXPECT_TRUE(contains(importerOf(models(), shortFiles).load("arms.obj").error().message, "larger"));
  ImportLimits tiny;
  tiny.mesh.textureSide = 1;
  Diagnostics notes;
  EXPECT_TRUE(importerOf(models(), tiny).load("arms.glb", {}, {}, &notes));
  ASSERT_EQ(notes.all().size(), 1u);
  EXPECT_TRUE(contains(notes.all()[0].message, "2 x 2 pixels"));
}

class AssetImportFakeProgram : public ::testing::Test {
protected:
  /// A program that ends by itself is given long: on a busy machine starting it may take its time.
  std::string errorOf(const std::string& script, int milliseconds = 60'000) {
    const auto program = folder_.write("fake", "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    ImportLimits limits;
    limits.timeout = std::chrono::milliseconds(milliseconds);
    Importer importer = importerOf(models(), limits, program);
    const auto mesh = importer.load("arms.obj");
    EXPECT_FALSE(mesh);
    return mesh ? std::string() : mesh.error().message;
  }
  TestFolder folder_;
};

TEST_F(AssetImportFakeProgram, ThatHangsIsKilledInTime) {
  EXPECT_TRUE(contains(errorOf("exec sleep 600", 400), "out of time"));
}

TEST_F(AssetImportFakeProgram, ThatEndsIsReported) {
  EXPECT_TRUE(contains(errorOf("exit 0"), "crashed"));
  EXPECT_TRUE(contains(errorOf("timeout 0.1 cat <&0 >/dev/null"), "crashed"))
      << "after it has read the request";
}

TEST_F(AssetImportFakeProgram, ThatTalksNonsenseIsReported) {
  EXPECT_TRUE(contains(errorOf("head -c 100000 /dev/urandom >&0; sleep 600"), "nonsense"));
}

TEST_F(AssetImportFakeProgram, ThatStopsInTheMiddleIsReported) {
  EXPECT_TRUE(contains(errorOf("printf 'STIA\\001\\000' >&0"), "crashed"));
  EXPECT_TRUE(contains(errorOf("printf 'STIA\\001\\000' >&0; sleep 600", 400), "out of time"));
}

TEST(AssetImport, AMissingProgramIsAnError) {
  Importer importer = importerOf(models(), {}, "/nonexistent/stadion-import");
  const auto mesh = importer.load("arms.obj");
  ASSERT_FALSE(mesh);
  EXPECT_TRUE(contains(mesh.error().message, "cannot be started"));
}

TEST(ThreadsAssetImport, SeveralThreadsMayImportAtOnce) {
  Importer importer = importerOf(models());
  std::vector<std::thread> threads;
  std::atomic<int> loaded = 0;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 5; ++i) loaded += bool(importer.load(i % 2 ? "arms.3ds" : "arms.glb"));
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(loaded, 20);
}

TEST(AssetStandIn, IsAVisibleClosedBoxOfHalfAMetre) {
  const auto box = standIn("lost.3ds");
  EXPECT_TRUE(box->standIn);
  EXPECT_TRUE(closed(*box));
  EXPECT_NEAR(volume(*box), 0.125, 1e-6);
  EXPECT_NEAR(area(*box), 1.5, 1e-6);
  EXPECT_NEAR(box->bounds.lo.z(), 0, 1e-9);
  EXPECT_EQ(box->name, "lost.3ds");
  EXPECT_NE(box->hash, 0u);
}

}  // namespace
}  // namespace stadion::test
