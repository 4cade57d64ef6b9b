#include "planner/ground/base/loading/library.h"

#include <dlfcn.h>

namespace capstan {

Result<Library> Library::open(const std::string& name) {
  // A library whose C++ objects or threads may outlive a call is never closed.
  void* const handle = ::dlopen(name.c_str(), RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
  if (handle != nullptr) return Library(handle, name);
  const char* const why = ::dlerror();
  return fail("LIB-OPEN",
              "the library " + name + " cannot be opened" + (why != nullptr ? ": " + std::string(why) : ""));
}

Result<void*> Library::find(const char* function) const {
  if (void* const at = ::dlsym(handle_, function)) return at;
  return fail("LIB-OPEN", "the library " + name_ + " has no function " + function);
}

}  // namespace capstan
