#include "tests/support/corpus.h"

#include <cstdlib>
#include <filesystem>

#include "planner/ground/base/file.h"
#include "tests/support/scratch.h"

namespace capstan::testing {

std::string source_dir() { return CAPSTAN_SOURCE_DIR; }

std::string corpus_folder() {
  const char* named = std::getenv("CAPSTAN_CORPUS");
  const std::filesystem::path folder = named != nullptr
                                           ? std::filesystem::path(named)
                                           : std::filesystem::path(source_dir()) / ".." / "shared" / "corpus";
  std::error_code ignored;
  return std::filesystem::is_directory(folder, ignored) ? folder.lexically_normal().string() : std::string();
}

std::string slurp(const std::string& path) {
  auto bytes = read_file(path);
  EXPECT_TRUE(bytes) << path;
  return bytes ? *std::move(bytes) : std::string();
}

ScratchFolder::ScratchFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "capstan-test-XXXXXX").string();
  path_ = ::mkdtemp(pattern.data());
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string scratch_file(const std::string& name) {
  static const ScratchFolder folder;
  return folder.file(name);
}

}  // namespace capstan::testing
