#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "planner/files/p21/read/parse.h"

namespace capstan::p21::testing {

inline constexpr std::string_view kHeader =
    "ISO-10303-21;\nHEADER;\n"
    "FILE_DESCRIPTION((''),'2;1');\n"
    "FILE_NAME('a','2026-01-01T00:00:00',(''),(''),'','','');\n"
    "FILE_SCHEMA(('S'));\nENDSEC;\n";
/// The line on which `data_file`'s data begin.
inline constexpr std::uint64_t kFirstDataLine = 8;

/// A file whose data section holds `data`.
inline std::string data_file(std::string_view data) {
  std::string out(kHeader);
  out.append("DATA;\n").append(data).append("\nENDSEC;\nEND-ISO-10303-21;\n");
  return out;
}

struct Outcome {
  Result<File> file;
  std::vector<Diagnostic> said;
  [[nodiscard]] std::size_t count(Severity s) const {
    return static_cast<std::size_t>(
        std::count_if(said.begin(), said.end(), [s](const Diagnostic& d) { return d.severity == s; }));
  }
  [[nodiscard]] std::string all() const {
    std::string out;
    for (const Diagnostic& d : said) out += to_text(d) + "\n";
    if (!file) out += to_text(file.error());
    return out;
  }
};

inline Outcome read(std::string bytes, const Limits& limits = {}) {
  Job job;
  auto file = parse(std::move(bytes), "test.p21", limits, job);
  return {std::move(file), job.take_diagnostics()};
}

/// The file, read without a word of complaint.
inline File read_clean(std::string bytes) {
  Outcome o = read(std::move(bytes));
  EXPECT_TRUE(o.file) << o.all();
  EXPECT_TRUE(o.said.empty()) << o.all();
  if (!o.file) throw std::runtime_error("not readable");
  return *std::move(o.file);
}

}  // namespace capstan::p21::testing
