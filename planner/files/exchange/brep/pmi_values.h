#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/files/p21/file.h"

namespace capstan::exchange {

/// The parameters of an instance as one of a kind: its own, or those of its part.
[[nodiscard]] std::optional<p21::Value> as(const p21::Instance& i, std::string_view keyword);
[[nodiscard]] bool is(const p21::Instance& i, std::string_view keyword);

[[nodiscard]] std::optional<std::uint64_t> reference_at(const p21::Value& list, std::size_t n);
/// Empty: there is no text.
[[nodiscard]] std::string text_at(const p21::Value& list, std::size_t n);
/// The references in a value, however it wraps them: #1, (#1,#2), SET_REPRESENTATION_ITEM((#1,#2)).
void references_in(const p21::Value& v, std::vector<std::uint64_t>& out);

/// The number and the unit of a measure.
[[nodiscard]] std::optional<std::pair<double, std::uint64_t>> number_of(const p21::Instance& i);
/// In mm; nothing: the instance is no measure of length.
[[nodiscard]] std::optional<double> length_of(const p21::File& file, std::uint64_t id);
/// The name of a measure, by its own or by a qualifier of its kind.
[[nodiscard]] std::string name_of(const p21::File& file, const p21::Instance& i);

}  // namespace capstan::exchange
