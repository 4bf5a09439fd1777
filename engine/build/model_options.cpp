#include "engine/build/model_options.h"

#include "engine/script/object_parts.h"

namespace stadion {

ImportOptions importOptionsOf(const Declaration& d) {
  ImportOptions options;
  if (d.is(Trait::Surroundings)) {
    options.form = ModelForm::Environment;
    return options;
  }
  options.unit = d.optionalNumber("unit");
  options.up = d.optionalChoice<UpAxis>("up");
  options.form = d.is(Trait::Figure) ? ModelForm::Figure : ModelForm::Object;
  options.nodes = {partOf(d), partsWithout(d)};
  return options;
}

Attr blamedFor(const Declaration& d) {
  if (d.has("part")) return "part";
  return "file";
}

}  // namespace stadion
