#include "planner/files/json/meaning.h"

#include <array>
#include <utility>

namespace capstan::json {
namespace {

using Row = std::pair<std::string_view, std::string_view>;

constexpr std::string_view kRatio = "1: a fraction of one, or a factor";
constexpr std::string_view kNoUnit = "1";
constexpr std::string_view kBeside = "in the unit that stands beside it (unit)";
constexpr std::string_view kOfProgram = "as the program uses it";

/// Whole names first: their ends would say something else, or nothing.
constexpr std::array kNames = {
    Row{"rpm", "1/min"},
    Row{"rpm_min", "1/min"},
    Row{"rpm_max", "1/min"},
    Row{"x", "mm"},
    Row{"y", "mm"},
    Row{"z", "mm"},
    Row{"cx", "mm"},
    Row{"cy", "mm"},
    Row{"cost_per_hour", "in the shop's currency, per hour"},
    Row{"price", "in the shop's currency"},
    Row{"feed_override_max", kRatio},
    Row{"efficiency", kRatio},
    Row{"damping_ratio", kRatio},
    Row{"force_margin", kRatio},
    Row{"share", kRatio},
    Row{"uncertainty", kRatio},
    Row{"kc_uncertainty", kRatio},
    Row{"shadow_price", "1: fraction of the objective saved per 1 % more of the limit"},
    Row{"scatter", "1: standard deviation of the logarithm of tool life"},
    Row{"mc", "1: exponent of the chip thickness"},
    Row{"n", "1: exponent of the law of tool life"},
    Row{"p", "1: exponent of the law of tool life"},
    Row{"q", "1: exponent of the law of tool life"},
    Row{"lead_threads", "threads"},
    Row{"taper_thread_count", "threads"},
    Row{"dwell_revolutions", "revolutions of the spindle"},
    Row{"second_component", "s"},
    Row{"limit", kBeside},
    Row{"value", kBeside},
    Row{"its_parameter_value", "in its_parameter_unit"},
    Row{"initial_value", kOfProgram},
    Row{"real", "in the unit of the attribute's choice (type)"},
    Row{"direction_ratios", kNoUnit},
    Row{"knots", kNoUnit},
    Row{"u_knots", kNoUnit},
    Row{"v_knots", kNoUnit},
    Row{"weights_data", kNoUnit},
};

/// Ends of names that stand without a unit in their table, or in none; the longer before those that end as
/// they do.
// clang-format off
constexpr std::array kEnds = {
    Row{"_mm3_min", "mm3/min"}, Row{"_mm_min", "mm/min"}, Row{"_m_min", "m/min"}, Row{"_mm_s2", "mm/s2"},
    Row{"_mm_s3", "mm/s3"},     Row{"_n_mm2", "N/mm2"},   Row{"_n_mm", "N/mm"},   Row{"_mm3", "mm3"},
    Row{"_mm2", "mm2"},         Row{"_mm", "mm"},         Row{"_rpm", "1/min"},   Row{"_min", "min"},
    Row{"_s", "s"},             Row{"_hz", "Hz"},         Row{"_kg", "kg"},       Row{"_bar", "bar"},
    Row{"_nm", "Nm"},           Row{"_n", "N"},           Row{"_w", "W"},         Row{"_hb", "HB"},
};
// clang-format on

/// Names that several kinds of object have, each with a meaning of its own.
struct OfKind {
  model::TypeId owner;
  std::string_view name, words;
};
constexpr std::array kOfKinds = {
    OfKind{model::TypeId::kSurfaceTextureParameter, "its_value",
           "in the unit of its parameter (parameter_name)"},
    OfKind{model::TypeId::kNcConstant, "its_value", kOfProgram},
};

}  // namespace

std::string_view meaning_of(std::string_view name) {
  for (const auto& [whole, words] : kNames)
    if (name == whole) return words;
  for (const auto& [end, unit] : kEnds)
    if (name.ends_with(end)) return unit;
  return {};
}

std::string_view meaning_of(std::string_view name, model::Unit unit) {
  if (unit != model::Unit::kNone && unit != model::Unit::kRatio) return model::symbol(unit);
  const std::string_view words = meaning_of(name);
  return words.empty() ? model::symbol(unit) : words;
}

std::string_view meaning_of(model::TypeId owner, const model::Attribute& a) {
  for (const OfKind& row : kOfKinds)
    if (row.owner == owner && row.name == a.name) return row.words;
  return a.unit != model::Unit::kNone ? model::symbol(a.unit) : meaning_of(a.name);
}

}  // namespace capstan::json
