#include "pipeline/process/shared_meshes.h"

#include "engine/asset/mesh_checks.h"
#include "engine/asset/mesh_file.h"
#include "pipeline/process/protocol.h"

#include <algorithm>
#include <cstring>

namespace stadion::wall_process {
namespace {

constexpr std::size_t kPage = 4096;  // so that what is given back goes back to the system

template <class T>
void append(std::vector<std::uint8_t>& bytes, const T* values, std::size_t count) {
  const auto* from = reinterpret_cast<const std::uint8_t*>(values);
  bytes.insert(bytes.end(), from, from + count * sizeof(T));
}

/// The file's size, the file, and after it the levels.
std::vector<std::uint8_t> encodeAll(const Mesh& mesh) {
  const std::vector<std::uint8_t> file = encode(mesh);
  std::vector<std::uint8_t> bytes;
  const std::uint64_t size = file.size(), levels = mesh.levels.size();
  append(bytes, &size, 1);
  append(bytes, file.data(), file.size());
  append(bytes, &levels, 1);
  for (const MeshLevel& level : mesh.levels) {
    const std::uint64_t counts[] = {level.indices.size(), level.submeshes.size()};
    append(bytes, &level.error, 1);
    append(bytes, counts, 2);
    append(bytes, level.indices.data(), level.indices.size());
    append(bytes, level.submeshes.data(), level.submeshes.size());
  }
  return bytes;
}

class SharedMeshReader {
public:
  explicit SharedMeshReader(std::span<const std::byte> bytes) : rest_(bytes) {}
  template <class T>
  bool get(T* values, std::uint64_t count) {
    if (count > rest_.size() / sizeof(T)) return false;
    if (count > 0) std::memcpy(values, rest_.data(), count * sizeof(T));
    rest_ = rest_.subspan(count * sizeof(T));
    return true;
  }
  template <class T>
  bool get(std::vector<T>& values, std::uint64_t count) {
    if (count > rest_.size() / sizeof(T)) return false;
    values.resize(count);
    return get(values.data(), count);
  }
  bool get(std::span<const std::byte>& part, std::uint64_t bytes) {
    if (bytes > rest_.size()) return false;
    part = rest_.first(bytes);
    rest_ = rest_.subspan(bytes);
    return true;
  }

private:
  std::span<const std::byte> rest_;
};

bool readLevels(SharedMeshReader& in, Mesh& mesh) {
  constexpr std::uint64_t kMostLevels = 64;
  std::uint64_t levels = 0;
  if (!in.get(&levels, 1) || levels > kMostLevels) return false;
  for (std::uint64_t i = 0; i < levels; ++i) {
    MeshLevel level;
    std::uint64_t counts[2] = {};
    if (!in.get(&level.error, 1) || !in.get(counts, 2) || !in.get(level.indices, counts[0]) ||
        !in.get(level.submeshes, counts[1]))
      return false;
    mesh.levels.push_back(std::move(level));
  }
  return true;
}

}  // namespace

SharedMeshes::SharedMeshes(const MeshStore& meshes)
    : meshes_(meshes), segment_("stadion-meshes", kMeshReserve) {}

std::optional<SharedMeshPlace> SharedMeshes::take(MeshId id, std::uint64_t hash) {
  const std::lock_guard lock(mutex_);
  const auto known = std::find_if(entries_.begin(), entries_.end(), [&](const auto& p) {
    return p.second.place.id == id && p.second.hash == hash;
  });
  if (known != entries_.end()) {
    ++known->second.users;
    return known->second.place;
  }
  const Mesh* mesh = meshes_.find(id);
  if (!mesh) return {};
  const std::vector<std::uint8_t> bytes = encodeAll(*mesh);
  const std::size_t offset = extents_.take((bytes.size() + kPage - 1) / kPage * kPage);
  segment_.growTo(extents_.end());
  std::memcpy(segment_.data() + offset, bytes.data(), bytes.size());
  const SharedMeshPlace place{id, offset, bytes.size()};
  entries_[offset] = {place, hash, 1};
  return place;
}

void SharedMeshes::giveBack(const SharedMeshPlace& place) {
  const std::lock_guard lock(mutex_);
  const auto at = entries_.find(place.offset);
  if (at == entries_.end() || --at->second.users > 0) return;
  const std::size_t bytes = (place.bytes + kPage - 1) / kPage * kPage;
  entries_.erase(at);
  segment_.discard(place.offset, bytes);
  extents_.giveBack(place.offset, bytes);
}

std::unique_ptr<const Mesh> meshOf(std::span<const std::byte> bytes) {
  SharedMeshReader in(bytes);
  std::uint64_t size = 0;
  std::span<const std::byte> file;
  if (!in.get(&size, 1) || !in.get(file, size)) return {};
  auto mesh = decode({reinterpret_cast<const std::uint8_t*>(file.data()), file.size()});
  if (!mesh || !readLevels(in, *mesh.value())) return {};
  finish(*mesh.value());
  return std::move(mesh.value());
}

}  // namespace stadion::wall_process
