#pragma once

// Every application object.
#include "planner/model/nouns/broadcast.h"
#include "planner/model/nouns/executable.h"
#include "planner/model/nouns/feature.h"
#include "planner/model/nouns/geometric_item.h"
#include "planner/model/nouns/operation.h"
#include "planner/model/nouns/profile.h"
#include "planner/model/nouns/property.h"
#include "planner/model/nouns/strategy.h"
#include "planner/model/nouns/support.h"
#include "planner/model/nouns/tolerance.h"
#include "planner/model/nouns/tool.h"
#include "planner/model/nouns/trajectory.h"
#include "planner/model/nouns/workpiece.h"
