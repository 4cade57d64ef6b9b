#pragma once

#include "planner/files/json/values.h"
#include "planner/model/nouns/arena/model.h"

namespace capstan::json {

/// The application objects of the plan's JSON, by the model's descriptor table. All are made before any is
/// filled, so that references may point anywhere.
template <class Tree>
void make_objects(const Tree& objects, const Place& at, model::Model& model);
template <class Tree>
void fill_objects(const Tree& objects, const Place& at, model::Model& model, ValueReader<Tree>& values);

}  // namespace capstan::json
