#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/ground/base/shared_text.h"
#include "planner/model/plan/cutter/cutter_fields.h"
#include "tooling/library/records/records.h"

// Records as bytes: little-endian numbers, texts and lists with their length in front. Only store.cpp
// includes this; what a row holds is guarded by its hash and by the checks of the records themselves.

namespace capstan::tooling {

/// Every field of a struct, in an order that is part of the file's version: what has a table of fields in its
/// order.
template <class A, class T>
void each_field(A& a, T& x);

/// Texts that many cutters share (what a preset is for, where values are from), each kept once.
class SharedTexts {
 public:
  [[nodiscard]] std::uint32_t place_of(const std::string& text) {
    const auto [it, fresh] = places_.emplace(text, static_cast<std::uint32_t>(texts_.size()));
    if (fresh) texts_.push_back(text);
    return it->second;
  }
  [[nodiscard]] const std::vector<std::string>& texts() const { return texts_; }

 private:
  std::map<std::string, std::uint32_t> places_;
  std::vector<std::string> texts_;
};

class Encoder {
 public:
  explicit Encoder(SharedTexts* shared = nullptr) : shared_(shared) {}
  std::string bytes;

  void shared(const std::string& v) {
    if (shared_ == nullptr) return (*this)(v);
    put(shared_->place_of(v), 4);
  }
  void shared(const std::vector<std::pair<std::string, std::string>>& v) {
    put(v.size(), 4);
    for (const auto& [a, b] : v) shared(a), shared(b);
  }

  template <class T>
  void operator()(const T& v) {
    if constexpr (std::is_same_v<T, double>) {
      put(std::bit_cast<std::uint64_t>(v), 8);
    } else if constexpr (std::is_enum_v<T> || std::is_same_v<T, bool> || std::is_same_v<T, char>) {
      put(static_cast<std::uint64_t>(static_cast<std::uint8_t>(v)), 1);
    } else if constexpr (std::is_integral_v<T>) {
      put(static_cast<std::uint64_t>(static_cast<std::int64_t>(v)), 8);
    } else {
      each_field(*this, const_cast<T&>(v));  // one list of fields serves both ways; nothing is changed
    }
  }
  void operator()(const std::string& v) {
    put(v.size(), 4);
    bytes += v;
  }
  void operator()(const SharedText& v) { (*this)(v.text()); }
  template <class T>
  void operator()(const std::vector<T>& v) {
    put(v.size(), 4);
    for (const T& x : v) (*this)(x);
  }
  template <class T>
  void operator()(const std::optional<T>& v) {
    put(v ? 1 : 0, 1);
    if (v) (*this)(*v);
  }
  template <class T, class U>
  void operator()(const std::pair<T, U>& v) {
    (*this)(v.first);
    (*this)(v.second);
  }

 private:
  void put(std::uint64_t v, int size) {
    for (int i = 0; i < size; ++i) bytes += static_cast<char>((v >> (8 * i)) & 0xff);
  }
  SharedTexts* shared_;
};

/// Reads what Encoder wrote; `ok()` is false when the bytes end early, hold a value outside its enumeration,
/// or go on past the end.
class Decoder {
 public:
  explicit Decoder(std::string_view bytes, const std::vector<SharedText>* shared = nullptr)
      : rest_(bytes), shared_(shared) {}

  template <IsText T>
  void shared(T& v) {
    if (shared_ == nullptr) return (*this)(v);
    const auto place = static_cast<std::size_t>(take(4));
    if (place >= shared_->size()) {
      ok_ = false;
      return;
    }
    if constexpr (std::is_same_v<T, SharedText>) {
      v = (*shared_)[place];
    } else {
      v = (*shared_)[place].text();
    }
  }
  void shared(std::vector<std::pair<std::string, std::string>>& v) {
    const std::size_t n = length();
    v.clear();
    v.reserve(std::min(n, kReserved));
    for (std::size_t i = 0; i < n && ok_; ++i) {
      auto& [a, b] = v.emplace_back();
      shared(a), shared(b);
    }
  }

