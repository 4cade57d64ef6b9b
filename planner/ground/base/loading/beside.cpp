#include "planner/ground/base/loading/beside.h"

#include <dlfcn.h>

#include <algorithm>
#include <filesystem>

namespace capstan {

namespace fs = std::filesystem;

std::vector<std::string> places_beside(const std::string& file) {
  std::vector<std::string> out;
  const auto beside = [&](const fs::path& of) {
    const fs::path folder = of.parent_path();
    if (folder.empty()) return;
    for (const fs::path& place : {folder / file, folder.parent_path() / "libexec" / "capstan" / file}) {
      if (std::find(out.begin(), out.end(), place) == out.end()) out.push_back(place);
    }
  };
  std::error_code none;
  beside(fs::read_symlink("/proc/self/exe", none));
  // In a library that another program links: beside that. Of a program the loader gives the name by which it
  // was called, which says nothing of its folder: no file of the working folder may be run.
  Dl_info library{};
  if (::dladdr(reinterpret_cast<const void*>(&places_beside), &library) != 0 &&
      library.dli_fname != nullptr && fs::path(library.dli_fname).is_absolute())
    beside(fs::canonical(library.dli_fname, none));
  return out;
}

}  // namespace capstan
