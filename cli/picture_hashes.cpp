#include "cli/picture_hashes.h"

#include "engine/state_hash.h"

#include <fmt/format.h>

namespace stadion {
namespace {

std::uint64_t hashOf(const Picture& picture) {
  StateHash hash;
  hash.add(picture.width), hash.add(picture.height);
  hash.add(std::string_view(reinterpret_cast<const char*>(picture.rgba.data()), picture.rgba.size()));
  return hash.value();
}

}  // namespace

PictureHashes::PictureHashes(OutputFolder& folder, std::vector<std::string> wallNames, bool further)
    : folder_(folder), wallNames_(std::move(wallNames)), mode_(further ? std::ios::app : std::ios::trunc) {}

std::optional<Diagnostic> PictureHashes::open() {
  for (const char* name : {kHashes, kTimes})
    if (auto wrong = folder_.note(name)) return wrong;
  hashes_.open(folder_.pathOf(kHashes), std::ios::out | mode_);
  times_.open(folder_.pathOf(kTimes), std::ios::out | mode_);
  return {};
}

std::optional<Diagnostic> PictureHashes::add(std::uint64_t frame, const std::vector<EyePictures>& walls,
                                             std::chrono::steady_clock::time_point shown) {
  if (!hashes_.is_open())
    if (auto wrong = open()) return wrong;
  std::string lines;
  for (std::size_t w = 0; w < walls.size(); ++w)
    for (std::size_t e = 0; e < walls[w].eyes.size(); ++e)
      lines += fmt::format("{} {} {} {:016x}\n", frame, wallNames_[w], eyeName(kEyes[e]),
                           hashOf(walls[w].eyes[e]));
  using Ns = std::chrono::nanoseconds;
  const auto at = std::chrono::duration_cast<Ns>(shown.time_since_epoch()).count();
  hashes_ << lines << std::flush;
  times_ << fmt::format("{} {}\n", frame, at) << std::flush;
  if (hashes_ && times_) return {};
  Diagnostic wrong;
  wrong.where.file = folder_.pathOf(hashes_ ? kTimes : kHashes), wrong.message = "cannot be written";
  return wrong;
}

}  // namespace stadion
