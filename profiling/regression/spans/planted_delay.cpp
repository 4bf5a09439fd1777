#include "profiling/regression/spans/planted_delay.h"

#include <charconv>
#include <chrono>
#include <ctime>
#include <string_view>
#include <thread>
#include <unistd.h>

namespace stadion::regression {

namespace {

/// Takes a whole number from the front of the text.
template <class Number>
bool takeNumber(std::string_view& text, Number& number) {
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (problem != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

bool takeWord(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

bool parseAmount(std::string_view text, PlantedDelay& planted) {
  planted.asleep = takeWord(text, "sleep");
  if (!takeNumber(text, planted.iterations)) return false;
  if (takeWord(text, "ms")) {
    planted.milliseconds = static_cast<std::uint32_t>(planted.iterations);
    planted.iterations = 0;
  } else if (planted.asleep)
    return false;
  planted.atRandom = takeWord(text, "~");
  if (planted.atRandom || takeWord(text, "/")) {
    if (!takeNumber(text, planted.every) || planted.every == 0) return false;
    if (!planted.atRandom && takeWord(text, "+") && !takeNumber(text, planted.first)) return false;
  }
  return text.empty();
}

}  // namespace

std::optional<PlantedDelay> PlantedDelay::parse(const std::string& text) {
  const std::size_t colon = text.find(':'), equals = text.rfind('=');
  if (colon == text.npos || equals == text.npos || equals < colon) return std::nullopt;
  const std::string where = text.substr(0, colon);
  PlantedDelay planted;
  planted.name = text.substr(colon + 1, equals - colon - 1);
  if (planted.name.empty() != (where == "frame") ||
      !parseAmount(std::string_view(text).substr(equals + 1), planted))
    return std::nullopt;
  if (where == "simulate")
    planted.where = Where::Simulate;
  else if (where == "draw")
    planted.where = Where::Draw;
  else if (where == "frame")
    planted.where = Where::Frame;
  else if (where != "cull")
    return std::nullopt;
  return planted;
}

bool PlantedDelay::isIn(std::uint64_t frame) const {
  if (!atRandom) return frame >= first && (frame - first) % every == 0;
  std::uint64_t x = frame ^ (static_cast<std::uint64_t>(getpid()) << 32);
  x = (x ^ (x >> 31)) * 0x9E3779B97F4A7C15ULL;  // mixed, so that every run chooses other frames
  x = (x ^ (x >> 29)) * 0xBF58476D1CE4E5B9ULL;
  return (x >> 32) % every == 0;
}

void PlantedDelay::spend() const {
  if (asleep) return std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  if (milliseconds == 0) return burn(iterations);
  const std::uint64_t end = threadNanoseconds() + std::uint64_t{milliseconds} * 1'000'000;
  while (threadNanoseconds() < end) burn(1000);
}

// A chain of multiplications: each needs the previous result, so no processor runs several at a time.
void burn(std::uint64_t iterations) {
  std::uint64_t x = 1;
  for (std::uint64_t i = 0; i < iterations; ++i) x = x * 6364136223846793005ULL + 1442695040888963407ULL;
  volatile std::uint64_t kept = x;
  (void)kept;
}

std::uint64_t threadNanoseconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<std::uint64_t>(t.tv_sec) * 1'000'000'000 + static_cast<std::uint64_t>(t.tv_nsec);
}

}  // namespace stadion::regression
