#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "tooling/selection/select.h"

namespace capstan::tooling {

/// The answers of `select` from one library, for one material and machine, each made once: a plate asks for
/// each of its holes what it asked for the one before.
///
/// Refers to all three, which must stay as they are.
class Selections {
 public:
  Selections(const std::vector<model::Cutter>& library, const model::WorkMaterial& material,
             const model::Machine& machine)
      : library_(library), material_(material), machine_(machine) {}

  /// As `select` of the same; valid until the next question.
  [[nodiscard]] const model::Selection& of(const model::ToolRequirement& requirement,
                                           const Preferences& preferences);

 private:
  const std::vector<model::Cutter>& library_;
  const model::WorkMaterial& material_;
  const model::Machine& machine_;
  std::map<std::string, model::Selection> known_;  ///< by the whole question
  std::size_t held_ = 0;                           ///< cutters in all of them
};

}  // namespace capstan::tooling
