#include "assets/generator/olympia/athletes.h"
#include "assets/generator/olympia/anatomy.h"

namespace stadion::assets {
namespace {

FigureModel athlete(const Look& look, const Performance& performance) {
  FigureModel model{personBones(), {}, {}};
  addAthlete(model, look);
  model.clips = {clipOf("wait", standing(performance, 0)), clipOf("throw", performance),
                 clipOf("rest", standing(performance, performance.duration)),
                 clipOf("cheer", cheering(performance)), clipOf("walk", walkingBack(performance))};
  return model;
}

}  // namespace

FigureModel discusThrower() {
  return athlete(
      {Hair::Dark, Dress::Exomis, 1.08, {0.76, 0.53, 0.39}, {0.92, 0.89, 0.81}, {0.56, 0.20, 0.15}},
      discusThrow());
}

FigureModel javelinThrower() {
  return athlete(
      {Hair::Fair, Dress::Loincloth, 1.0, {0.82, 0.60, 0.46}, {0.90, 0.86, 0.77}, {0.22, 0.34, 0.50}},
      javelinThrow());
}

FigureModel ballPlayer() {
  return athlete(
      {Hair::Bearded, Dress::Chiton, 0.96, {0.72, 0.49, 0.35}, {0.86, 0.78, 0.62}, {0.30, 0.36, 0.24}},
      ballKick());
}

}  // namespace stadion::assets
