#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/mutation/classes.h"

namespace capstan::mutation {

enum class Form { kJson, kPart21 };

/// One way to edit a plan's file: the values of one part of it, its spelling, or its words for people.
struct PlanClass {
  std::string name;  ///< "machine: times ten"
  Form form = Form::kJson;
  /// Dangerous: of what tools, machine, piece and paths are. Different: any other value. Benign: the same
  /// values, spelled otherwise, or other words for people.
  Kind kind = Kind::kDangerous;
  /// Nothing where the file has no such value, or the edit would change nothing.
  std::function<std::optional<std::string>(const std::string& file, Random&)> make;
  /// Told as an edit is not enough: nothing may be made of the file.
  bool stops = false;
};

[[nodiscard]] std::vector<PlanClass> json_classes();
[[nodiscard]] std::vector<PlanClass> part21_classes();
/// What leaves the file saying two things, or something wrong of the whole plan.
[[nodiscard]] std::vector<PlanClass> contradiction_classes(Form form);

/// What may become of one number.
struct NumberEdit {
  const char* name;
  double (*of)(double);
};
[[nodiscard]] const std::vector<NumberEdit>& number_edits();

}  // namespace capstan::mutation
