#pragma once
/// The only file system that assimp sees: regular files below the asset root, read whole into memory.

#include <assimp/IOSystem.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace stadion::importer {

class Jail : public Assimp::IOSystem {
public:
  Jail(int root, std::uint64_t mostBytes) : root_(root), mostBytes_(mostBytes) {}
  /// From now on the file at `path` has these bytes.
  void replace(std::string path, std::vector<std::uint8_t> bytes);

  bool Exists(const char* path) const override;
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* path, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;
  bool CreateDirectory(const std::string&) override { return false; }
  bool ChangeDirectory(const std::string&) override { return false; }
  bool DeleteFile(const std::string&) override { return false; }

private:
  int root_;
  std::uint64_t mostBytes_;
  std::map<std::string, std::vector<std::uint8_t>> replacements_;  ///< by path
};

}  // namespace stadion::importer
