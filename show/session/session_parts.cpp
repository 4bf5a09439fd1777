/// The parts of a session, in order. A part may use what the parts before it have put into SessionState.

#include "show/session/session_part.h"

namespace stadion {

MakeSessionPart makeJournalPart, makeWatchPart, makeSpansPart, makeWorkCountPart, makeRecordingPart,
    makeConsolePart, makeDisplaysPart, makeClusterMemberPart, makeSupervisionPart, makePicturesPart,
    makeHashStreamPart, makeServicePart, makeSoundRecordingPart, makeWebPart;

std::vector<std::unique_ptr<SessionPart>> makeSessionParts(SessionState& session, Diagnostics& findings) {
  std::vector<std::unique_ptr<SessionPart>> parts;
  for (MakeSessionPart* make : {
           makeJournalPart,         // before all others, so that the journal hears them
           makeWatchPart,           // hashes, events, the recorded input
           makeSpansPart,           // costs by frame
           makeWorkCountPart,       // counts of work
           makeRecordingPart,       // costs by node, budgets, the last frames
           makeConsolePart,         // operator, trackers, sounds
           makeDisplaysPart,        // windows on the walls' real outputs
           makeClusterMemberPart,   // the other machines, which may decide how the show goes on
           makeSupervisionPart,     // the supervisor, likewise
           makeServicePart,         // the service manager, if there is no supervisor
           makePicturesPart,        // pictures, video, tables
           makeSoundRecordingPart,  // after the output folder
           makeHashStreamPart,      // after those that take pictures: it hands them on
           makeWebPart,             // the operator's page, likewise
       }) {
    if (auto part = make(session, findings)) parts.push_back(std::move(part));
    if (findings.hasErrors()) break;
  }
  return parts;
}

void addFailure(SessionReport& report, const Failure& why, Reporter& reporter) {
  if (!why || report.failure) return;
  report.failure = why;
  reporter.fault(why->message);
}

}  // namespace stadion
