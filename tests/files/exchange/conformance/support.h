#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "planner/files/exchange/conformance/check.h"
#include "planner/files/p21/read/parse.h"

namespace capstan::exchange::conformance {

/// A file of edition 3 with these instances.
inline std::string file_of(const std::string& data) {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
         "FILE_SCHEMA(('MODEL_BASED_INTEGRATED_MANUFACTURING_SCHEMA'));\nENDSEC;\nDATA;\n" +
         data + "ENDSEC;\nEND-ISO-10303-21;\n";
}

/// What check_schema reports of the bytes, one line each as a user reads it.
inline std::vector<std::string> faults_of(std::string bytes, const std::string& name = "file.stp") {
  Job job;
  const auto file = p21::parse(std::move(bytes), name, {}, job);
  EXPECT_TRUE(file) << to_text(file.error());
  if (!file) return {};
  Job check;
  const std::size_t n = check_schema(*file, check);
  std::vector<std::string> out;
  for (const Diagnostic& d : check.diagnostics()) out.push_back(to_text(d));
  EXPECT_EQ(n == 0, check.count(Severity::kError) == 0);
  return out;
}

/// As above, of a file with these instances.
inline std::vector<std::string> faults_in(const std::string& data) { return faults_of(file_of(data)); }

}  // namespace capstan::exchange::conformance
