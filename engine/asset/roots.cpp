#include "engine/asset/roots.h"

#include "engine/plain_text/suggestion.h"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace stadion {
namespace {

namespace fs = std::filesystem;

/// Returns what is wrong with the name itself; empty if nothing is.
std::string faultOf(const std::string& name) {
  if (name.empty()) return "an asset needs a file name";
  if (name.find('\0') != std::string::npos) return "an asset's file name must not contain a NUL character";
  if (name.size() > 4096) return "the asset's file name is too long";
  const fs::path path(name);
  if (path.is_absolute())
    return "\"" + name + "\" is an absolute path; name assets relative to the asset folders";
  if (std::any_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".."; }))
    return "\"" + name + "\" leads out of the asset folders; use no \"..\" in asset names";
  return {};
}

// File names below a root, for suggestions; a large tree is not walked to its end.
void collect(const fs::path& root, std::vector<std::string>& names) {
  constexpr int kDeepest = 4;
  constexpr std::size_t kMost = 5000;
  std::error_code error;
  for (fs::recursive_directory_iterator at(root, fs::directory_options::skip_permission_denied, error), end;
       !error && at != end && names.size() < kMost; at.increment(error)) {
    if (at.depth() >= kDeepest) at.disable_recursion_pending();
    std::error_code ignored;
    if (at->is_regular_file(ignored)) names.push_back(at->path().lexically_relative(root).string());
  }
}

}  // namespace

AssetRoots AssetRoots::ofScript(const fs::path& script) {
  AssetRoots roots;
  const fs::path folder = script.has_parent_path() ? script.parent_path() : fs::path(".");
  roots.add(folder);
  roots.add((folder / "../assets").lexically_normal());
  return roots;
}

bool AssetRoots::add(const fs::path& folder) {
  FileDescriptor open(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!open) return false;
  roots_.push_back({std::move(open), folder});
  return true;
}

Result<AssetRoots::Found> AssetRoots::open(const std::string& name) const {
  if (const std::string fault = faultOf(name); !fault.empty()) return Result<Found>::failure(fault);
  for (const Root& root : roots_) {
    FileDescriptor file = openBeneath(root.folder.get(), name);
    const std::string path = (root.path / name).lexically_normal().string();
    if (file) return Found{root.folder.get(), std::move(file), path};
    if (errno == ENOENT || errno == ENOTDIR) continue;
    const std::string why = errno == EXDEV    ? "leads out of the asset folder through a symbolic link"
                            : errno == EINVAL ? "is not a regular file"
                                              : std::string("cannot be opened: ") + std::strerror(errno);
    return Result<Found>::failure("\"" + path + "\" " + why);
  }
  return Result<Found>::failure(missing(name));
}

std::string AssetRoots::missing(const std::string& name) const {
  std::string text = "there is no asset \"" + name + "\"";
  std::vector<std::string> known;
  for (std::size_t i = 0; i < roots_.size(); ++i) {
    text += i == 0 ? "; looked in " : i + 1 == roots_.size() ? " and " : ", ";
    text += roots_[i].path.string();
    collect(roots_[i].path, known);
  }
  if (const auto near = closest(name, known)) text += "; " + didYouMeanOne(name, *near);
  return text;
}

}  // namespace stadion
