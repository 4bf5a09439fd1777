#pragma once
/// The statements of a wall file about screens, projectors, panoramas and visitors (wall_file.h lists them).
///
/// Ownership  borrows the reader and the WallFile that it fills.
/// Threads    one reader, one thread.
/// Errors     are reported at the word that is wrong.

#include "engine/display/wall_file.h"
#include "engine/display/wall_words.h"

#include <string>
#include <vector>

namespace stadion {

class HallReader {
public:
  HallReader(StatementReader& in, LengthReader& lengths, WallFile& hall)
      : in_(in), lengths_(lengths), hall_(hall) {}

  // Each reads the rest of one line.
  void screen();
  void projector();
  void panorama();
  void visitor();
  void control();

  /// Gives projectors their screens, which may stand below them. Expects the pixels of all entries. False
  /// after an error.
  bool finish();
  /// True after a statement that is one too many: more lines would only repeat the error.
  bool tooMany() const { return tooMany_; }

private:
  struct ScreenOfProjector {
    std::size_t entry;
    std::string screen;
    StatementPlace at;         ///< of the screen's name
    StatementPlace projector;  ///< of the projector's name
  };

  /// A control line, which may stand above its wall.
  struct NamedControl {
    std::string wall;
    ProjectorControl control;
    StatementPlace at;
  };
  static const StatementField<HallReader> kControlFields[2];

  struct NamedPanorama {
    std::size_t entry;
    StatementPlace at;  ///< of the panorama's name
  };

  struct NamedEntry {
    WallEntry entry;
    Word name;
  };

  /// Reads the name that follows the keyword. Null after an error.
  std::optional<NamedEntry> namedEntry(const char* what, const char* whose);
  /// Adds the entry, unless its name is taken or there are too many.
  bool add(WallEntry entry, const Word& name);
  bool controlPort();
  bool controlPassword();
  bool giveControls();
  bool link(const ScreenOfProjector& link);
  bool giveSize(const NamedPanorama& panorama);
  bool refuseMore(std::size_t count, std::size_t most, std::string_view what);

  StatementReader& in_;
  LengthReader& lengths_;
  WallFile& hall_;
  std::vector<ScreenOfProjector> links_;
  std::vector<NamedPanorama> panoramas_;
  std::vector<NamedControl> controls_;
  bool tooMany_ = false;
};

/// The statement as text that HallReader reads back to the same values in a file whose unit has
/// `metresPerUnit`.
std::string formatScreen(const Screen& screen, double metresPerUnit);
std::string formatProjector(const WallEntry& entry, const std::string& screen, double metresPerUnit);
std::string formatPanorama(const WallEntry& entry, double metresPerUnit);
std::string formatControl(const ProjectorControl& control);
std::string formatVisitor(const VisitorPlace& visitor, double metresPerUnit);

}  // namespace stadion
