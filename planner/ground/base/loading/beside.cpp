#include "planner/ground/base/loading/beside.h"

#include <dlfcn.h>
#include <sys/auxv.h>

#include <algorithm>
#include <filesystem>

// CAPSTAN_LIBEXEC_FROM_BIN and CAPSTAN_LIBEXEC_FROM_LIB: the way from where programs and where libraries are
// installed to libexec/capstan, as the build was told its folders (cmake/LibexecPath.cmake).

namespace capstan {

namespace fs = std::filesystem;

namespace {

/// The shared library that this code is in; empty where it is in the program itself, of which the loader
/// knows only the name by which it was called, which says nothing of its folder.
fs::path own_library() {
  Dl_info own{}, program{};
  // The address of the program's headers, from the kernel.
  const auto* const headers = reinterpret_cast<const void*>(::getauxval(AT_PHDR));
  if (::dladdr(reinterpret_cast<const void*>(&places_beside), &own) == 0 || own.dli_fname == nullptr ||
      ::dladdr(headers, &program) == 0 || program.dli_fbase == own.dli_fbase)
    return {};
  std::error_code none;
  const fs::path name = own.dli_fname;
  // No file of the working folder may be run.
  return name.is_absolute() ? fs::canonical(name, none) : fs::path();
}

}  // namespace

std::vector<std::string> places_beside(const std::string& file) {
  std::vector<std::string> out;
  const auto beside = [&](const fs::path& of, const char* libexec) {
    const fs::path folder = of.parent_path();
    if (folder.empty()) return;
    for (const fs::path& place : {folder / file, (folder / libexec / file).lexically_normal()}) {
      if (std::find(out.begin(), out.end(), place) == out.end()) out.push_back(place);
    }
  };
  std::error_code none;
  beside(own_library(), CAPSTAN_LIBEXEC_FROM_LIB);
  beside(fs::read_symlink("/proc/self/exe", none), CAPSTAN_LIBEXEC_FROM_BIN);
  return out;
}

}  // namespace capstan
