#include "engine/build/clip_commands.h"

#include "engine/figure/clip_words.h"
#include "engine/text/text_mesh.h"

namespace stadion {

std::string faultOfClips(const EventMessage& message, const Skeleton& skeleton) {
  const CommandId command = message.commandId;
  const std::string words = unescaped(message.words);
  if (command == commandNamed("layer")) return readLayer(words, skeleton, {}).fault;
  if (command == commandNamed("unlayer")) return readUnlayer(words, skeleton, {}).fault;
  if (command == commandNamed("pose")) return readPose(words, skeleton).fault;
  if (command != commandNamed("play") || words.empty()) return {};
  return readPlay(words, skeleton, {}).fault;
}

}  // namespace stadion
