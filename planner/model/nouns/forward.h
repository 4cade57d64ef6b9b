#pragma once

namespace capstan::model {

#define CAPSTAN_NOUN(T) struct T;
#include "planner/ground/vocabulary/noun_kinds.inc"
#undef CAPSTAN_NOUN

}  // namespace capstan::model
