#pragma once

#include <string>

#include "planner/ground/base/result.h"

namespace capstan {

/// A shared library that is opened where it is first needed, and stays open. A library that few calls need is
/// opened so: else each start would load it, and all that it needs itself.
class Library {
 public:
  /// `name`: as the system's loader looks for it ("libzip.so.4"), or a path.
  /// Fails  LIB-OPEN, with what the loader says.
  [[nodiscard]] static Result<Library> open(const std::string& name);

  /// Sets `to`, a pointer to a function of the type that the library's header declares.
  /// Fails  LIB-OPEN where the library has no such function.
  template <class Function>
  Status take(const char* name, Function*& to) const {
    const auto address = find(name);
    if (!address) return tl::unexpected(address.error());
    to = reinterpret_cast<Function*>(*address);
    return {};
  }

 private:
  Library(void* handle, std::string name) : handle_(handle), name_(std::move(name)) {}
  [[nodiscard]] Result<void*> find(const char* function) const;

  void* handle_;
  std::string name_;
};

}  // namespace capstan
