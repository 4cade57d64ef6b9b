#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "planner/files/exchange/exchange.h"
#include "planner/model/nouns/all.h"
#include "tests/support/differences/model_difference.h"

namespace capstan::exchange::ap238 {

/// The plan as AP238; a failure of the test where it cannot be written.
inline Written written(const model::Plan& plan) {
  Job job;
  auto out = write_ap238(plan, job);
  EXPECT_TRUE(out.has_value()) << (out ? "" : to_text(out.error()));
  return out ? std::move(*out) : Written{};
}

/// A file's text as a plan. Diagnostics go to `said`.
inline model::Plan read_text(const std::string& text, std::vector<std::string>* said = nullptr) {
  Job job;
  auto plan = read_bytes(text, "test.stpnc", {}, job);
  for (const auto& d : job.diagnostics()) {
    if (said != nullptr) said->push_back(to_text(d));
  }
  EXPECT_TRUE(plan.has_value()) << (plan ? "" : to_text(plan.error()));
  return plan ? std::move(*plan) : model::Plan{};
}

/// A data section in a file of its own.
inline std::string file_of(const std::string& instances) {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('t','',(''),(''),'','','');\n"
         "FILE_SCHEMA(('MODEL_BASED_INTEGRATED_MANUFACTURING_SCHEMA'));\nENDSEC;\nDATA;\n" +
         instances + "ENDSEC;\nEND-ISO-10303-21;\n";
}

/// The instances with every reference written as a bare #, to be searched for what a mapping asks for:
/// "ACTION_PROPERTY('retract plane','finishing',#);".
inline std::vector<std::string> shapes(const std::string& text) {
  std::vector<std::string> out(1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') {
      out.emplace_back();
      continue;
    }
    out.back() += text[i];
    if (text[i] == '#') {
      while (i + 1 < text.size() && text[i + 1] >= '0' && text[i + 1] <= '9') ++i;
    }
  }
  for (auto& line : out) {
    if (line.rfind("#=", 0) == 0) line = line.substr(2);
  }
  return out;
}

/// What differs after writing and reading, and what was written and is not read; empty when nothing. Names of
/// geometry may (roles fix some).
inline std::string lost_on_the_way(const model::Plan& plan) {
  std::vector<std::string> said;
  const model::Plan back = read_text(written(plan).bytes, &said);
  testing::DifferenceOptions options;
  options.item_names = false;
  std::string lost = testing::ModelDifference(plan, back, options).text();
  for (const auto& s : said) {
    if (s.find("EXC-UNREAD") != std::string::npos) lost += s + "\n";
  }
  return lost;
}

/// A project with a workpiece and an empty main workplan, to hang things on.
struct Bench {
  model::Plan plan;
  model::Ref<model::Workpiece> workpiece;
  model::Ref<model::Workplan> workplan;
  Bench() {
    model::Model& m = plan.model;
    workpiece = m.add<model::Workpiece>();
    m.at<model::Workpiece>(workpiece).its_id = "part";
    workplan = m.add<model::Workplan>();
    m.at<model::Workplan>(workplan).its_id = "main";
    m.at<model::Workplan>(workplan).its_elements.given = true;
    plan.project = m.add<model::Project>();
    auto& p = m.at<model::Project>(plan.project);
    p.its_id = "project";
    p.main_workplan = workplan;
    p.its_workpieces.push_back(workpiece);
  }
  /// Adds an executable to the main workplan.
  template <class T>
  model::Ref<T> step(T value = {}) {
    const auto r = plan.model.add(std::move(value));
    plan.model.at<model::Workplan>(workplan).its_elements.push_back(r);
    return r;
  }
};

}  // namespace capstan::exchange::ap238
