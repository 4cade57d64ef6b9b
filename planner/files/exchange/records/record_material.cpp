#include "planner/files/exchange/records/record_material.h"

#include "planner/files/exchange/records/described.h"
#include "planner/model/plan/resources/material_fields.h"

namespace capstan::exchange {

void describe(RecordFields& f, model::WorkMaterial& m) { describe_fields(f, m); }

}  // namespace capstan::exchange
