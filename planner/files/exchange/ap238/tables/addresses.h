#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::exchange::ap238 {

/// Names of a plan's objects in a file whose instances another system may renumber: the way from an
/// executable along attributes, `its_operation.its_machine_functions`,
/// `its_operation.its_toolpath.its_list[2]` (from 0); empty is the executable itself. An object that is not
/// below the executable begins with an object by kind and its_id: `{ROUND_HOLE:H1}`,
/// `{MACHINING_WORKINGSTEP:drill}.its_operation`; the second of the same its_id has `:2`.
class Addresses {
 public:
  /// `number` orders objects of one kind with the same its_id; the same in the writing and the reading
  /// system.
  Addresses(const model::Plan& plan, const std::function<std::uint64_t(model::AnyRef)>& number);

  /// Position of the object among all that have an address, from 1; 0 if it has none.
  [[nodiscard]] std::uint64_t order(model::AnyRef object) const;
  /// The executable that carries a property about the object; the main workplan if there is none.
  [[nodiscard]] model::AnyRef executable(model::AnyRef object) const;
  /// Needs   an object that has an address.
  [[nodiscard]] std::string from(model::AnyRef executable, model::AnyRef object) const;
  /// The object of that name; unset if it is gone.
  [[nodiscard]] model::AnyRef find(model::AnyRef executable, std::string_view address) const;

 private:
  struct Place {
    model::AnyRef base;
    std::string path;
    std::uint64_t order = 0;
  };
  void name_objects(const std::function<std::uint64_t(model::AnyRef)>& number);
  void place_from(model::AnyRef base);
  [[nodiscard]] std::string its_id(model::AnyRef at) const;

  const model::Model& m_;
  model::AnyRef main_;
  std::map<model::AnyRef, Place> places_;
  std::map<std::pair<model::TypeId, std::string>, std::vector<model::AnyRef>> named_;
};

}  // namespace capstan::exchange::ap238
