#pragma once
/// Adjusts a hall while its pattern shows: corner pins and edges of ramps move by pixels, with undo, and are written
/// back into the wall file.
///
/// Pins     of a projector with `pins`; of a flat wall with an `output`, the corners of its `warp`.
/// Edges    of any projector without a fisheye.
/// Saving   changes the numbers of the statements alone. The file appears complete or not at all. A file that somebody
///          else has changed since it was read is left alone.
/// Units    pixels of the output; the file has shares.
/// Ownership  keeps a copy of the hall and the text of its file.
/// Threads    one at a time.
/// Errors   wrong commands change nothing, and state() says why.

#include "engine/display/wall_file.h"
#include "engine/hall_edit/wall_text.h"
#include "show/adjust/adjust_command.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

/// What a command has changed.
struct AdjustOutcome {
  std::optional<std::size_t> changed;  ///< entry whose picture is another now
  bool ended = false;
  bool refused = false;  ///< it could not be done
};

class HallAdjuster {
public:
  /// Reads the text of the hall's file again. Fails if it is no wall file, or nothing in it can be adjusted.
  static Result<HallAdjuster> open(const WallFile& hall);

  AdjustOutcome apply(const AdjustCommand& command);

  const WallFile& hall() const { return hall_; }
  std::size_t chosen() const { return entries_[chosen_]; }  ///< entry
  std::optional<std::size_t> pin() const;                   ///< that is chosen, from 0
  std::optional<PictureEdge> edge() const;                  ///< that is chosen
  /// The places of the chosen entry's pins, as shares of its output; nothing: it has none.
  std::optional<std::array<Vec2, 4>> pins() const { return pinsOf(chosen()); }
  bool unsaved() const { return text_.text() != saved_; }

  /// A line for the operator: what is chosen, where it is, and what the last command did.
  std::string state() const;

private:
  /// A pin of an entry, or an edge.
  struct Handle {
    bool isEdge = false;
    std::size_t number = 0;
  };
  /// What undo() goes back to.
  struct Change {
    std::size_t entry = 0;
    bool isEdge = false;
    std::array<double, 8> before{}, after{};
    ChangedLine line;
  };

  HallAdjuster(const WallFile& hall, std::string text);
  bool hasEdges(std::size_t entry) const;
  std::optional<std::array<Vec2, 4>> pinsOf(std::size_t entry) const;
  void setPins(std::size_t entry, const std::array<double, 8>& values);
  void setEdges(std::size_t entry, const std::array<double, 8>& values);
  PixelSize sizeOf(std::size_t entry) const;
  void choose(std::size_t number);
  AdjustOutcome move(double right, double down);
  AdjustOutcome movePin(const Vec2& by);
  AdjustOutcome moveEdge(const Vec2& by);
  AdjustOutcome keep(Change change, std::string_view statement, std::string_view field,
                     std::span<const double> values);
  AdjustOutcome goBack();
  AdjustOutcome goForward();
  AdjustOutcome write(const Change& change, const std::array<double, 8>& values, const char* did);
  AdjustOutcome save();
  AdjustOutcome refuse(std::string why);
  AdjustOutcome quit();

  WallFile hall_;
  WallText text_;
  std::string saved_;                 ///< what the file has, as far as is known
  std::vector<std::size_t> entries_;  ///< those with something to adjust
  std::size_t chosen_ = 0;            ///< index in entries_
  Handle handle_;
  std::vector<Change> done_, undone_;
  bool asked_ = false;  ///< the last command was to quit, with unsaved changes
  std::string message_;
};

}  // namespace stadion
