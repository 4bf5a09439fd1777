#pragma once
/// Loudspeakers in a wall file.
///
///     loudspeaker NAME X Y Z  [channel N]  [delay MS]  [gain DB]  [subwoofer HZ]
///     sound  [card NAME]  [align on|off]
///
/// A loudspeaker without `channel` has the channel after the one before it, from 1. The place is in the unit of
/// the file. `sound` says what the loudspeakers are connected to.
///
/// Threads  one reader, one thread.
/// Errors   are reported at the word that is wrong; lintLoudspeakers() finds what is wrong with the whole.

#include "engine/base/diagnostic.h"
#include "engine/loudspeakers/loudspeaker.h"
#include "engine/plain_text/statement_reader.h"

#include <functional>
#include <string>

namespace stadion {

class LoudspeakerReader {
public:
  /// Takes three words as a point in rig space [m]; the argument says whose it is. False after an error.
  using ReadPoint = std::function<bool(std::string_view of, Vec3& target)>;

  /// Borrows all three.
  LoudspeakerReader(StatementReader& in, ReadPoint point, LoudspeakerSet& hall)
      : in_(in), point_(std::move(point)), hall_(hall) {}

  // Each reads the rest of one line.
  void loudspeaker();
  void sound();

  /// True after a loudspeaker that is one too many: more lines would only repeat the error.
  bool tooMany() const { return tooMany_; }

private:
  static const StatementField<LoudspeakerReader> kFields[4], kSoundFields[2];

  bool channel();
  bool delay();
  bool gain();
  bool subwoofer();
  bool card();
  bool align();

  StatementReader& in_;
  ReadPoint point_;
  LoudspeakerSet& hall_;
  Loudspeaker read_;  ///< the one of this line
  bool tooMany_ = false;
};

/// The statements as text that LoudspeakerReader reads back to the same values, in a file whose unit has so many
/// metres. Delays and gains may differ in their last digits.
std::string formatLoudspeakers(const LoudspeakerSet& hall, double metresPerUnit);

/// What is wrong with the loudspeakers of a hall. Errors: two on one channel, two in the same direction, and
/// nothing but subwoofers. Warnings: all behind the visitor, one within the visitor's reach, and one that is
/// farther away than a hall is large.
void lintLoudspeakers(const LoudspeakerSet& hall, const std::string& file, Diagnostics& out);

/// A line for each loudspeaker: where it is, seen from the visitor, and how it is aligned. Empty without any.
std::string listLoudspeakers(const LoudspeakerSet& hall);

}  // namespace stadion
