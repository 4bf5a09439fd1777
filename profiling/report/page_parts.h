#pragma once
/// The parts that every report's page is made of. Its scripts draw from the JSON object in the page alone.

namespace stadion::report {

extern const char* const kStyle;
extern const char* const kBody;

extern const char* const kBaseScript;  ///< elements, figures as text, what is chosen (also in the address)
extern const char* const kPlotScript;  ///< the strip of all frames, histograms
extern const char* const kTimelineScript;  ///< threads side by side
extern const char* const kFlameScript;     ///< costs along the tree of the scene
extern const char* const kTableScript;     ///< nodes, walls and eyes, late frames, dynamics, stages
extern const char* const kMainScript;      ///< draws everything, and again when something is chosen

}  // namespace stadion::report
