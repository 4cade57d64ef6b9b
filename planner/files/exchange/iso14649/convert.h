#pragma once

#include "planner/files/exchange/iso14649/reading.h"
#include "planner/files/p21/file.h"
#include "planner/model/nouns/arena/attribute.h"

namespace capstan::exchange {

/// Reads one parameter into one attribute, in the model's unit. Misfits are reported: an integer for a real
/// (and a whole real for an integer) is a warning, everything else a doubt. `$` for a mandatory attribute is
/// a warning; lists are then taken as empty.
void convert(Reading& reading, model::AnyRef object, const model::Attribute& attribute, const p21::Value& v);

}  // namespace capstan::exchange
