#pragma once

#include <functional>
#include <string>

#include "planner/files/exchange/common/report.h"
#include "planner/files/p21/file.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

// What a plan computed and no schema holds as it is (a path move by move with what each is for, feed and
// speed of each move, cross sections), kept exactly in the header of a Part 21 file of either standard:
//
//     !CAPSTAN_PATH(1,(x,...),(y,...),(z,...),(cx,...),(cy,...),'kinds','roles')
//     !CAPSTAN_SCHEDULE(1,(feed,...),(speed,...),(dwell,...))
//     !CAPSTAN_SECTIONS(1,(move,...),(at,...),...)              eight columns more
//     !CAPSTAN_STEP_PATH('#10',path,schedule,sections)          numbers from 1; 0: none
//     !CAPSTAN_TOOLPATH('#10',first,count,path,'its_id'|$,.T.|.F.|$,'its_type'|$,'#tech'|'','its_speed')
//
// `$` in a column is the value before it. TOOLPATH names the toolpaths of a step that stand for one path: how
// many, from which. Where the seal (seal.h) holds, the plan is read as it was written; where it does not,
// paths, feeds and sections are what the toolpaths say, and these entities are ignored.

namespace capstan::exchange {

/// How the file calls an object, "#12"; anything else: it does not hold it.
using FileName = std::function<std::string(model::AnyRef)>;

/// The header entities of the plan's paths. `written` is the model whose toolpaths have curves, made from a
/// copy of the plan's: objects that both have are the same.
[[nodiscard]] std::string exact_paths(const model::Plan& plan, const model::Model& written,
                                      const FileName& name_of);

/// Puts the paths back into a plan whose steps and toolpaths have been read. Only of a file whose seal holds.
/// What is malformed is left, with the warning EXC-RECORD.
void restore_paths(const p21::File& file, model::Plan& plan, Reporter& reporter);

/// Whether a header entity is one of these.
[[nodiscard]] bool is_of_paths(std::string_view keyword);

}  // namespace capstan::exchange
