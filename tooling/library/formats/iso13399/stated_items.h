#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner/files/p21/read/parse.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/cutter/cutter.h"
#include "tooling/library/formats/iso13399/iso13399.h"

// The items of a Part 21 file of ISO 13399, as the file states them; only this folder includes this.

namespace capstan::tooling::iso13399 {

/// A value as the file has it, with what it was found by.
struct Stated {
  std::uint64_t id = 0, line = 0;  ///< of the value's instance
  std::string name, text, unit, bsu, property;
  ValueState state = ValueState::kStated;
  std::string why;
};

struct Item {
  std::uint64_t id = 0, line = 0;
  std::string number, name, description, role, kind, maker, left_out;
  std::optional<model::CutterClass> cutter_class;
  std::vector<Stated> values;
};

/// Reads the items, in the order of the file, each with its values, class, role and maker. Values that
/// nothing ties to an item are those of the file's only item; of several items none gets them, and `report`
/// says so.
///
/// Fails  ISO13399-FORM for an instance of another form; ISO13399-DANGLING for a reference to none.
[[nodiscard]] Result<std::vector<Item>> stated_items(const p21::File& f, const std::string& file,
                                                     LossReport& report);

}  // namespace capstan::tooling::iso13399
