#pragma once

#include <array>
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
  /// What leads to an object: an attribute, and the item of a list.
  struct Way {
    const model::Attribute* attribute = nullptr;
    std::uint32_t item = kNoItem;
  };
  static constexpr std::uint32_t kNoItem = 0xFFFFFFFF;
  struct Place {
    model::AnyRef base, from;
    Way way;
    std::uint64_t order = 0;  ///< 0: no place
  };
  template <class Visit>
  void for_each_way(model::AnyRef at, const Visit& visit) const;
  bool put(model::AnyRef at, const Place& place);
  [[nodiscard]] const Place* place_of(model::AnyRef at) const;
  [[nodiscard]] std::string path_to(model::AnyRef object) const;
  void name_objects(const std::function<std::uint64_t(model::AnyRef)>& number);
  void place_from(model::AnyRef base);
  [[nodiscard]] std::string its_id(model::AnyRef at) const;

  const model::Model& m_;
  model::AnyRef main_;
  std::array<std::vector<Place>, model::kTypeCount> places_;  ///< by kind and number
  std::uint64_t placed_ = 0;
  std::map<std::pair<model::TypeId, std::string>, std::vector<model::AnyRef>> named_;
};

}  // namespace capstan::exchange::ap238
