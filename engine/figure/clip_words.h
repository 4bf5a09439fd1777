#pragma once
/// The words of a figure's commands and markers: which clip, and how it is played.
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
/// Likewise the bones with names.
std::string boneNames(const Skeleton& skeleton);

/// The start that a command asks for, or a sentence about its fault.
struct ClipWords {
  std::optional<ClipPlayer::Start> start{};
  std::string fault{};
};

/// `CLIP [fade SECONDS] [speed FACTOR] [from SECONDS] [once|loop]`. `standard` has what is not stated.
ClipWords readPlay(std::string_view words, const Skeleton& skeleton, const ClipPlayer::Start& standard);
/// Likewise with [weight SHARE]: a layer.
ClipWords readLayer(std::string_view words, const Skeleton& skeleton, const ClipPlayer::Start& standard);
/// `[CLIP] [fade SECONDS]`: which layers go; without a clip, all.
struct LayerWords {
  std::optional<std::uint32_t> clip{};
  Nanoseconds fade = 0;
  std::string fault{};
};
LayerWords readUnlayer(std::string_view words, const Skeleton& skeleton, const ClipPlayer::Start& standard);
/// `CLIP, SECONDS, NAME`: a marker. The parts may be empty; `seconds`: nothing if it is no time.
struct MarkerWords {
  std::string_view clip{}, name{};
  std::optional<double> seconds{};
};
MarkerWords readMarker(std::string_view words);
/// `CLIP SECONDS`: stands still at a time of the clip.
ClipWords readPose(std::string_view words, const Skeleton& skeleton);

}  // namespace stadion
