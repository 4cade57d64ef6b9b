// capstan_manual FOLDER: writes the manual pages to FOLDER/man1 and the completion to FOLDER/completions.
// Part of the build, not installed.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "planner/door/app/manual/manual.h"

namespace {

bool written(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream out(path, std::ios::binary);
  out << text << std::flush;
  if (!out) std::cerr << "capstan_manual: " << path << " cannot be written\n";
  return bool(out);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: capstan_manual FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const capstan::app::CommandText reference = capstan::app::command_reference();
  bool ok = written(folder / "completions" / reference.name, capstan::app::bash_completion(reference));
  for (const auto& page : capstan::app::manual_pages(reference, CAPSTAN_VERSION))
    ok = written(folder / "man1" / page.name, page.text) && ok;
  return ok ? 0 : 1;
}
