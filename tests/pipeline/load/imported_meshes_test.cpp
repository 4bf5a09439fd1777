#include "pipeline/load/imported_meshes.h"
#include "tests/fresh_folder.h"

#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace stadion {
namespace {

std::optional<ImportedMeshes::Key> keyOf(const std::filesystem::path& file,
                                         const ImportOptions& options = {}) {
  const int fd = open(file.c_str(), O_RDONLY);
  const auto key = ImportedMeshes::Key::of(fd, options);
  close(fd);
  return key;
}

TEST(ImportedMeshes, AreThereForTheNextShowAfterTheFirstHasGivenThemBack) {
  ImportedMeshes kept;
  auto mesh = std::make_unique<Mesh>();
  mesh->hash = 7;
  const MeshId id = kept.store().add(std::move(mesh));
  const ImportedMeshes::Key key{1, 2, 3, 4, 0, -1};
  EXPECT_EQ(kept.find(key), kNoMesh);
  kept.keep(key, id);
  kept.store().release(id, 100);
  kept.store().collect(~std::uint64_t{0});
  ASSERT_EQ(kept.find(key), id);
  EXPECT_TRUE(kept.store().find(id));
}

TEST(ImportedMeshes, AFileThatWasEditedOrIsReadOtherwiseIsAnotherModel) {
  const FreshFolder folder;
  const auto file = folder / "kept";
  std::ofstream(file) << "one";
  const auto first = keyOf(file), same = keyOf(file);
  ASSERT_TRUE(first && same);
  EXPECT_TRUE(*first == *same);
  ImportOptions inches;
  inches.unit = 0.0254;
  EXPECT_FALSE(*first == *keyOf(file, inches));
  std::ofstream(file) << "two and more";
  EXPECT_FALSE(*first == *keyOf(file));
  std::filesystem::remove(file);
  EXPECT_FALSE(ImportedMeshes::Key::of(-1, {}));
}

}  // namespace
}  // namespace stadion
