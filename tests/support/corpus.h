#pragma once

#include <gtest/gtest.h>

#include <string>

namespace capstan::testing {

/// The root of this checkout, where `examples` and `docs` are.
[[nodiscard]] std::string source_dir();

/// The folder of real files beside the checkout, or empty when it is absent (CAPSTAN_CORPUS overrides it).
[[nodiscard]] std::string corpus_folder();

/// The bytes of a file; fails the running test when it cannot be read.
[[nodiscard]] std::string slurp(const std::string& path);

/// A fresh folder for one test, removed when the value goes.
class ScratchFolder {
 public:
  ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder();
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace capstan::testing

/// Declares `path` as a corpus file, or skips the test visibly where the corpus is absent.
#define CAPSTAN_CORPUS_FILE(path, relative)                                            \
  if (::capstan::testing::corpus_folder().empty()) GTEST_SKIP() << "corpus is absent"; \
  const std::string path = ::capstan::testing::corpus_folder() + "/" + (relative)