  template <class T>
  void operator()(T& v) {
    if constexpr (std::is_same_v<T, double>) {
      v = std::bit_cast<double>(take(8));
    } else if constexpr (std::is_same_v<T, bool>) {
      const auto raw = take(1);
      if (raw > 1) ok_ = false;
      v = raw == 1;
    } else if constexpr (std::is_enum_v<T>) {
      const auto raw = static_cast<std::uint8_t>(take(1));
      if (raw > largest(v)) {
        ok_ = false;
        return;
      }
      v = static_cast<T>(raw);
    } else if constexpr (std::is_same_v<T, char>) {
      v = static_cast<char>(take(1));
    } else if constexpr (std::is_integral_v<T>) {
      const auto raw = static_cast<std::int64_t>(take(8));
      v = static_cast<T>(raw);
      if (static_cast<std::int64_t>(v) != raw) ok_ = false;
    } else {
      each_field(*this, v);
    }
  }
  void operator()(std::string& v) {
    const std::size_t n = length();
    v.assign(rest_.substr(0, n));
    rest_.remove_prefix(n);
  }
  void operator()(SharedText& v) {
    std::string text;
    (*this)(text);
    v = std::move(text);
  }
  template <class T>
  void operator()(std::vector<T>& v) {
    const std::size_t n = length();  // every element takes a byte at least
    v.clear();
    v.reserve(std::min(n, kReserved));
    for (std::size_t i = 0; i < n && ok_; ++i) (*this)(v.emplace_back());
  }
  template <class T>
  void operator()(std::optional<T>& v) {
    v.reset();
    if (take(1) != 0) (*this)(v.emplace());
  }
  template <class T, class U>
  void operator()(std::pair<T, U>& v) {
    (*this)(v.first);
    (*this)(v.second);
  }

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] bool done() const { return ok_ && rest_.empty(); }

 private:
  static std::uint8_t largest(model::CutterClass) {
    return static_cast<std::uint8_t>(model::kLastCutterClass);
  }
  static std::uint8_t largest(model::Substrate) {
    return static_cast<std::uint8_t>(model::Substrate::kCarbide);
  }
  static std::uint8_t largest(model::Hand) { return static_cast<std::uint8_t>(model::Hand::kNeutral); }
  static std::uint8_t largest(ValueState) { return static_cast<std::uint8_t>(ValueState::kDefault); }

  std::uint64_t take(std::size_t size) {
    if (rest_.size() < size) {
      ok_ = false;
      rest_ = {};
      return 0;
    }
    std::uint64_t v = 0;
    if constexpr (std::endian::native == std::endian::little) {
      std::memcpy(&v, rest_.data(), size);
    } else {
      for (std::size_t i = 0; i < size; ++i)
        v |= static_cast<std::uint64_t>(static_cast<unsigned char>(rest_[i])) << (8 * i);
    }
    rest_.remove_prefix(size);
    return v;
  }
  std::size_t length() {
    const auto n = static_cast<std::size_t>(take(4));
    if (n > rest_.size()) {
      ok_ = false;
      rest_ = {};
      return 0;
    }
    return n;
  }

  static constexpr std::size_t kReserved = 64;  // a length that lies must not cost memory
  std::string_view rest_;
  const std::vector<SharedText>* shared_;
  bool ok_ = true;
};

template <class A, class T>
void each_field(A& a, T& x) {
  if constexpr (model::HasFields<T>) {
    model::for_each_field(x, [&a](const auto& row, auto& v) {
      if constexpr (requires { a.shared(v); }) {
        if (row.is_repeated) return a.shared(v);
      }
      a(v);
    });
  } else if constexpr (std::is_same_v<T, Property>) {
    a(x.symbol), a(x.number), a(x.text), a(x.unit), a(x.state), a(x.source);
  } else if constexpr (std::is_same_v<T, Preset>) {
    a(x.name), a(x.material), a(x.rpm), a(x.vc_m_min), a(x.fz_mm), a(x.feed_per_revolution_mm);
    a(x.feed_mm_min), a(x.plunge_mm_min), a(x.ramp_mm_min), a(x.ramp_angle_rad), a(x.stepdown_mm);
    a(x.stepover_mm), a(x.coolant), a(x.source);
  } else if constexpr (std::is_same_v<T, CatalogueItem>) {
    a(x.id), a(x.description), a(x.manufacturer), a(x.product_id), a(x.product_link), a(x.cutter_class);
    a(x.kind), a(x.properties), a(x.presets), a(x.kept), a(x.inches);
  } else if constexpr (std::is_same_v<T, ToolInstance>) {
    a(x.id), a(x.item), a(x.group), a(x.in_stock), a(x.price), a(x.life_min), a(x.life_used_min);
    a(x.measured);
  } else if constexpr (std::is_same_v<T, Holder>) {
    a(x.id), a(x.description), a(x.product_id), a(x.manufacturer), a(x.product_link), a(x.connection);
    a(x.gage_length_mm), a(x.segments), a(x.kept), a(x.inches);
  } else if constexpr (std::is_same_v<T, ToolAssembly>) {
    a(x.id), a(x.item), a(x.instance), a(x.holder), a(x.stick_out_mm), a(x.functional_length_mm);
  } else {
    static_assert(std::is_same_v<T, MachineEntry>);
    a(x.number), a(x.pocket), a(x.carousel), a(x.assembly), a(x.offsets), a(x.comment);
  }
}

}  // namespace capstan::tooling
