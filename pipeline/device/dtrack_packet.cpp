#include "pipeline/device/dtrack_packet.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace stadion {
namespace {

constexpr std::uint32_t kMostDevices = 1000;  ///< of a line; more are a damaged packet
constexpr std::uint32_t kMostButtons = 32, kMostControllers = 8;
constexpr double kMetre = 0.001;  ///< [m] of a millimetre

/// A line, read from left to right: numbers between blanks and brackets.
class LineReader {
public:
  explicit LineReader(std::string_view line) : left_(line) {}

  std::string_view word() {
    skipBlanks();
    const std::size_t end = std::min(left_.find_first_of(" \t\r[]"), left_.size());
    const std::string_view found = left_.substr(0, end);
    left_.remove_prefix(end);
    return found;
  }
  std::optional<double> number() {
    const std::string_view text = word();
    double value = 0;
    const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = wrong == std::errc{} && end == text.data() + text.size();
    return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
  }
  std::optional<std::uint32_t> count(std::uint32_t most) {
    const auto value = number();
    if (!value || *value < 0 || *value > most || *value != std::floor(*value)) return std::nullopt;
    return static_cast<std::uint32_t>(*value);
  }
  /// All numbers up to the closing bracket.
  bool group(std::vector<double>& numbers) {
    numbers.clear();
    if (!take('[')) return false;
    while (!take(']')) {
      const auto value = numbers.size() < kLongestGroup ? number() : std::nullopt;
      if (!value) return false;
      numbers.push_back(*value);
    }
    return true;
  }
  bool atEnd() {
    skipBlanks();
    return left_.empty();
  }

private:
  static constexpr std::size_t kLongestGroup = 64;

  void skipBlanks() { left_.remove_prefix(std::min(left_.find_first_not_of(" \t\r"), left_.size())); }
  bool take(char c) {
    skipBlanks();
    if (!left_.starts_with(c)) return false;
    left_.remove_prefix(1);
    return true;
  }

  std::string_view left_;
};

/// A matrix that is no rotation gives a quaternion of zero, which no tracker takes.
Quat rotationOf(const std::vector<double>& byColumns) {
  Mat3 m;
  std::copy_n(byColumns.begin(), 9, m.data());
  const bool rotates = (m.transpose() * m - Mat3::Identity()).norm() < 0.02 && m.determinant() > 0;
  return rotates ? Quat(m).normalized() : Quat(0, 0, 0, 0);
}

/// What the numbers of the first group mean.
struct Form {
  std::size_t numbers;          ///< in the first group
  bool flystick, buttonsFirst;  ///< buttonsFirst: in the first group, else in a group of their own
};
constexpr Form kBody{2, false, false}, kOldFlystick{3, true, true}, kFlystick{4, true, false};

bool isCount(double value, std::uint32_t most) {
  return value >= 0 && value <= most && value == std::floor(value);
}

/// Buttons in words of 32, of which the first counts, then controllers.
bool readControls(LineReader& in, const std::vector<double>& head, DTrackDevice& device) {
  std::vector<double> controls;
  if (!isCount(head[2], 256) || !isCount(head[3], 64) || !in.group(controls)) return false;
  const auto buttons = static_cast<std::uint32_t>(head[2]), controllers = static_cast<std::uint32_t>(head[3]);
  const std::size_t words = (buttons + 31) / 32;
  if (controls.size() != words + controllers) return false;
  device.buttonCount = std::min(buttons, kMostButtons);
  if (words > 0) {
    if (!isCount(controls[0], 0xffffffff)) return false;
    device.buttons = static_cast<std::uint32_t>(controls[0]);
  }
  for (std::size_t i = words; i < controls.size() && device.controllers.size() < kMostControllers; ++i)
    device.controllers.push_back(std::clamp(controls[i], -1.0, 1.0));
  return true;
}

bool readDevice(LineReader& in, const Form& form, DTrackDevice& device) {
  std::vector<double> head, place, turn;
  if (!in.group(head) || head.size() != form.numbers || !in.group(place) || place.size() != 6 ||
      !in.group(turn) || turn.size() != 9 || !isCount(head[0], kMostDevices))
    return false;
  device.number = static_cast<std::uint32_t>(head[0]);
  device.flystick = form.flystick;
  if (head[1] >= 0) device.X_SD = Pose{kMetre * Vec3(place[0], place[1], place[2]), rotationOf(turn)};
  if (form.buttonsFirst) {
    if (!isCount(head[2], 0xffffffff)) return false;
    device.buttons = static_cast<std::uint32_t>(head[2]);
    device.buttonCount = 8;
  }
  return !form.flystick || form.buttonsFirst || readControls(in, head, device);
}

bool readDevices(LineReader& in, const Form& form, DTrackPacket& packet) {
  if (form.flystick && !form.buttonsFirst && !in.count(kMostDevices)) return false;  // the calibrated ones
  const auto count = in.count(kMostDevices);
  if (!count) return false;
  for (std::uint32_t i = 0; i < *count; ++i) {
    DTrackDevice device;
    if (!readDevice(in, form, device)) return false;
    packet.devices.push_back(std::move(device));
  }
  return in.atEnd();
}

/// Returns false if the line is damaged. `known`: it is one of DTrack's.
bool readLine(std::string_view text, DTrackPacket& packet, bool& known) {
  LineReader in(text);
  const std::string_view kind = in.word();
  known |= kind == "fr" || kind == "ts" || kind == "6d" || kind == "6df" || kind == "6df2" || kind == "6dcal";
  if (kind == "6d") return readDevices(in, kBody, packet);
  if (kind == "6df") return readDevices(in, kOldFlystick, packet);
  if (kind == "6df2") return readDevices(in, kFlystick, packet);
  if (kind != "ts") return true;
  packet.time = in.number();
  return packet.time && *packet.time >= 0 && *packet.time < 1e6 && in.atEnd();
}

}  // namespace

std::optional<DTrackPacket> readDTrack(std::string_view text) {
  DTrackPacket packet;
  bool known = false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (!readLine(text.substr(0, end), packet, known)) return std::nullopt;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return known ? std::optional(std::move(packet)) : std::nullopt;
}

}  // namespace stadion
