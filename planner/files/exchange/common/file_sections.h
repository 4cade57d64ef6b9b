#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>

#include "planner/files/exchange/common/report.h"
#include "planner/files/p21/file.h"
#include "planner/model/plan/plan.h"

/// @file What a Part 21 file holds beside its instances, the same for both standards.

namespace capstan::exchange {

/// Fills the plan's file name, description, time stamp, authors and organizations.
void read_header(const p21::File& file, model::Plan& plan);

/// Keeps ANCHOR and REFERENCE sections of edition 3, their instance numbers connected by `resolve` (unset: no
/// such instance). References to other files are never followed. A SIGNATURE is dropped: what is written is
/// not what was signed. Says EXC-ANCHOR, EXC-EXTERNAL, EXC-SIGNATURE.
void keep_sections(const p21::File& file, model::KeptSchema schema,
                   const std::function<model::AnyRef(std::uint64_t)>& resolve, model::Plan& plan,
                   Reporter& reporter);

/// The sections that the plan keeps, as a file has them between header and data.
[[nodiscard]] std::string sections_text(const model::Plan& plan,
                                        const std::function<std::string(model::AnyRef)>& reference);

/// The implementation level that FILE_DESCRIPTION states for the file: '4;1' with such sections.
[[nodiscard]] std::string implementation_level(const model::Plan& plan);

/// Numbers of instances in kept text of a standard that refer to no object: an instance of that number in
/// another file, or none at all. New instances must not take them.
[[nodiscard]] std::set<std::uint64_t> unresolved_numbers(const model::KeptInstance& kept);

}  // namespace capstan::exchange
