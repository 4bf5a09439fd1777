#pragma once
/// The entry for a program that plays a whole session as `stadion run` does: pictures and video, recorded
/// input, an operator, trackers, a cluster, budgets.
///
///     SessionSettings settings;
///     settings.show.script = "kick.evs";
///     Diagnostics findings;
///     if (!settings.show.complete(findings)) return;
///     ShowSession session(settings, reporter, catchStopSignals());  // reporter: your Reporter
///     if (session.open()) session.play();

#include "show/base/reporter.h"
#include "show/base/stop_signal.h"
#include "show/session/show_session.h"
