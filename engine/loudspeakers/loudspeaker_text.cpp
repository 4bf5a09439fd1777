#include "engine/loudspeakers/loudspeaker_text.h"

#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

#include <fmt/format.h>

#include <cmath>

namespace stadion {
namespace {

constexpr double kPerDecibel = 0.11512925464970229;  ///< natural logarithm of the amplitude for 1 dB

}  // namespace

constexpr StatementField<LoudspeakerReader> LoudspeakerReader::kFields[4] = {
    {"channel", &LoudspeakerReader::channel},
    {"delay", &LoudspeakerReader::delay},
    {"gain", &LoudspeakerReader::gain},
    {"subwoofer", &LoudspeakerReader::subwoofer}};

constexpr StatementField<LoudspeakerReader> LoudspeakerReader::kSoundFields[2] = {
    {"card", &LoudspeakerReader::card}, {"align", &LoudspeakerReader::align}};

bool LoudspeakerReader::channel() {
  const auto number = in_.count("the channel", 1, LoudspeakerSet::kMostChannels);
  if (number) read_.channel = static_cast<std::uint32_t>(*number) - 1;
  return number.has_value();
}

bool LoudspeakerReader::delay() {
  const auto ms = in_.number("the delay", 0, 1000, " ms");
  if (ms) read_.delay = 1e-3 * *ms;
  return ms.has_value();
}

bool LoudspeakerReader::gain() {
  const auto decibels = in_.number("the gain", -60, 12, " dB");
  if (decibels) read_.gain = det::exp(kPerDecibel * *decibels);
  return decibels.has_value();
}

bool LoudspeakerReader::subwoofer() {
  const auto hertz = in_.number("the crossover frequency", 20, 500, " Hz");
  if (hertz) read_.crossover = *hertz;
  return hertz.has_value();
}

void LoudspeakerReader::loudspeaker() {
  const auto name = in_.name("the loudspeaker's name", "a loudspeaker");
  if (!name) return;
  const Word nameWord = in_.last();
  read_ = {};
  read_.name = *name;
  read_.line = in_.line();
  read_.column = nameWord.column;
  read_.excerpt = in_.excerpt();
  if (!point_("the loudspeaker", read_.place)) return;
  if (!hall_.all.empty()) read_.channel = hall_.all.back().channel + 1;
  if (!in_.fields(*this, kFields, "a loudspeaker")) return;
  if (hall_.all.size() == LoudspeakerSet::kMost) {
    in_.error(in_.keyword(),
              fmt::format("a file has at most {} loudspeakers; delete this line and those after it",
                          LoudspeakerSet::kMost));
    tooMany_ = true;
    return;
  }
  if (read_.channel >= LoudspeakerSet::kMostChannels)
    return in_.error(nameWord,
                     fmt::format("loudspeaker \"{}\" would have channel {}, and a sound output has at "
                                 "most {}; add: channel N",
                                 *name, read_.channel + 1, LoudspeakerSet::kMostChannels));
  for (const Loudspeaker& other : hall_.all)
    if (other.name == *name)
      return in_.error(nameWord,
                       fmt::format("there is a loudspeaker \"{}\" already, on line {}; give this one "
                                   "another name",
                                   *name, other.line));
  hall_.all.push_back(std::move(read_));
}

bool LoudspeakerReader::card() {
  const Word* name = in_.word("the sound card");
  if (name) hall_.card = std::string(name->text.substr(0, 1000));
  return name != nullptr;
}

bool LoudspeakerReader::align() {
  static constexpr std::string_view kStates[] = {"on", "off"};
  const auto state = in_.choice("on or off", kStates);
  if (state) hall_.aligned = *state == 0;
  return state.has_value();
}

void LoudspeakerReader::sound() {
  if (!in_.more())
    return in_.errorAtEnd("sound says nothing; add: card NAME, or align off, or leave the line out");
  in_.fields(*this, kSoundFields, "the sound output");
}

std::string formatLoudspeakers(const LoudspeakerSet& hall, double metresPerUnit) {
  std::string text;
  if (!hall.card.empty() || !hall.aligned) {
    text += "sound";
    if (!hall.card.empty()) text += "  card " + hall.card;
    if (!hall.aligned) text += "  align off";
    text += '\n';
  }
  for (const Loudspeaker& s : hall.all) {
    const Vec3 p = s.place / metresPerUnit;
    text += fmt::format("loudspeaker {}  {} {} {}  channel {}", s.name, p.x(), p.y(), p.z(), s.channel + 1);
    if (s.delay > 0) text += fmt::format("  delay {}", 1e3 * s.delay);
    if (s.gain != 1) text += fmt::format("  gain {}", det::log(s.gain) / kPerDecibel);
    if (s.isSubwoofer()) text += fmt::format("  subwoofer {}", s.crossover);
    text += '\n';
  }
  return text;
}

std::string listLoudspeakers(const LoudspeakerSet& hall) {
  const std::vector<SoundAlignment> aligned = soundAlignment(hall);
  std::string text;
  for (std::size_t i = 0; i < hall.all.size(); ++i) {
    const Loudspeaker& s = hall.all[i];
    const Vec3 d = s.place - hall.ear;
    const double azimuth = det::atan2(d.x(), d.y()) / kDegree,
                 elevation = det::atan2(d.z(), std::sqrt(d.x() * d.x() + d.y() * d.y())) / kDegree;
    text += fmt::format(
        " {:<14} channel {:>2}, {:.2f} m at azimuth {:.0f}, elevation {:.0f} degrees, delay {:.2f} ms, "
        "gain {:.1f} dB{}\n",
        s.name, s.channel + 1, d.norm(), azimuth, elevation, 1e3 * aligned[i].delay,
        det::log(aligned[i].gain) / kPerDecibel,
        s.isSubwoofer() ? fmt::format(", below {:g} Hz", s.crossover) : std::string());
  }
  return text;
}

}  // namespace stadion
