#include "show/output/picture_hashes.h"

#include "engine/core/state_hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace stadion {
namespace {

std::uint64_t hashOf(const Picture& picture) {
  StateHash hash;
  hash.add(picture.width);
  hash.add(picture.height);
  hash.add(std::string_view(reinterpret_cast<const char*>(picture.rgba.data()), picture.rgba.size()));
  return hash.value();
}

/// Cuts off what a run that was killed has left of a line: the next one would be written behind it.
void cutHalfLine(const std::string& file) {
  constexpr std::streamoff kLongestLine = 1 << 16;
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = in.tellg(), from = std::max<std::streamoff>(0, size - kLongestLine);
  if (!in || size <= 0) return;
  std::string end(static_cast<std::size_t>(size - from), '\0');
  in.seekg(from).read(end.data(), size - from);
  if (!in || end.ends_with('\n')) return;
  const std::size_t whole = end.rfind('\n') + 1;  // 0 if there is none
  std::error_code none;  // a file that cannot be cut cannot be written, which is reported
  std::filesystem::resize_file(file, static_cast<std::uintmax_t>(from) + whole, none);
}

}  // namespace

std::string hashLinesOf(std::uint64_t frame, const std::vector<EyePictures>& walls,
                        const std::vector<std::string>& wallNames) {
  std::string lines;
  for (std::size_t w = 0; w < walls.size(); ++w)
    for (std::size_t e = 0; e < walls[w].eyes.size(); ++e)
      lines +=
          fmt::format("{} {} {} {:016x}\n", frame, wallNames[w], pictureName(e), hashOf(walls[w].eyes[e]));
  return lines;
}

PictureHashes::PictureHashes(OutputFolder& folder, std::vector<std::string> wallNames, bool further)
    : folder_(folder), wallNames_(std::move(wallNames)), further_(further) {}

std::optional<Diagnostic> PictureHashes::open() {
  for (const char* name : {kHashes, kTimes})
    if (auto wrong = folder_.note(name)) return wrong;
  if (further_)
    for (const char* name : {kHashes, kTimes}) cutHalfLine(folder_.pathOf(name));
  const std::ios::openmode how = std::ios::out | (further_ ? std::ios::app : std::ios::trunc);
  hashes_.open(folder_.pathOf(kHashes), how);
  times_.open(folder_.pathOf(kTimes), how);
  return {};
}

std::optional<Diagnostic> PictureHashes::add(std::uint64_t frame, const std::vector<EyePictures>& walls,
                                             std::chrono::steady_clock::time_point shown) {
  if (!hashes_.is_open())
    if (auto wrong = open()) return wrong;
  const std::string lines = hashLinesOf(frame, walls, wallNames_);
  using Ns = std::chrono::nanoseconds;
  const auto at = std::chrono::duration_cast<Ns>(shown.time_since_epoch()).count();
  hashes_ << lines << std::flush;
  times_ << fmt::format("{} {}\n", frame, at) << std::flush;
  if (hashes_ && times_) return {};
  Diagnostic wrong;
  wrong.where.file = folder_.pathOf(hashes_ ? kTimes : kHashes);
  wrong.message = "cannot be written";
  return wrong;
}

}  // namespace stadion
