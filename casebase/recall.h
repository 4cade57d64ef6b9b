#pragma once

#include <vector>

#include "casebase/casebase.h"

namespace capstan::casebase {

struct Near {
  const Case* found = nullptr;
  double distance = 0.0;
};

/// The case to start from among those near enough, nearest first: what `CaseBase::ask` says.
[[nodiscard]] Answer choose(const std::vector<Near>& near);

}  // namespace capstan::casebase
