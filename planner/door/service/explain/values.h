#pragma once

#include <string>
#include <vector>

#include "planner/model/nouns/arena/model.h"
#include "planner/model/plan/plan.h"

namespace capstan::service {

/// Name of an object for people: `#18 CLOSED_POCKET 'POCKET1'`; without a number if it came from no file.
[[nodiscard]] std::string label(const model::Model& m, model::AnyRef at);
/// As `label` without the number: the same for one object in two plans.
[[nodiscard]] std::string name_of(const model::Model& m, model::AnyRef at);

/// A number of the model with its unit: "2400 mm/min", angles also in degrees, speeds of rotation with their
/// direction left as ISO 14649 signs it. `decimals` < 0: the shortest text that reads back to the value.
[[nodiscard]] std::string with_unit(double value, model::Unit unit, int decimals = -1);

/// One attribute's value as text; references by `label`, lists in brackets, "absent" if it has none. At most
/// `kListShown` items of a list are shown, with the number of the others.
[[nodiscard]] std::string value_text(const model::Model& m, const model::Attribute& a, const void* object,
                                     int decimals = -1);
inline constexpr std::size_t kListShown = 12;

/// "1 min 23.4 s", "12.3 s"
[[nodiscard]] std::string duration(double seconds);
/// "120 x 80 x 31 mm, x 0..120, y 0..80, z -30..1"
[[nodiscard]] std::string box_text(const geometry::Box3& box);

/// Lines in columns: each as wide as its widest cell, two spaces between. The last column is not padded.
/// Widths count characters, not bytes.
[[nodiscard]] std::string table(const std::vector<std::vector<std::string>>& rows,
                                const std::string& indent = "  ");

}  // namespace capstan::service
