#pragma once
/// Where in Cull or Draw a difference is: asked of `stadion profile`, when a stage has become slower.

#include "profiling/regression/spans/span_record.h"
#include "show/regress/regress_settings.h"

namespace stadion {

/// The nodes of a case in two builds; empty for builds that cannot report them.
class ProfileOfBoth {
public:
  ProfileOfBoth(const regression::SuiteCase& c, const std::string& before, const std::string& now,
                std::chrono::seconds limit, const std::atomic<bool>& stop);

  /// The node that grew most in the stage of that wall, if it explains half of what the stage grew by; empty
  /// if none does.
  std::string grewMost(const std::string& stage, const std::string& wall) const;

private:
  std::vector<regression::SpanRow> before_, now_;
};

}  // namespace stadion
