#pragma once

#include <string>

#include "planner/files/exchange/brep/brep.h"

namespace capstan::app {

/// The features of each solid as `recognise` finds them, a row each: what, sizes, faces, reason and
/// alternatives; the faces that stay raw, and what is not recognised. Sheets, which have no inside, are
/// passed over.
[[nodiscard]] std::string recognised_features(const exchange::Brep& shapes);

}  // namespace capstan::app
