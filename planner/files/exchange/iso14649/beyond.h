#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "planner/files/exchange/iso14649/reading.h"

namespace capstan::exchange {

/// What the schema cannot hold, as header entities beside the records:
///
///     !CAPSTAN_TYPE('#12','FREEFORM_FINISH_MILLING',(('#12','hash')))  the kind of an instance that is
///     written
///                                                                      as another
///     !CAPSTAN_OBJECT('&1','TOOL_USAGE')                               an object that only such attributes
///                                                                      reach
///     !CAPSTAN_VALUE('#30','thread_pitch',1.25,(('#30','hash')))       an attribute, in the units of the
///     model
///
/// References are texts: '#12' an instance, '&1' an object, '' one that the file does not hold. Each entity
/// ends with the instances that it names and a hash of what each said when the file was written: its keyword
/// and parameters, numbers by value, the instances that it refers to by number. Where one says something else
/// now (somebody edited it, or renumbered the file and kept its header), the entity is not applied.

/// How the file calls an object; empty: it does not hold it.
using NameOf = std::function<std::string(model::AnyRef)>;
/// Whether the attribute, which has a value, is written by `write_value`: not what has a record of its own,
/// nor what would hold nothing but references to what the file does not hold.
[[nodiscard]] bool can_be_kept(const model::Model& m, model::AnyRef at, const model::Attribute& a,
                               const NameOf& name_of);
/// One entity, up to the hashes of the instances that it names.
[[nodiscard]] std::string write_value(const model::Model& m, model::AnyRef at, const model::Attribute& a,
                                      const NameOf& name_of);

/// The kinds of instances that are written as others, by number. Warns EXC-EDITED of those that have changed.
[[nodiscard]] std::map<std::uint64_t, model::TypeId> kinds_beyond(Reading& reading);
/// Makes the objects and sets the values. Malformed or misfit entities are ignored with the warning
/// EXC-RECORD, entities about an instance that has changed with the warning EXC-EDITED.
void read_beyond(Reading& reading);
/// Whether a header entity is one of these.
[[nodiscard]] bool is_beyond(std::string_view keyword);

}  // namespace capstan::exchange
