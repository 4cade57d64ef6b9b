#pragma once

#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/nouns/arena/model.h"

namespace capstan::exchange {

/// A number of the file in the model's unit. 1000 1/min has no exact value in 1/s: where a model value of at
/// most 15 digits is what the file's number must have been made from, that one is taken, so that it
/// survives writing and reading.
[[nodiscard]] double from_file(double value, model::Unit unit);
/// A number of the model as the file holds it.
[[nodiscard]] double to_file(double value, model::Unit unit);
/// Rounds each number to what the file will contain, so that hashes match what is read back.
void round_units(model::Model& m);

}  // namespace capstan::exchange
