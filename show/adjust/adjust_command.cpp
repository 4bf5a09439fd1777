#include "show/adjust/adjust_command.h"

#include "engine/display/projector.h"
#include "engine/plain_text/statement_reader.h"

#include <utility>

namespace stadion {
namespace {

using Does = AdjustCommand::Kind;

constexpr double kMostMove = 10000;  ///< [pixels]
constexpr std::string_view kEdgeWords[] = {"left", "right", "top", "bottom"};

AdjustCommand moveBy(double right, double down) {
  return {.kind = Does::Move, .right = right, .down = down};
}

class AdjustReader {
public:
  explicit AdjustReader(std::string_view line) : in_(line, "the command", findings_) {}

  AdjustWords run() {
    if (!in_.next()) return {};
    in_.read(*this, kStatements);
    for (const Diagnostic& d : findings_.all())
      if (d.severity == Severity::Error) return {std::nullopt, d.message};
    return {command_, {}};
  }

private:
  static const Statement<AdjustReader> kStatements[14];

  void plain(Does kind) {
    if (in_.finished()) command_.kind = kind;
  }
  void next() { plain(Does::Next); }
  void previous() { plain(Does::Previous); }
  void undo() { plain(Does::Undo); }
  void redo() { plain(Does::Redo); }
  void save() { plain(Does::Save); }
  void quit() { plain(Does::Quit); }
  void show() { plain(Does::Show); }
  void projector() {
    const Word* name = in_.word("the projector's name");
    if (!name || !in_.finished()) return;
    command_.kind = Does::Projector;
    command_.name = name->text;
  }
  void pin() {
    const auto number = in_.count("the number of the pin", 1, 4);
    if (!number || !in_.finished()) return;
    command_.kind = Does::Pin;
    command_.number = *number - 1;
  }
  void edge() {
    const auto which = in_.choice("an edge", kEdgeWords);
    if (!which || !in_.finished()) return;
    command_.kind = Does::Edge;
    command_.number = *which;
  }
  void move(double right, double down) {
    const auto pixels =
        in_.more() ? in_.number("the pixels", -kMostMove, kMostMove) : std::optional<double>(1.0);
    if (pixels && in_.finished()) command_ = moveBy(right * *pixels, down * *pixels);
  }
  void left() { move(-1, 0); }
  void right() { move(1, 0); }
  void up() { move(0, -1); }
  void down() { move(0, 1); }

  Diagnostics findings_;
  StatementReader in_;
  AdjustCommand command_;
};

constexpr Statement<AdjustReader> AdjustReader::kStatements[14] = {
    {"next", &AdjustReader::next},           {"previous", &AdjustReader::previous},
    {"projector", &AdjustReader::projector}, {"pin", &AdjustReader::pin},
    {"edge", &AdjustReader::edge},           {"left", &AdjustReader::left},
    {"right", &AdjustReader::right},         {"up", &AdjustReader::up},
    {"down", &AdjustReader::down},           {"undo", &AdjustReader::undo},
    {"redo", &AdjustReader::redo},           {"save", &AdjustReader::save},
    {"quit", &AdjustReader::quit},           {"show", &AdjustReader::show}};

}  // namespace

AdjustWords adjustCommandOf(std::string_view line) {
  return AdjustReader(line).run();
}

std::optional<AdjustCommand> adjustCommandOf(const WindowEvent& press) {
  const double step = press.control ? 0.1 : press.shift ? 10 : 1;
  switch (press.key) {
  case Key::Left: return moveBy(-step, 0);
  case Key::Right: return moveBy(step, 0);
  case Key::Up: return moveBy(0, -step);
  case Key::Down: return moveBy(0, step);
  default: break;
  }
  if (press.kind == WindowEvent::Kind::KeyRepeat) return std::nullopt;
  constexpr PictureEdge kEdges[] = {PictureEdge::Left, PictureEdge::Top, PictureEdge::Right,
                                    PictureEdge::Bottom};
  const auto code = static_cast<std::uint32_t>(press.key);
  if (code >= '1' && code <= '4') return AdjustCommand{.kind = Does::Pin, .number = code - '1'};
  if (code >= '5' && code <= '8')
    return AdjustCommand{.kind = Does::Edge, .number = static_cast<std::size_t>(kEdges[code - '5'])};
  if (press.key == Key::Tab) return AdjustCommand{.kind = press.shift ? Does::Previous : Does::Next};
  if (press.key == Key::Escape) return AdjustCommand{.kind = Does::Quit};
  constexpr std::pair<char, Does> kLetters[] = {
      {'Q', Does::Quit}, {'U', Does::Undo}, {'R', Does::Redo}, {'S', Does::Save}};
  for (const auto& [letter, kind] : kLetters)
    if (code == static_cast<std::uint32_t>(letter)) return AdjustCommand{.kind = kind};
  return std::nullopt;
}

}  // namespace stadion
