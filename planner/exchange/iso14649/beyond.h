#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "planner/exchange/iso14649/reading.h"

namespace capstan::exchange {

/// What the schema cannot hold, as header entities beside the records:
///
///     !CAPSTAN_TYPE('#12','FREEFORM_FINISH_MILLING')     the kind of an instance that is written as another
///     !CAPSTAN_OBJECT('&1','TOOL_USAGE')                 an object that only such attributes reach
///     !CAPSTAN_VALUE('#30','thread_pitch',1.25)          an attribute, in the units of the model
///
/// References are texts: '#12' an instance, '&1' an object, '' one that the file does not hold.

/// How the file calls an object; empty: it does not hold it.
using NameOf = std::function<std::string(model::AnyRef)>;

/// Whether the attribute, which has a value, is written by `write_value`: not what has a record of its own,
/// nor what would hold nothing but references to what the file does not hold.
[[nodiscard]] bool can_be_kept(const model::Model& m, model::AnyRef at, const model::Attribute& a,
                               const NameOf& name_of);
/// One entity, with its line's end.
[[nodiscard]] std::string write_value(const model::Model& m, model::AnyRef at, const model::Attribute& a,
                                      const NameOf& name_of);

/// The kinds of instances that are written as others, by number.
[[nodiscard]] std::map<std::uint64_t, model::TypeId> kinds_beyond(const p21::File& file);
/// Makes the objects and sets the values. What is malformed, or does not fit, is ignored with a warning.
void read_beyond(Reading& reading);
/// Whether a header entity is one of these.
[[nodiscard]] bool is_beyond(std::string_view keyword);

}  // namespace capstan::exchange
