#pragma once

#include <functional>
#include <string>

#include "planner/files/exchange/common/report.h"
#include "planner/files/exchange/records/seal.h"
#include "planner/files/p21/file.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

// Computed values that no schema can hold exactly (a path move by move with the role, feed and speed of each
// move, cross sections), kept in the header of a Part 21 file of either standard:
//
//     !CAPSTAN_PATH(1,(x,...),(y,...),(z,...),(cx,...),(cy,...),'kinds','roles')
//     !CAPSTAN_SCHEDULE(1,(feed,...),(speed,...),(dwell,...))
//     !CAPSTAN_SECTIONS(1,(move,...),(at,...),...)              eight columns more
//     !CAPSTAN_STEP_PATH('#10',path,schedule,sections)          numbers from 1; 0: none
//     !CAPSTAN_TOOLPATH('#10',first,count,path,'its_id'|$,.T.|.F.|$,'its_type'|$,'#tech'|'','its_speed')
//
// `$` in a column repeats the value before it. TOOLPATH names the toolpaths of a step that form one path: how
// many, from which. If the seal (seal.h) holds, the plan is read as it was written; if not, paths, feeds and
// sections are taken from the toolpaths, and these entities are ignored.

namespace capstan::exchange {

/// How the file calls an object, "#12"; anything else: it does not hold it.
using FileName = std::function<std::string(model::AnyRef)>;

/// Appends the header entities of the plan's paths. `written` is the model whose toolpaths have curves, made
/// from a copy of the plan's: objects that both have are the same. `sealed` gets their seals (seal.h).
void append_exact_paths(std::string& out, const model::Plan& plan, const model::Model& written,
                        const FileName& name_of, Seals* sealed = nullptr);
/// About how many bytes that appends.
[[nodiscard]] std::size_t bytes_of_exact_paths(const model::Plan& plan);

/// Puts the paths back into a plan whose steps and toolpaths have been read. Only for a file whose seal
/// holds. Malformed entities are skipped, with the warning EXC-RECORD.
void restore_paths(const p21::File& file, model::Plan& plan, Reporter& reporter);

/// Of a file whose seal does not hold: compares the toolpaths of each step whose path planning computed with
/// the path in the header. Planning would compute that path anew, so that an edit of either
/// would be lost: it is a contradiction (model/plan/decision/contradicted.h), which names step and move.
///
/// Toolpaths that lie as a whole elsewhere, of all steps of the feature alike, moved with the feature: they
/// are no contradiction, and are told by the warning EXC-EDITED, with how far.
/// Cost  a copy of the plan, and its moves once. Nothing where the header has no paths.
void refuse_edited_paths(const p21::File& file, model::Plan& plan, Reporter& reporter);

/// Whether a header entity is one of these.
[[nodiscard]] bool is_of_paths(std::string_view keyword);

}  // namespace capstan::exchange
