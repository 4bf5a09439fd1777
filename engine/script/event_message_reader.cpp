#include "engine/script/event_message_reader.h"

#include "engine/base/diagnostic.h"
#include "engine/plain_text/suggestion.h"
#include "engine/script/attribute_text.h"
#include "engine/text/text_mesh.h"
#include "engine/unicode/characters.h"

#include <cmath>

#include <fmt/format.h>

namespace stadion {

namespace {

constexpr double kLongestDelay = 1e6;  // [s]
constexpr std::size_t kLongestName = 255;

using Failure = std::optional<ValueError>;

std::vector<std::string> namesOf(std::span<const EventSpec> events) {
  std::vector<std::string> words;
  for (const EventSpec& row : events) words.emplace_back(row.event.name());
  return words;
}

std::vector<std::string> namesOfCommands(const NodeRegistry& types) {
  std::vector<std::string> words;
  for (const CommandSpec* command : types.commands()) words.emplace_back(command->name);
  return words;
}

/// Up to the next comma, which "\," is not: that is one in words. `more`: there was one.
Piece takeCommand(std::string_view& rest, std::size_t& offset, bool& more) {
  std::size_t end = rest.find(',');
  while (end != rest.npos && end > 0 && rest[end - 1] == '\\') end = rest.find(',', end + 1);
  more = end != rest.npos;
  std::string_view part = rest.substr(0, end);
  rest.remove_prefix(more ? end + 1 : rest.size());
  const Piece command = takeUntil('\0', part, offset);
  offset += more;
  return command;
}

/// What is wrong with a part of the message, told in its place and with the part's text before it.
Failure named(const Piece& piece, Failure fault) {
  if (!fault) return fault;
  return ValueError{piece.offset + fault->offset,
                    fmt::format("\"{}\" {}", shortened(piece.text), fault->message)};
}

/// A character of a part that cannot be seen.
Failure hiddenIn(const Piece& piece) {
  auto fault = hiddenCharacter(piece.text);
  if (fault) fault->offset += piece.offset;
  return fault;
}

/// The word after an event that has one.
Failure readEventWord(const EventSpec& spec, std::string_view& rest, std::size_t& offset,
                      ReadMessage& message) {
  const Piece word = takeUntil('\0', rest, offset);
  if (word.text.empty())
    return ValueError{word.offset, fmt::format("\"{0}\" must be followed by a word: {0} {1}",
                                               spec.event.name(), spec.word)};
  message.event = spec.event.with(word.text);
  return named(word, faultOfName(word.text));
}

Failure readEvent(const Piece& piece, const RegisteredType& sender, const NodeRegistry& types,
                  ReadMessage& message) {
  if (auto hidden = hiddenIn(piece)) return hidden;
  const auto events = sender.type().events;
  if (events.empty()) return ValueError{piece.offset, fmt::format("{} posts no events", sender.name())};
  std::string_view rest = piece.text;
  std::size_t offset = piece.offset;
  const Piece name = takeWord(rest, offset);
  for (const EventSpec& own : events) {
    if (own.event.name() != (own.word.empty() ? piece.text : name.text)) continue;
    message.event = own.event;
    return own.word.empty() ? std::nullopt : readEventWord(own, rest, offset, message);
  }
  const std::string ours = joinWithOr(namesOf(events));
  if (types.isEvent(piece.text))
    return ValueError{piece.offset,
                      fmt::format("{} posts no \"{}\", only {}", sender.name(), piece.text, ours)};
  return ValueError{piece.offset,
                    fmt::format("\"{}\" is not an event of {}{}", shortened(piece.text), sender.name(),
                                didYouMean(piece.text, namesOf(events), "; it posts " + ours))};
}

Failure readPart(std::string_view& rest, std::size_t& offset, ReadMessage& message) {
  const Piece word = takeWord(rest, offset);
  if (auto hidden = hiddenIn(word)) return hidden;
  for (std::size_t i = 0; i < kAttachPartNames.size(); ++i) {
    if (kAttachPartNames[i] != word.text) continue;
    message.part = static_cast<AttachPart>(i);
    return std::nullopt;
  }
  return ValueError{word.offset,
                    fmt::format("\"attach\" must be followed by all, position or orientation, not {}",
                                word.text.empty() ? "nothing" : fmt::format("\"{}\"", shortened(word.text)))};
}

Failure readTracker(std::string_view& rest, std::size_t& offset, ReadMessage& message) {
  message.tracker = takeWord(rest, offset);
  if (message.tracker.text.empty()) return std::nullopt;
  return named(message.tracker, faultOfName(message.tracker.text));
}

Failure readField(std::string_view& rest, std::size_t& offset, ReadMessage& message) {
  message.field = takeWord(rest, offset);
  const std::string_view name = message.field.text;
  if (name.empty())
    return ValueError{
        message.field.offset,
        fmt::format("\"{}\" must be followed by the name of a force field", message.spec->name)};
  return named(message.field, faultOfReference(name));
}

Failure readWords(std::string_view& rest, std::size_t& offset, ReadMessage& message) {
  message.words = takeUntil('\0', rest, offset);  // the whole rest
  if (message.words.text.size() <= kLongestWords) return std::nullopt;
  return ValueError{message.words.offset,
                    fmt::format("\"{}\" takes {} bytes at most, not {}", message.spec->name, kLongestWords,
                                message.words.text.size())};
}

/// So many numbers from 0 to 1, with blanks between them.
Failure readShares(std::string_view& rest, std::size_t& offset, std::size_t count, ReadMessage& message) {
  const std::string what = fmt::format("\"{}\"", message.spec->name);
  const std::string form =
      count == 3 ? "followed by red, green and blue, with blanks between them" : "followed by one number";
  message.words = takeUntil('\0', rest, offset);
  NumberList numbers;
  auto failure = readNumbers(message.words.text, numbers, what, form);
  if (failure) {
    failure->offset += message.words.offset;
    return failure;
  }
  if (numbers.count != count)
    return ValueError{message.words.offset,
                      fmt::format("{} must be {}, not by {}", what, form,
                                  numbers.count == 0   ? "nothing"
                                  : numbers.count == 1 ? "one number"
                                                       : fmt::format("{} numbers", numbers.count))};
  for (std::size_t i = 0; i < count; ++i)
    if (numbers.value[i] < 0 || numbers.value[i] > 1)
      return ValueError{message.words.offset + numbers.offset[i],
                        fmt::format("{} takes numbers from 0 to 1, not {}", what, numbers.value[i])};
  return std::nullopt;
}

/// A number, or "NUMBER fade SECONDS".
Failure readFaded(std::string_view& rest, std::size_t& offset, ReadMessage& message) {
  message.words = takeUntil('\0', rest, offset);
  std::string_view left = message.words.text;
  std::size_t at = message.words.offset;
  const Piece number = takeWord(left, at), word = takeWord(left, at), time = takeWord(left, at);
  const auto readOne = [&](const Piece& piece, const std::string& what, NumberList& numbers) -> Failure {
    auto failure = readNumbers(piece.text, numbers, what, "one number");
    if (!failure && numbers.count != 1)
      failure = ValueError{0, fmt::format("{} must be followed by one number", what)};
    if (failure) failure->offset += piece.offset;
    return failure;
  };
  NumberList numbers;
  if (auto failure = readOne(number, fmt::format("\"{}\"", message.spec->name), numbers)) return failure;
  constexpr double kMost = 1e6;
  if (std::abs(numbers.value[0]) > kMost)
    return ValueError{number.offset, fmt::format("\"{}\" is beyond all limits", number.text)};
  if (word.text.empty()) return std::nullopt;
  if (word.text != "fade")
    return ValueError{word.offset, fmt::format("\"{}\" is too much: the command is \"{}\"",
                                               shortened(word.text), message.spec->form)};
  if (auto failure = readOne(time, "\"fade\"", numbers)) return failure;
  if (!(numbers.value[0] >= 0 && numbers.value[0] <= kLongestDelay))
    return ValueError{time.offset,
                      fmt::format("a fade takes from 0 to {} s, not {}", kLongestDelay, numbers.value[0])};
  const Piece extra = takeWord(left, at);
  if (!extra.text.empty())
    return ValueError{extra.offset, fmt::format("\"{}\" is too much: the command is \"{}\"",
                                                shortened(extra.text), message.spec->form)};
  return std::nullopt;
}

Failure readArguments(std::string_view& rest, std::size_t& offset, ReadMessage& message) {
  switch (message.spec->argument) {
  case ArgumentKind::None: return std::nullopt;
  case ArgumentKind::Field: return readField(rest, offset, message);
  case ArgumentKind::Tracker: return readTracker(rest, offset, message);
  case ArgumentKind::Words: return readWords(rest, offset, message);
  case ArgumentKind::Colour: return readShares(rest, offset, 3, message);
  case ArgumentKind::Share: return readShares(rest, offset, 1, message);
  case ArgumentKind::Faded: return readFaded(rest, offset, message);
  case ArgumentKind::PartAndTracker:
    if (auto failure = readPart(rest, offset, message)) return failure;
    return readTracker(rest, offset, message);
  }
  return std::nullopt;
}

Failure readCommand(const Piece& piece, const NodeRegistry& types, ReadMessage& message) {
  std::string_view rest = piece.text;
  std::size_t offset = piece.offset;
  const Piece word = takeWord(rest, offset);
  if (auto hidden = hiddenIn(word)) return hidden;
  message.spec = types.command(word.text);
  if (message.spec == nullptr)
    return ValueError{word.offset, fmt::format("\"{}\" is not a command{}", shortened(word.text),
                                               didYouMean(word.text, namesOfCommands(types)))};
  if (auto failure = readArguments(rest, offset, message)) return failure;
  const Piece extra = takeWord(rest, offset);
  if (auto hidden = hiddenIn(extra)) return hidden;
  if (!extra.text.empty())
    return ValueError{extra.offset, fmt::format("\"{}\" is too much: the command is \"{}\"",
                                                shortened(extra.text), message.spec->form)};
  return std::nullopt;
}

/// A number of seconds from 0 to kLongestDelay, called `what` in messages.
Failure readTime(const Piece& piece, std::string_view what, double& seconds) {
  NumberList numbers;
  const std::string called = fmt::format("the {}", what);
  if (auto failure = readNumbers(piece.text, numbers, called, "a number of seconds")) {
    failure->offset += piece.offset;
    return failure;
  }
  if (numbers.count != 1) return ValueError{piece.offset, called + " must be one number of seconds"};
  seconds = numbers.value[0];
  if (seconds < 0 || seconds > kLongestDelay)
    return ValueError{piece.offset,
                      fmt::format("{} must be from 0 to {} s, not {}", called, kLongestDelay, seconds)};
  return std::nullopt;
}

Failure readDelay(const Piece& piece, ReadMessage& message) {
  double seconds = 0;
  if (auto failure = readTime(piece, "delay", seconds)) return failure;
  message.delay = fromSeconds(seconds);
  return std::nullopt;
}

Failure readLatency(const Piece& piece, ReadMessage& message) {
  double seconds = 0;
  if (auto failure = readTime(piece, "latency", seconds)) return failure;
  message.latency = fromSeconds(seconds);
  if (message.latency == 0)
    return ValueError{piece.offset, "a latency of 0 fixes nothing; state at least the time of a frame at the "
                                    "lowest frame rate, such as 0.04, or leave it out"};
  return std::nullopt;
}

/// What may follow the command as `word=value`. A new option of messages is a row here.
struct Option {
  std::string_view word;
  Failure (*read)(const Piece& value, ReadMessage& message);
};
constexpr Option kOptions[] = {{"delay", readDelay}, {"latency", readLatency}};

const Option* optionNamed(std::string_view word) {
  for (const Option& option : kOptions)
    if (option.word == word) return &option;
  return nullptr;
}

/// One part after the command; `seen` has a bit for each option that was given.
Failure readOption(const Piece& piece, unsigned& seen, ReadMessage& message) {
  if (auto hidden = hiddenIn(piece)) return hidden;
  std::string_view rest = piece.text;
  std::size_t offset = piece.offset;
  const bool named = rest.find('=') != rest.npos;
  const Piece word = named ? takeUntil('=', rest, offset) : Piece{"delay", offset};
  const Option* option = optionNamed(word.text);
  if (option == nullptr)
    return ValueError{word.offset,
                      fmt::format("\"{}\" is not an option of an eventmessage{}", shortened(word.text),
                                  didYouMean(word.text, {"delay", "latency"}))};
  const unsigned bit = 1U << (option - kOptions);
  if ((seen & bit) != 0) return ValueError{piece.offset, fmt::format("the {} is given twice", option->word)};
  seen |= bit;
  const Piece value = takeUntil(',', rest, offset);
  if (value.text.empty()) return ValueError{piece.offset, fmt::format("the {} is missing", option->word)};
  return option->read(value, message);
}

Failure missing(std::size_t offset, const char* what) {
  return ValueError{offset,
                    fmt::format("eventmessage must be \"event, target, command [arguments] [, delay]\": "
                                "the {} is missing",
                                what)};
}

}  // namespace

std::vector<ValueError> readEventMessage(std::string_view text, const RegisteredType& sender,
                                         const NodeRegistry& types, ReadMessage& message) {
  std::vector<ValueError> faults;
  const auto note = [&](Failure failure) {
    if (failure) faults.push_back(std::move(*failure));
  };
  std::string_view rest = text;
  std::size_t offset = 0;
  const Piece event = takeUntil(',', rest, offset);
  note(event.text.empty() ? missing(0, "event") : readEvent(event, sender, types, message));
  message.target = takeUntil(',', rest, offset);
  if (message.target.text.empty()) {
    note(missing(message.target.offset, "target"));
    return faults;
  }
  note(named(message.target, faultOfReference(message.target.text)));
  bool more = false;
  message.command = takeCommand(rest, offset, more);
  if (message.command.text.empty()) {
    note(missing(message.command.offset, "command"));
    return faults;
  }
  note(readCommand(message.command, types, message));

  unsigned seen = 0;
  for (; more; more = text[offset - 1] == ',') {
    const Piece option = takeUntil(',', rest, offset);
    auto failure = readOption(option, seen, message);
    if (!failure) continue;
    if (faults.empty() && message.spec != nullptr && message.spec->argument == ArgumentKind::Words)
      failure->message += R"(; a comma in words is written "\,")";
    note(std::move(failure));
    break;  // an empty part is a failure, so this ends
  }
  return faults;
}

std::optional<ValueError> faultOfName(std::string_view name) {
  if (name.empty()) return ValueError{0, "is empty, which is not a name"};
  if (name.size() > kLongestName) return ValueError{0, "is longer than any name may be"};
  if (const auto at = unicode::hiddenIn(name))
    return ValueError{*at, fmt::format("has {}, which cannot be seen; leave it out",
                                       unicode::nameOfFirst(name.substr(*at)))};
  for (const char c : name)
    if (static_cast<unsigned char>(c) <= 0x20 ||
        std::string_view(",/=()#'\"").find(c) != std::string_view::npos)
      return ValueError{0, "is not a name: one word without blanks and without , / = ( ) # or quotes"};
  return std::nullopt;
}

std::optional<ValueError> faultOfReference(std::string_view name) {
  std::size_t start = 0;
  while (true) {
    const std::size_t end = std::min(name.find('/', start), name.size());
    if (auto fault = faultOfName(name.substr(start, end - start))) {
      fault->offset += start;
      return fault;
    }
    if (end == name.size()) return std::nullopt;
    start = end + 1;
  }
}

}  // namespace stadion
