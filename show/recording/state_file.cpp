#include "show/recording/state_file.h"

#include "engine/base/atomic_file.h"
#include "engine/base/plain_file.h"
#include "engine/core/state_hash.h"
#include "engine/scene/scene_snapshot.h"
#include "profiling/record/node_names.h"

#include <fmt/format.h>

#include <cstring>

namespace stadion {
namespace {

constexpr std::string_view kStateMagic = "stadion state 1\n";
constexpr std::size_t kStateHead = kStateMagic.size() + sizeof(std::uint64_t);
constexpr std::string_view kEndMagic = "stadion fields 2";         ///< ends a file
constexpr std::string_view kEarlierEndMagic = "stadion fields 1";  ///< likewise, without a checksum
constexpr std::size_t kMostListedNodes = 256;                      ///< a baseline has room for their names
constexpr std::size_t kMostStateBytes = std::size_t{1} << 30;

/// "@+PATH\tFILE:LINE" for each node, whether it has fields or not. Empty if there are many.
std::string listOfNodes(const Scene& scene, const NodeNames& names) {
  std::string text;
  std::size_t count = 0;
  for (const auto& [number, l] : scene.tree().loads()) {
    if ((count += l->nodes.size()) > kMostListedNodes) return "";
    for (std::uint32_t position = 0; position < l->nodes.size(); ++position)
      if (const auto name = names.find({number, position}))
        text += fmt::format("@{}{}\t{}:{}\n", kListedNode, name->path, name->file, name->line);
  }
  return text;
}

/// First the list of nodes. Then "@PATH\tFILE:LINE" for each node, and below it "NAME\tVALUE" for each field.
std::string namedFields(Scene& scene) {
  NodeNames names;
  names.see(scene);
  std::string text = listOfNodes(scene, names);
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

std::uint64_t checksumOf(std::string_view bytes) {
  StateHash hash;
  hash.add(bytes);
  return hash.value();
}

void appendNumber(std::string& bytes, std::uint64_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// Takes a number from the end of the bytes. Nothing if they are too short.
std::optional<std::uint64_t> takeLastNumber(std::string_view& bytes) {
  std::uint64_t number = 0;
  if (bytes.size() < sizeof number) return std::nullopt;
  std::memcpy(&number, bytes.data() + bytes.size() - sizeof number, sizeof number);
  bytes.remove_suffix(sizeof number);
  return number;
}

/// The length of the fields at the end of `bytes`, from which everything behind them is taken. Nothing if the
/// file is damaged.
std::optional<std::size_t> takeEnd(std::string_view& bytes) {
  const bool hasChecksum = bytes.ends_with(kEndMagic);
  if (!hasChecksum && !bytes.ends_with(kEarlierEndMagic)) return std::nullopt;
  bytes.remove_suffix(kEndMagic.size());
  if (hasChecksum) {
    const auto checksum = takeLastNumber(bytes);
    if (!checksum || *checksum != checksumOf(bytes)) return std::nullopt;
  }
  const auto size = takeLastNumber(bytes);
  if (!size || bytes.size() < kStateHead || *size > bytes.size() - kStateHead) return std::nullopt;
  return static_cast<std::size_t>(*size);
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
  appendNumber(bytes, files);
  bytes.append(reinterpret_cast<const char*>(state.data()), state.size());
  const std::string fields = namedFields(scene);
  bytes += fields;
  appendNumber(bytes, fields.size());
  appendNumber(bytes, checksumOf(bytes));
  bytes += kEndMagic;
  return writeFile(file, bytes);
}

Result<StateFile> StateFile::read(const std::string& file) {
  const Result<std::string> content = readPlainFile(file, kMostStateBytes);
  if (!content) return content.error();
  std::string_view bytes = content.value();
  const auto fault = [&](const char* what) { return Diagnostic{Severity::Error, {file, 0, 0}, what, {}}; };
  const bool begins = !bytes.empty() && kStateMagic.starts_with(bytes.substr(0, kStateMagic.size()));
  if (!begins) return fault("is no state; stadion hash SHOW --save-state FILE writes one");
  const auto fieldBytes = takeEnd(bytes);
  if (!fieldBytes) return fault("is damaged; stadion hash SHOW --save-state FILE writes it again");
  StateFile out;
  std::memcpy(&out.files_, bytes.data() + kStateMagic.size(), sizeof out.files_);
  out.fields_ = bytes.substr(bytes.size() - *fieldBytes);
  bytes.remove_suffix(*fieldBytes);
  out.state_.assign(bytes.begin() + kStateHead, bytes.end());
  return out;
}

std::optional<SavedStateDifference> StateFile::differenceFrom(Scene& scene) const {
  const std::string ours = namedFields(scene);
  if (!fields_.empty()) {
    const std::string here = frameOf(ours), there = frameOf(fields_);
    if (here != there) return SavedStateDifference{"the frame", here, there};
    if (files_ != SceneSnapshot::filesOf(scene))
      if (auto found = namedDifference(ours, fields_)) return found;
  }
  return savedStateDifference(scene, files_, state_);
}

}  // namespace stadion
