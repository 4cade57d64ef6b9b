#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "planner/files/exchange/conformance/faults.h"
#include "planner/files/exchange/express/dictionary.h"
#include "planner/files/p21/file.h"

namespace capstan::exchange::conformance {

/// Layout of the instances of one entity, or of one combination of parts.
struct Layout {
  std::vector<express::EntityId> parts;  ///< known entities; one for a simple instance
  bool complex = false;
  /// Parameters per part in the order of the file's parts; empty for an unknown part (see `known`).
  std::vector<std::vector<express::Slot>> slots;
  std::vector<bool> known;
  std::vector<Fault> faults;  ///< of the combination itself
};

/// The instances of a file seen through the dictionary.
class Population {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;  ///< user-defined, or no known entity

  Population(const p21::File& file, const express::Dictionary& dictionary);

  [[nodiscard]] const p21::File& file() const { return file_; }
  [[nodiscard]] const express::Dictionary& dictionary() const { return dictionary_; }
  /// Null for user-defined instances.
  [[nodiscard]] const Layout* layout(std::size_t instance) const {
    return layout_of_[instance] == kNone ? nullptr : &layouts_[layout_of_[instance]];
  }
  /// Number of the instance's layout, or kNone; equal where the parts are.
  [[nodiscard]] std::uint32_t layout_number(std::size_t instance) const { return layout_of_[instance]; }
  [[nodiscard]] std::span<const Layout> layouts() const { return layouts_; }
  /// True if instances of the layout are allowed where the type is required.
  [[nodiscard]] bool admits(const express::Type& type, const Layout& layout) const;
  [[nodiscard]] bool is_a(const Layout& layout, express::EntityId entity) const;

 private:
  std::uint32_t simple(const p21::Instance& i);
  std::uint32_t complex(const p21::Instance& i);
  void judge(const p21::Instance& i, Layout& layout) const;

  const p21::File& file_;
  const express::Dictionary& dictionary_;
  std::vector<std::uint32_t> layout_of_;
  std::vector<Layout> layouts_;
  std::vector<std::uint32_t> of_entity_;
  std::unordered_map<std::string, std::uint32_t> of_key_;
};

}  // namespace capstan::exchange::conformance
