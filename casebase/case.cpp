#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "casebase/casebase.h"
#include "casebase/fields.h"
#include "casebase/sha256.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"

namespace capstan::casebase {
namespace {

constexpr std::size_t kIdDigits = 32;
constexpr std::size_t kKeywordMax = 80, kSourceMax = 1000;
constexpr std::size_t kCategories = 4, kSizes = 4;  // the first of the texts, of the numbers
constexpr int kTeethMax = 200;

// Bounds against wrong units and altered rows, not advice: wider than what any machine tool does.
// Default, unsourced, unless a line says more.
constexpr double kSizeMax = 100000.0;
constexpr double kRpmMax = 300000.0;  // a cutting speed in m/s or a speed in 1/min taken for m/min is caught
// The outcome may lie where it lies; these only refuse what a wrong unit makes.
constexpr double kCycleMax = 1e6, kForceMax = 1e6, kRaMax = 1000.0, kDeviationMax = 100.0, kWearMax = 20.0;

bool is_keyword(std::string_view text) {
  constexpr std::string_view kOthers = "_./+-";
  return !text.empty() && text.size() <= kKeywordMax && std::all_of(text.begin(), text.end(), [&](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           kOthers.find(c) != std::string_view::npos;
  });
}

bool has_control_character(std::string_view text) {
  return std::any_of(text.begin(), text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7f;
  });
}

bool one_of(std::string_view text, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), text) != words.end();
}

std::string said(double v) { return std::isfinite(v) ? shortest(v) : "not a finite number"; }

std::optional<std::string> fault_of_categories(const Case& c) {
  for (std::size_t i = 0; i < kCategories; ++i) {
    const TextField& f = text_fields()[i];
    if (!is_keyword(value(f, c))) {
      return std::string(f.name) + " is not a keyword of 1 to 80 letters, digits and _ . / + -";
    }
  }
  return std::nullopt;
}

std::optional<std::string> fault_of_numbers(const Case& c, std::size_t from, std::size_t below) {
  for (std::size_t i = from; i < below; ++i) {
    const NumberField& f = number_fields()[i];
    const double v = value(f, c);
    if (!(v >= f.low && v <= f.high)) {
      return std::string(f.name) + " is " + said(v) + ", outside " + shortest(f.low) + " to " +
             shortest(f.high);
    }
  }
  return std::nullopt;
}

/// Why numbers that are possible one by one are impossible together.
std::optional<std::string> fault_together(const Case& c) {
  const double rpm = 1000.0 * c.vc_m_min / (std::numbers::pi * c.cutting_diameter_mm);
  if (!(rpm <= kRpmMax)) {
    return "vc_m_min " + shortest(c.vc_m_min) + " on a diameter of " + shortest(c.cutting_diameter_mm) +
           " mm would be " + trimmed(rpm, 0) + " 1/min; is the unit m/min";
  }
  if (c.ae_mm > c.cutting_diameter_mm * (1.0 + 1e-9)) {
    return "ae_mm " + shortest(c.ae_mm) + " is wider than the cutter, " + shortest(c.cutting_diameter_mm) +
           " mm";
  }
  if (c.fz_mm > c.cutting_diameter_mm) {
    return "fz_mm " + shortest(c.fz_mm) + " is more than the cutter's diameter";
  }
  return std::nullopt;
}

}  // namespace

const std::array<TextField, 7>& text_fields() {
  static const std::array<TextField, 7> fields = {{
      {"operation", [](Case& c) -> std::string& { return c.asked.operation; }},
      {"material_group", [](Case& c) -> std::string& { return c.asked.material_group; }},
      {"tool_class", [](Case& c) -> std::string& { return c.asked.tool_class; }},
      {"machine_class", [](Case& c) -> std::string& { return c.asked.machine_class; }},
      {"verdict", [](Case& c) -> std::string& { return c.verdict; }},
      {"provenance", [](Case& c) -> std::string& { return c.provenance; }},
      {"source", [](Case& c) -> std::string& { return c.source; }},
  }};
  return fields;
}

const std::array<NumberField, 14>& number_fields() {
  static const std::array<NumberField, 14> fields = {{
      {"diameter_mm", [](Case& c) -> double& { return c.asked.diameter_mm; }, 0.0, kSizeMax},
      {"depth_mm", [](Case& c) -> double& { return c.asked.depth_mm; }, 0.0, kSizeMax},
      {"width_mm", [](Case& c) -> double& { return c.asked.width_mm; }, 0.0, kSizeMax},
      {"tolerance_mm", [](Case& c) -> double& { return c.asked.tolerance_mm; }, 0.0, 100.0},
      {"cutting_diameter_mm", [](Case& c) -> double& { return c.cutting_diameter_mm; }, 0.01, 2000.0},
      {"vc_m_min", [](Case& c) -> double& { return c.vc_m_min; }, 0.01, 20000.0},
      {"fz_mm", [](Case& c) -> double& { return c.fz_mm; }, 1e-5, 10.0},
      {"ap_mm", [](Case& c) -> double& { return c.ap_mm; }, 0.0, 1000.0},
      {"ae_mm", [](Case& c) -> double& { return c.ae_mm; }, 0.0, 2000.0},
      {"cycle_s", [](Case& c) -> double& { return c.cycle_s; }, 0.0, kCycleMax},
      {"peak_force_n", [](Case& c) -> double& { return c.peak_force_n; }, 0.0, kForceMax},
      {"surface_ra_um", [](Case& c) -> double& { return c.surface_ra_um; }, 0.0, kRaMax},
      {"deviation_mm", [](Case& c) -> double& { return c.deviation_mm; }, -kDeviationMax, kDeviationMax},
      {"wear_mm", [](Case& c) -> double& { return c.wear_mm; }, 0.0, kWearMax},
  }};
  return fields;
}

std::optional<std::string> fault_of(const Question& q) {
  Case c;
  c.asked = q;
  if (auto fault = fault_of_categories(c)) return fault;
  return fault_of_numbers(c, 0, kSizes);
}

std::optional<std::string> fault_of(const Case& c) {
  if (auto fault = fault_of_categories(c)) return fault;
  if (auto fault = fault_of_numbers(c, 0, number_fields().size())) return fault;
  if (c.teeth < 1 || c.teeth > kTeethMax) return "teeth is " + std::to_string(c.teeth) + ", outside 1 to 200";
  if (auto fault = fault_together(c)) return fault;
  if (!one_of(c.verdict, {"good", "bad", "unknown"})) return "verdict is not one of good, bad, unknown";
  if (!one_of(c.provenance, {"measured", "simulated", "entered"})) {
    return "provenance is not one of measured, simulated, entered";
  }
  if (c.source.empty() || c.source.size() > kSourceMax || has_control_character(c.source)) {
    return "source is empty, longer than 1000 bytes or has control characters";
  }
  return std::nullopt;
}

std::string id_of(const Case& c) {
  std::string text = "capstan case 1\n";
  const auto put = [&](std::string_view name, std::string_view v) {
    text += name;
    text += ' ' + std::to_string(v.size()) + ' ';
    text += v;
    text += '\n';
  };
  for (const TextField& f : text_fields()) put(f.name, value(f, c));
  for (const NumberField& f : number_fields()) {
    const double v = value(f, c) + 0.0;  // -0 and 0 are one number
    put(f.name, hex64(std::bit_cast<std::uint64_t>(v)));
  }
  put("teeth", std::to_string(c.teeth));
  put("coolant", c.coolant ? "1" : "0");
  return sha256(text).substr(0, kIdDigits);
}

}  // namespace capstan::casebase
