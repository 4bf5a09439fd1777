#include "show/recording/state_file.h"

#include "engine/base/atomic_file.h"
#include "engine/base/plain_file.h"
#include "engine/scene/scene_snapshot.h"
#include "profiling/record/node_names.h"

#include <fmt/format.h>

#include <cstring>

namespace stadion {
namespace {

constexpr std::string_view kStateMagic = "stadion state 1\n";
constexpr std::size_t kStateHead = kStateMagic.size() + sizeof(std::uint64_t);
constexpr std::string_view kFieldsMagic = "stadion fields 1";  ///< ends a file that has them
constexpr std::size_t kMostStateBytes = std::size_t{1} << 30;

}  // namespace

namespace {

/// "@PATH\tFILE:LINE" for each node, and below it "NAME\tVALUE" for each field.
std::string namedFields(Scene& scene) {
  NodeNames names;
  names.see(scene);
  std::string text;
  std::optional<NodeRef> last;
  for (const SceneSnapshot::NamedField& f : SceneSnapshot(scene).named()) {
    if (last != f.node) {
      const auto name = names.find(f.node);
      text += name ? fmt::format("@{}\t{}:{}\n", name->path, name->file, name->line) : "@the scene\n";
      last = f.node;
    }
    text += f.name + '\t' + f.value + '\n';
  }
  return text;
}

}  // namespace

std::optional<SavedStateDifference> savedStateDifference(Scene& scene, std::uint64_t files,
                                                         std::span<const std::uint8_t> state) {
  if (const std::uint64_t ours = SceneSnapshot::filesOf(scene); ours != files)
    return SavedStateDifference{"the scene, files", fmt::format("{:016x}", ours),
                                fmt::format("{:016x}", files)};
  const auto d = SceneSnapshot(scene).difference(state);
  if (!d) return {};
  NodeNames names;
  names.see(scene);
  const auto name = names.find(d->node);
  const std::string where =
      name ? fmt::format("{} ({}:{})", name->path, name->file, name->line) : "the scene";
  return SavedStateDifference{where + ", " + d->field, d->here, d->there};
}

std::optional<Diagnostic> saveState(Scene& scene, const std::string& file) {
  const std::uint64_t files = SceneSnapshot::filesOf(scene);
  const std::vector<std::uint8_t> state = SceneSnapshot(scene).save();
  std::string bytes(kStateMagic);
  bytes.append(reinterpret_cast<const char*>(&files), sizeof files);
  bytes.append(reinterpret_cast<const char*>(state.data()), state.size());
  const std::string fields = namedFields(scene);
  const std::uint64_t size = fields.size();
  bytes += fields;
  bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
  bytes += kFieldsMagic;
  return writeFile(file, bytes);
}

/// Of the bytes of a file.
static std::string fieldsOf(const std::string& bytes) {
  std::uint64_t size = 0;
  if (!bytes.ends_with(kFieldsMagic) || bytes.size() < kFieldsMagic.size() + sizeof size) return "";
  const std::size_t end = bytes.size() - kFieldsMagic.size() - sizeof size;
  std::memcpy(&size, bytes.data() + end, sizeof size);
  return size <= end ? bytes.substr(end - static_cast<std::size_t>(size), static_cast<std::size_t>(size))
                     : "";
}

std::string fieldsIn(const std::string& file) {
  const Result<std::string> read = readPlainFile(file, kMostStateBytes);
  return read ? fieldsOf(read.value()) : "";
}

Result<std::optional<SavedStateDifference>> compareState(Scene& scene, const std::string& file) {
  const Result<std::string> read = readPlainFile(file, kMostStateBytes);
  if (!read) return read.error();
  const std::string& bytes = read.value();
  if (bytes.size() < kStateHead || !bytes.starts_with(kStateMagic))
    return Diagnostic{
        Severity::Error, {file, 0, 0}, "is no state; stadion hash SHOW --save-state FILE writes one", {}};
  std::uint64_t files = 0;
  std::memcpy(&files, bytes.data() + kStateMagic.size(), sizeof files);
  const std::string ours = namedFields(scene), theirs = fieldsOf(bytes);
  if (!theirs.empty()) {
    const std::string here = frameOf(ours), there = frameOf(theirs);
    if (here != there) return std::optional(SavedStateDifference{"the frame", here, there});
    if (files != SceneSnapshot::filesOf(scene))
      if (auto found = namedDifference(ours, theirs)) return found;
  }
  const auto* state = reinterpret_cast<const std::uint8_t*>(bytes.data() + kStateHead);
  return savedStateDifference(scene, files, {state, bytes.size() - kStateHead});
}

}  // namespace stadion
