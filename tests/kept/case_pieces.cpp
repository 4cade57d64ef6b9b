#include "tests/kept/case_pieces.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>

#include "casebase/intake.h"
#include "casebase/retain/join/import.h"
#include "tests/casebase/many_cases.h"

namespace capstan::kept {
namespace {

namespace cases = casebase;
constexpr std::size_t kNearest = 10;

void wanted(bool ok, const char* what) {
  if (!ok) throw std::runtime_error(what);
}

cases::CaseBase opened(const std::string& file) {
  Job job;
  auto base = cases::CaseBase::open_or_create(file, job);
  if (!base) throw std::runtime_error(to_text(base.error()));
  return *std::move(base);
}

void fill(const std::string& file) {
  wanted(opened(file).add(cases::many(cases::kPoints)).has_value(), "the base takes no cases");
}

void open(const std::string& file) { wanted(opened(file).size() >= cases::kPoints, "cases are missing"); }

void add(const std::string& file) {
  Job job;
  // Another one each time.
  cases::Case one =
      cases::made(static_cast<std::uint64_t>(std::chrono::system_clock::now().time_since_epoch().count()));
  one.observed.verdict = cases::Verdict::kUnknown;
  auto intake = cases::Intake::open_or_create(file, job);
  wanted(intake.has_value(), "the base does not open");
  const auto added = intake->add(std::span(&one, 1));
  wanted(added && *added && (*added)->added == 1, "the case was not added");
}

void ask(const std::string& file) {
  const cases::CaseBase base = opened(file);
  for (std::uint64_t n = 0; n < 1000; ++n)
    wanted(base.nearest(cases::made(n).asked, kNearest)->size() == kNearest, "too few neighbours");
}

void look_up(const std::string&) {
  const cases::Points& all = cases::points(true);
  const auto index = cases::make_index(all);
  const std::vector<double> weight(cases::kDims, 1.0);
  std::mt19937_64 random(9);
  for (int i = 0; i < 10'000; ++i) {
    const double* p = all.row(random() % cases::kPoints);
    const auto hits = index->nearest({std::vector<double>(p, p + cases::kDims), weight}, kNearest);
    wanted(hits.size() == kNearest && hits.front().distance2 == 0.0, "a point is not its own neighbour");
  }
}

void import(const std::string& file) {
  constexpr int kParts = 10'000;
  const std::string uri = file + ".import";
  std::filesystem::remove(uri);
  Job job;
  std::istringstream in(cases::table_of_times(kParts));
  const auto made = cases::retain::import_log(in, cases::retain::LogFormat::kTimes, cases::steps_of_times(),
                                              {.file = "times.csv"}, {}, job);
  wanted(made && made->size() == std::size_t{kParts} * cases::kToolsOfTimes, "not all rows are cases");
  wanted(opened(uri).add(*made).has_value(), "the base takes no cases");
  std::filesystem::remove(uri);
}

}  // namespace

bool case_piece(const std::string& name, const std::string& file) {
  static const std::map<std::string, void (*)(const std::string&)> kPieces = {
      {"cases-fill", fill},    {"cases-open", open},       {"cases-add", add},
      {"cases-question", ask}, {"cases-look-up", look_up}, {"cases-import", import}};
  const auto found = kPieces.find(name);
  if (found == kPieces.end()) return false;
  found->second(file);
  return true;
}

}  // namespace capstan::kept
