#include "engine/asset/importer_program/assimp/jail.h"

#include "engine/asset/beneath.h"
#include "engine/asset/importer_program/source/model_files.h"

#include <assimp/IOStream.hpp>

#include <algorithm>
#include <cstring>

namespace stadion::importer {
namespace {

class MemoryFile : public Assimp::IOStream {
public:
  explicit MemoryFile(std::vector<std::uint8_t> bytes) : bytes_(std::move(bytes)) {}

  std::size_t Read(void* to, std::size_t size, std::size_t count) override {
    if (size == 0) return 0;
    const std::size_t whole = std::min(count, (bytes_.size() - at_) / size);
    if (whole > 0) std::memcpy(to, bytes_.data() + at_, whole * size);
    at_ += whole * size;
    return whole;
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    // From the end assimp means "offset back"; unsigned wrap-around of negative offsets is caught by the
    // check.
    const std::size_t base = origin == aiOrigin_CUR ? at_ : origin == aiOrigin_END ? bytes_.size() : 0;
    const std::size_t to = base + offset;
    if (to > bytes_.size()) return aiReturn_FAILURE;
    at_ = to;
    return aiReturn_SUCCESS;
  }
  std::size_t Tell() const override { return at_; }
  std::size_t FileSize() const override { return bytes_.size(); }
  void Flush() override {}

private:
  std::vector<std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

}  // namespace

void Jail::replace(std::string path, std::vector<std::uint8_t> bytes) {
  replacements_[plainPath(std::move(path))] = std::move(bytes);
}

bool Jail::Exists(const char* path) const {
  return path && bool(openBeneath(root_, plainPath(path)));
}

Assimp::IOStream* Jail::Open(const char* path, const char* mode) {
  if (!path || !mode || std::strpbrk(mode, "wa+")) return nullptr;
  if (const auto replaced = replacements_.find(plainPath(path)); replaced != replacements_.end())
    return new MemoryFile(replaced->second);
  auto bytes = readBeneath(root_, path, mostBytes_);
  return bytes ? new MemoryFile(std::move(*bytes)) : nullptr;
}

void Jail::Close(Assimp::IOStream* stream) {
  delete stream;
}

}  // namespace stadion::importer
