#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/files/exchange/conformance/population.h"

namespace capstan::exchange::conformance {

/// References that rules follow backwards.
enum class Link : std::uint8_t {
  kActionPropertyOf,        ///< action_property.definition
  kActionPropertyShown,     ///< action_property_representation.property
  kResourcePropertyOf,      ///< resource_property.resource
  kResourcePropertyShown,   ///< resource_property_representation.property
  kPropertyOf,              ///< property_definition.definition
  kPropertyShown,           ///< property_definition_representation.definition
  kAspectOf,                ///< shape_aspect.of_shape
  kRelationshipToAspect,    ///< shape_aspect_relationship.related_shape_aspect
  kRelationshipFromMethod,  ///< action_method_relationship.relating_method
  kActionChoosing,          ///< action.chosen_method
  kResourceFor,             ///< action_resource.usage, an element
};
inline constexpr std::size_t kLinkCount = 11;

/// Reads attributes of instances by name, forwards and backwards. Instances are positions in the file.
class Links {
 public:
  explicit Links(const Population& population);

  /// Instances that refer to this one by the link, in file order.
  [[nodiscard]] std::span<const std::uint32_t> to(Link link, std::size_t instance) const;
  /// "action_property.name" of an instance; nothing when it has no such attribute or it is $.
  [[nodiscard]] std::optional<p21::Value> value(std::size_t instance, std::string_view attribute) const;
  [[nodiscard]] std::optional<std::string> text(std::size_t instance, std::string_view attribute) const;
  /// The instance that the attribute refers to; nothing if the file does not contain it.
  [[nodiscard]] std::optional<std::size_t> target(std::size_t instance, std::string_view attribute) const;
  [[nodiscard]] std::optional<std::size_t> target(const p21::Value& reference) const;
  /// The instances that a list of references names.
  [[nodiscard]] std::vector<std::size_t> targets(std::size_t instance, std::string_view attribute) const;
  [[nodiscard]] bool is_a(std::size_t instance, express::EntityId entity) const;
  /// Elements of lists looked at so far: what the work grows with.
  [[nodiscard]] std::size_t visits() const { return visits_; }
  [[nodiscard]] const Population& population() const { return p_; }

 private:
  struct Pair {
    std::uint32_t target, source;
    friend auto operator<=>(const Pair&, const Pair&) = default;
  };
  void gather(std::size_t link, std::string_view attribute);

  const Population& p_;
  mutable std::size_t visits_ = 0;
  std::array<std::vector<Pair>, kLinkCount> pairs_;
  std::array<std::vector<std::uint32_t>, kLinkCount> sources_;
};

}  // namespace capstan::exchange::conformance
