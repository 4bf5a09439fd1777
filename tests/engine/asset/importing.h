#pragma once
// What the tests of the importer share.

#include "engine/asset/import.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace stadion::test {

inline std::filesystem::path models() {
  return std::filesystem::path(STADION_SOURCE_DIR) / "tests/corpus/models";
}

inline Importer importerOf(const std::filesystem::path& folder, ImportLimits limits = {},
                           std::filesystem::path program = Importer::installedProgram()) {
  AssetRoots roots;
  EXPECT_TRUE(roots.add(folder));
  return Importer(std::move(program), std::move(roots), limits);
}

/// A folder that goes away with the test.
class TestFolder {
public:
  TestFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "stadion-test-XXXXXX").string();
    path_ = ::mkdtemp(name.data()) ? name : std::string();
  }
  ~TestFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }

private:
  std::filesystem::path path_;
};

inline std::string bytesOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// One import, with what became of the file's content.
struct Imported {
  std::unique_ptr<Mesh> mesh;  ///< null: failed
  std::string error;
  ModelInventory inventory;
  Diagnostics losses;

  bool used(const std::string& text) const { return has(ContentUse::Used, text); }
  bool approximated(const std::string& text) const { return has(ContentUse::Approximated, text); }
  bool leftOut(const std::string& text) const { return has(ContentUse::LeftOut, text); }
  /// All of the inventory, for the message of a test that fails.
  std::string all() const { return error + inventory.asText(65536); }

private:
  bool has(ContentUse use, const std::string& text) const {
    const auto texts = inventory.texts(use);
    return std::find(texts.begin(), texts.end(), text) != texts.end();
  }
};

inline Imported importOf(const std::filesystem::path& folder, const std::string& name,
                         const ImportOptions& options = {}) {
  ImportLimits limits;
  limits.timeout = std::chrono::minutes(1);  // the program may take its time to start on a busy machine
  Imported imported;
  auto mesh = importerOf(folder, limits).load(name, options, {}, &imported.losses, &imported.inventory);
  if (mesh)
    imported.mesh = std::move(mesh.value());
  else
    imported.error = mesh.error().message;
  return imported;
}

/// Six times the volume is the sum of the triple products; positive when the triangles face outwards [m³].
inline double volume(const Mesh& mesh) {
  double sum = 0;
  const auto at = [&](std::size_t i) {
    const auto& p = mesh.positions[mesh.indices[i]];
    return Vec3(p[0], p[1], p[2]);
  };
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) sum += at(i).dot(at(i + 1).cross(at(i + 2)));
  return sum / 6;
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace stadion::test
