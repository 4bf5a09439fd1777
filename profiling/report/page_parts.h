#pragma once
/// The parts of every report page. Its scripts use only the JSON object in the page.

namespace stadion::report {

extern const char* const kStyle;
extern const char* const kBody;

extern const char* const kBaseScript;  ///< elements, figures as text, the selection (also in the address)
extern const char* const kPlotScript;  ///< the strip of all frames, histograms
extern const char* const kTimelineScript;  ///< threads side by side
extern const char* const kFlameScript;     ///< costs along the tree of the scene
extern const char* const kTableScript;     ///< nodes, walls and eyes, late frames, dynamics, stages
extern const char* const kMainScript;      ///< draws everything, and again when the selection changes

}  // namespace stadion::report
