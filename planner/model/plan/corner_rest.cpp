#include "planner/model/plan/corner_rest.h"

#include "planner/ground/base/number.h"

namespace capstan::model {
namespace {

constexpr std::string_view kRestIn = "rest in the corners of ";
constexpr std::string_view kRadius = "radius ";
constexpr std::string_view kInPlaceOf = " mm in place of ";
constexpr std::string_view kMm = " mm";
constexpr int kDecimals = 4;

}  // namespace

Provenance provenance_of(const CornerRest& r) {
  return {std::string(kRestIn) + r.feature,
          std::string(kRadius) + trimmed(r.radius_mm, kDecimals) + std::string(kInPlaceOf) +
              trimmed(r.stated_mm, kDecimals) + std::string(kMm),
          r.why};
}

std::optional<CornerRest> corner_rest(const Provenance& p) {
  if (!p.what.starts_with(kRestIn)) return std::nullopt;
  const std::string_view value = p.value;
  const std::size_t between = value.find(kInPlaceOf);
  if (!value.starts_with(kRadius) || !value.ends_with(kMm) || between == std::string_view::npos)
    return std::nullopt;
  const std::size_t second = between + kInPlaceOf.size();
  if (second + kMm.size() > value.size()) return std::nullopt;
  const auto radius = parse_double(value.substr(kRadius.size(), between - kRadius.size()));
  const auto stated = parse_double(value.substr(second, value.size() - kMm.size() - second));
  if (!radius || !stated) return std::nullopt;
  return CornerRest{p.what.substr(kRestIn.size()), *stated, *radius, p.source};
}

std::vector<CornerRest> corner_rests(const Plan& plan) {
  std::vector<CornerRest> out;
  for (const Provenance& p : plan.provenance) {
    if (auto r = corner_rest(p)) out.push_back(*std::move(r));
  }
  return out;
}

std::optional<CornerRest> corner_rest_of(const Plan& plan, std::string_view feature) {
  for (const Provenance& p : plan.provenance) {
    if (auto r = corner_rest(p); r && r->feature == feature) return r;
  }
  return std::nullopt;
}

}  // namespace capstan::model
