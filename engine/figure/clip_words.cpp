#include "engine/figure/clip_words.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <vector>

#include <fmt/format.h>

namespace stadion {
namespace {

constexpr double kMostSeconds = 1e6, kMostSpeed = 1000;

using Words = std::vector<std::string_view>;

Words split(std::string_view text) {
  Words words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t first = text.find_first_not_of(' ', at);
    if (first == std::string_view::npos) break;
    const std::size_t end = std::min(text.find(' ', first), text.size());
    words.push_back(text.substr(first, end - first));
    at = end;
  }
  return words;
}

std::optional<double> numberIn(std::string_view word, double least, double most) {
  double value = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (fault != std::errc() || end != word.data() + word.size() || !(value >= least && value <= most))
    return {};
  return value;
}

/// A clip, and the number of words of its name.
struct Found {
  std::uint32_t clip = 0;
  std::size_t words = 0;
};
/// A name may have blanks: the longest run of words that is a clip counts. Returns how many words it has.
std::optional<Found> clipIn(const Words& words, const Skeleton& skeleton) {
  for (std::size_t count = words.size(); count > 0; --count) {
    const std::string_view last = words[count - 1];
    const std::string_view name(words[0].data(),
                                static_cast<std::size_t>(last.data() + last.size() - words[0].data()));
    if (const auto clip = clipNamed(skeleton, name)) return Found{*clip, count};
  }
  return {};
}

std::string noSuchClip(std::string_view words, const Skeleton& skeleton) {
  if (skeleton.clips.empty()) return "its model has no clips";
  if (words.empty()) return fmt::format("no clip is named; there are {}", clipNames(skeleton));
  return fmt::format("\"{}\" begins with no clip of its model; there are {}", words, clipNames(skeleton));
}

ClipPlayer::Start startOf(std::uint32_t clip, const Skeleton& skeleton, ClipPlayer::Start start) {
  start.clip = clip;
  start.length = skeleton.clips[clip].length;
  return start;
}

/// An option with a number, and where it goes.
struct Option {
  std::string_view word;
  double least, most;
  void (*put)(double number, ClipPlayer::Start& start);
  bool ofLayers = false;  ///< alone
};
constexpr Option kOptions[] = {
    {"fade", 0, kMostSeconds,
     [](double number, ClipPlayer::Start& start) { start.fade = std::llround(number * 1e9); }},
    {"speed", -kMostSpeed, kMostSpeed, [](double number, ClipPlayer::Start& start) { start.speed = number; }},
    {"from", 0, kMostSeconds, [](double number, ClipPlayer::Start& start) { start.at = number; }},
    {"weight", 0, 1, [](double number, ClipPlayer::Start& start) { start.weight = number; }, true},
};

/// Reads one option. Returns how many words it has; 0 if there is a fault.
std::size_t readOption(std::span<const std::string_view> words, bool layer, ClipPlayer::Start& start,
                       std::string& fault) {
  if (words[0] == "once" || words[0] == "loop") {
    start.loop = words[0] == "loop";
    return 1;
  }
  const auto option = std::ranges::find(kOptions, words[0], &Option::word);
  if (option == std::end(kOptions) || (option->ofLayers && !layer)) {
    fault = fmt::format("\"{}\" is no option; use fade SECONDS, speed FACTOR, from SECONDS, {}once or loop",
                        words[0], layer ? "weight SHARE, " : "");
    return 0;
  }
  const auto number = words.size() > 1 ? numberIn(words[1], option->least, option->most) : std::nullopt;
  if (!number) {
    fault =
        fmt::format("\"{}\" needs a number from {} to {} after it", words[0], option->least, option->most);
    return 0;
  }
  option->put(*number, start);
  return 2;
}

ClipWords readStart(std::string_view text, const Skeleton& skeleton, const ClipPlayer::Start& standard,
                    bool layer) {
  const Words words = split(text);
  const auto found = clipIn(words, skeleton);
  if (!found) return {{}, noSuchClip(text, skeleton)};
  ClipPlayer::Start start = startOf(found->clip, skeleton, standard);
  for (std::size_t at = found->words; at < words.size();) {
    std::string fault;
    const std::size_t taken = readOption(std::span(words).subspan(at), layer, start, fault);
    if (taken == 0) return {{}, fault};
    at += taken;
  }
  if (start.at > start.length)
    return {{},
            fmt::format("the clip is {:.6g} s long, so it cannot begin at {:.6g} s", start.length, start.at)};
  return {start, {}};
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

std::optional<std::uint32_t> clipNamed(const Skeleton& skeleton, std::string_view name) {
  const auto at = std::ranges::find(skeleton.clips, name, &Clip::name);
  if (at == skeleton.clips.end()) return {};
  return static_cast<std::uint32_t>(at - skeleton.clips.begin());
}

std::string clipNames(const Skeleton& skeleton) {
  constexpr std::size_t kMost = 20;
  std::string names;
  for (std::size_t i = 0; i < std::min(kMost, skeleton.clips.size()); ++i)
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", skeleton.clips[i].name);
  if (skeleton.clips.size() > kMost) names += fmt::format(" and {} more", skeleton.clips.size() - kMost);
  return names;
}

std::string boneNames(const Skeleton& skeleton) {
  constexpr std::size_t kMost = 20;
  std::string names;
  std::size_t told = 0, left = 0;
  for (const Bone& bone : skeleton.bones) {
    if (bone.name.empty()) continue;
    if (told == kMost) {
      ++left;
      continue;
    }
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", bone.name);
    ++told;
  }
  return left > 0 ? fmt::format("{} and {} more", names, left) : names;
}

ClipWords readPlay(std::string_view text, const Skeleton& skeleton, const ClipPlayer::Start& standard) {
  return readStart(text, skeleton, standard, false);
}

ClipWords readLayer(std::string_view text, const Skeleton& skeleton, const ClipPlayer::Start& standard) {
  return readStart(text, skeleton, standard, true);
}

LayerWords readUnlayer(std::string_view text, const Skeleton& skeleton, const ClipPlayer::Start& standard) {
  const Words words = split(text);
  LayerWords read{{}, standard.fade, {}};
  const auto found = clipIn(words, skeleton);
  if (found) read.clip = found->clip;
  const std::size_t left = words.size() - (found ? found->words : 0);
  if (left == 0) return read;
  const std::string_view option = words[words.size() - left];
  if (!found && option != "fade") return {{}, 0, noSuchClip(text, skeleton)};
  const auto seconds = left == 2 ? numberIn(words.back(), 0, kMostSeconds) : std::nullopt;
  if (option != "fade" || !seconds) return {{}, 0, "after the clip comes nothing, or fade SECONDS"};
  read.fade = std::llround(*seconds * 1e9);
  return read;
}

MarkerWords readMarker(std::string_view text) {
  const std::size_t last = text.rfind(',');
  const std::size_t first = last == text.npos || last == 0 ? text.npos : text.rfind(',', last - 1);
  if (first == text.npos) return {};
  return {trimmed(text.substr(0, first)), trimmed(text.substr(last + 1)),
          numberIn(trimmed(text.substr(first + 1, last - first - 1)), 0, kMostSeconds)};
}

ClipWords readPose(std::string_view text, const Skeleton& skeleton) {
  Words words = split(text);
  const std::string_view last = words.empty() ? std::string_view() : words.back();
  const auto seconds = numberIn(last, 0, kMostSeconds);
  if (words.size() < 2 || !seconds)
    return {{}, "it needs a clip, and a time of it in seconds that is not negative"};
  words.pop_back();
  const auto found = clipIn(words, skeleton);
  if (!found || found->words < words.size()) return {{}, noSuchClip(text, skeleton)};
  ClipPlayer::Start still;
  still.speed = 0;
  still.loop = false;
  still = startOf(found->clip, skeleton, still);
  still.at = std::min(*seconds, still.length);
  return {still, {}};
}

}  // namespace stadion
