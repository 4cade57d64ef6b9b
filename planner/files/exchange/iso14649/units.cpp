#include "planner/files/exchange/iso14649/units.h"

#include <array>
#include <charconv>
#include <cmath>

#include "planner/ground/base/number.h"

namespace capstan::exchange {
namespace {

// To 15 significant digits, which a double always holds.
double to_15_digits(double v) {
  std::array<char, 40> buffer{};
  const auto [end, ec] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), v, std::chars_format::scientific, 14);
  double out = v;
  std::from_chars(buffer.data(), end, out);
  return out;
}

}  // namespace

double from_file(double value, model::Unit unit) {
  const double factor = model::iso14649_factor(unit);
  const double exact = value * factor;
  if (factor <= 1.0 || !std::isfinite(exact))
    return exact;  // lengths as they are; angles have no round radians
  const double likely = to_15_digits(exact);
  return likely / factor == value ? likely : exact;
}

double to_file(double value, model::Unit unit) {
  const double factor = model::iso14649_factor(unit);
  return factor == 1.0 ? value : unconverted(value, factor);
}

void round_units(model::Model& m) {
  for (std::size_t i = 1; i < model::kTypeCount; ++i) {
    const auto type = static_cast<model::TypeId>(i);
    for (const model::Attribute& a : model::noun_type(type).attributes) {
      if (!a.in_iso14649 || model::iso14649_factor(a.unit) == 1.0) continue;
      for (const model::AnyRef at : m.all(type)) {
        if (a.storage == model::Storage::kReal) {
          auto& v = *static_cast<model::Real*>(a.at(m.object(at)));
          if (v) v = from_file(to_file(*v, a.unit), a.unit);
        } else if (a.storage == model::Storage::kRealList) {
          for (double& v : static_cast<model::RealList*>(a.at(m.object(at)))->items) {
            v = from_file(to_file(v, a.unit), a.unit);
          }
        }
      }
    }
  }
}

}  // namespace capstan::exchange
