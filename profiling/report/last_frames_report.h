#pragma once
/// The last frames of a run (black box), as text, JSON and a page for a browser.
///
/// Threads  plain values.

#include "profiling/record/black_box.h"

#include <string>

namespace stadion {

/// Late frames with their causes, the stages of the last frames, and counts by cause.
std::string lastFramesText(const BlackBox::Content& content);
/// Returns one JSON object on one line: "walls", "frames", "causes". Its fields are in docs/formats.md.
std::string lastFramesJson(const BlackBox::Content& content, const std::string& file);
/// Returns a page that needs no other files and no network.
std::string lastFramesPage(const BlackBox::Content& content, const std::string& file);

}  // namespace stadion
