#pragma once
/// Where there is no sound device ALSA and OpenAL Soft say so in ten lines, of which nobody understands one.
/// SoundPlayer says it in a sentence.

namespace stadion {

/// OpenAL Soft leaves the terminal alone, unless the environment says otherwise (ALSOFT_LOGLEVEL).
///
/// Threads  changes the environment: the program calls it first thing, before it starts threads.
void quietOpenAl();

/// ALSA leaves the terminal alone. Any thread, before a device is opened.
void quietAlsa();

}  // namespace stadion
