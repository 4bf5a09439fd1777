#include "pipeline/sound/sound_device.h"

#include "engine/base/shared_library.h"
#include "pipeline/sound/sound_libraries.h"

#include <AL/al.h>
#include <AL/alc.h>

#include <cmath>
#include <map>

namespace stadion {
namespace {

/// The functions of the library that are used.
struct OpenAl {
  decltype(&alcOpenDevice) openDevice = nullptr;
  decltype(&alcCloseDevice) closeDevice = nullptr;
  decltype(&alcCreateContext) createContext = nullptr;
  decltype(&alcDestroyContext) destroyContext = nullptr;
  decltype(&alcMakeContextCurrent) makeCurrent = nullptr;
  decltype(&alcGetString) deviceString = nullptr;
  decltype(&alGetError) error = nullptr;
  decltype(&alGenBuffers) genBuffers = nullptr;
  decltype(&alDeleteBuffers) deleteBuffers = nullptr;
  decltype(&alBufferData) bufferData = nullptr;
  decltype(&alGenSources) genSources = nullptr;
  decltype(&alDeleteSources) deleteSources = nullptr;
  decltype(&alSourcei) sourceInt = nullptr;
  decltype(&alSourcef) sourceFloat = nullptr;
  decltype(&alSource3f) sourceVector = nullptr;
  decltype(&alGetSourcei) getSourceInt = nullptr;
  decltype(&alSourcePlay) play = nullptr;
  decltype(&alSourcePause) pause = nullptr;
  decltype(&alSourceStop) stop = nullptr;
  decltype(&alListenerf) listenerFloat = nullptr;

  bool load(const SharedLibrary& library) {
    const auto get = [&](auto& function, const char* name) {
      function = library.find<std::remove_pointer_t<std::remove_reference_t<decltype(function)>>>(name);
      return function != nullptr;
    };
    return get(openDevice, "alcOpenDevice") && get(closeDevice, "alcCloseDevice") &&
           get(createContext, "alcCreateContext") && get(destroyContext, "alcDestroyContext") &&
           get(makeCurrent, "alcMakeContextCurrent") && get(deviceString, "alcGetString") &&
           get(error, "alGetError") && get(genBuffers, "alGenBuffers") &&
           get(deleteBuffers, "alDeleteBuffers") && get(bufferData, "alBufferData") &&
           get(genSources, "alGenSources") && get(deleteSources, "alDeleteSources") &&
           get(sourceInt, "alSourcei") && get(sourceFloat, "alSourcef") && get(sourceVector, "alSource3f") &&
           get(getSourceInt, "alGetSourcei") && get(play, "alSourcePlay") && get(pause, "alSourcePause") &&
           get(stop, "alSourceStop") && get(listenerFloat, "alListenerf");
  }
};

class OpenAlDevice final : public SoundDevice {
public:
  explicit OpenAlDevice(const OpenAl& al) : al_(al) {}

  /// Returns false if there is no sound output.
  bool open() {
    device_ = al_.openDevice(nullptr);
    if (device_) context_ = al_.createContext(device_, nullptr);
    return context_ && al_.makeCurrent(context_) == ALC_TRUE;
  }
  ~OpenAlDevice() override {
    while (!buffers_.empty()) stop(buffers_.begin()->first);
    if (context_) {
      al_.makeCurrent(nullptr);
      al_.destroyContext(context_);
    }
    if (device_) al_.closeDevice(device_);
  }
  OpenAlDevice(const OpenAlDevice&) = delete;
  OpenAlDevice& operator=(const OpenAlDevice&) = delete;

  std::string name() const override {
    const ALCchar* name = al_.deviceString(device_, ALC_DEVICE_SPECIFIER);
    return name ? name : "OpenAL";
  }

  Voice start(const std::shared_ptr<const Sound>& played, bool loop, double offset) override {
    const Sound& sound = *played;
    al_.error();
    ALuint buffer = 0, source = 0;
    al_.genBuffers(1, &buffer);
    if (al_.error() != AL_NO_ERROR) return 0;
    al_.bufferData(buffer, sound.info.channels == 2 ? AL_FORMAT_STEREO16 : AL_FORMAT_MONO16,
                   sound.samples.data(), static_cast<ALsizei>(sound.samples.size() * sizeof(std::int16_t)),
                   static_cast<ALsizei>(sound.info.rate));
    if (al_.error() == AL_NO_ERROR) al_.genSources(1, &source);
    if (al_.error() != AL_NO_ERROR || source == 0) {
      al_.deleteBuffers(1, &buffer);
      return 0;
    }
    buffers_[source] = buffer;
    al_.sourceInt(source, AL_BUFFER, static_cast<ALint>(buffer));
    al_.sourceInt(source, AL_LOOPING, loop ? AL_TRUE : AL_FALSE);
    al_.sourceInt(source, AL_SOURCE_RELATIVE, AL_TRUE);
    al_.sourceFloat(source, AL_ROLLOFF_FACTOR, 0);  // the volume is already computed
    al_.sourceFloat(source, AL_GAIN, 0);
    if (offset > 0) al_.sourceFloat(source, AL_SEC_OFFSET, static_cast<float>(offset));
    al_.play(source);
    return source;
  }
  void set(Voice voice, double gain, const Vec3& p_H) override {
    al_.sourceFloat(voice, AL_GAIN, static_cast<float>(gain));
    // OpenAL's listener looks along -Z with +Y up.
    al_.sourceVector(voice, AL_POSITION, static_cast<float>(p_H.x()), static_cast<float>(p_H.z()),
                     static_cast<float>(-p_H.y()));
  }
  void stop(Voice voice) override {
    const auto at = buffers_.find(voice);
    if (at == buffers_.end()) return;
    al_.stop(voice);
    al_.deleteSources(1, &voice);
    al_.deleteBuffers(1, &at->second);
    buffers_.erase(at);
  }
  void pause(Voice voice, bool paused) override {
    ALint state = AL_STOPPED;
    al_.getSourceInt(voice, AL_SOURCE_STATE, &state);
    if (paused && state == AL_PLAYING) al_.pause(voice);
    if (!paused && state == AL_PAUSED) al_.play(voice);
  }
  void setVolume(double volume) override { al_.listenerFloat(AL_GAIN, static_cast<float>(volume)); }

private:
  OpenAl al_;
  ALCdevice* device_ = nullptr;
  ALCcontext* context_ = nullptr;
  std::map<Voice, ALuint> buffers_;  ///< by source
};

}  // namespace

Result<std::unique_ptr<SoundDevice>> openSoundDevice() {
  quietAlsa();
  const auto library = SharedLibrary::open("libopenal.so.1", "libopenal1");
  if (!library) return library.error();
  using Made = Result<std::unique_ptr<SoundDevice>>;
  OpenAl al;
  if (!al.load(library.value())) return Made::failure("libopenal.so.1 lacks functions of OpenAL 1.1");
  auto device = std::make_unique<OpenAlDevice>(al);
  if (!device->open()) return Made::failure("OpenAL finds no device that plays sounds");
  return std::unique_ptr<SoundDevice>(std::move(device));
}

}  // namespace stadion
