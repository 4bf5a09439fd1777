#pragma once
/// The words of a figure's commands: which clip, and how it is played.
///
/// Threads  pure.

#include "engine/figure/clip_player.h"
#include "engine/figure/skeleton.h"

#include <optional>
#include <string>
#include <string_view>

namespace stadion {

/// The number of a clip; nothing if there is none of this name.
std::optional<std::uint32_t> clipNamed(const Skeleton& skeleton, std::string_view name);
/// `"run", "throw"`: the clips that there are.
std::string clipNames(const Skeleton& skeleton);

/// The start that a command asks for, or a sentence about its fault.
struct ClipWords {
  std::optional<ClipPlayer::Start> start{};
  std::string fault{};
};

/// `CLIP [fade SECONDS] [speed FACTOR] [from SECONDS] [once|loop]`. `standard` has what is not stated.
ClipWords readPlay(std::string_view words, const Skeleton& skeleton, const ClipPlayer::Start& standard);
/// `CLIP SECONDS`: stands still at a time of the clip.
ClipWords readPose(std::string_view words, const Skeleton& skeleton);

}  // namespace stadion
