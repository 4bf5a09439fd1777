#pragma once
/// Silences ALSA and OpenAL Soft. Without a sound device they print ten lines that users cannot understand.
/// SoundPlayer reports it in a sentence.

namespace stadion {

/// Stops OpenAL Soft from printing, unless the environment says otherwise (ALSOFT_LOGLEVEL).
///
/// Threads  changes the environment: the program calls it first, before it starts threads.
void quietOpenAl();

/// Stops ALSA from printing. Any thread, before a device is opened.
void quietAlsa();

}  // namespace stadion
