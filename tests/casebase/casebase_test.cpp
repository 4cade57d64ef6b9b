#include "casebase/casebase.h"

#include "planner/ground/base/stopping.h"
#include "tests/casebase/sample.h"

namespace capstan::casebase {
namespace {

std::vector<std::string> ids_of(const std::vector<Case>& cases) {
  std::vector<std::string> out;
  for (const Case& c : cases) out.push_back(c.id);
  return out;
}

Case of(const std::string& material, const std::string& machine, Origin origin, double diameter_mm) {
  Case c = sample(diameter_mm);
  c.asked.material_group = material;
  c.asked.machine_class = machine;
  c.origin = origin;
  c.id = id_of(c);
  return c;
}

TEST(MeasuredIn, GivesMeasuredCasesOfTheMaterialAndTheMachine) {
  const Folder folder;
  const std::vector<Case> cases = {of("P/mild_steel", "mill", Origin::kMeasured, 10.0),
                                   of("P/mild_steel", "other", Origin::kMeasured, 11.0),
                                   of("K/grey_iron", "mill", Origin::kMeasured, 12.0),
                                   of("P/mild_steel", "mill", Origin::kEntered, 13.0)};
  fill(folder.file(), cases);
  Job job;
  auto base = CaseBase::open(folder.file(), job).value();
  EXPECT_EQ(ids_of(base.measured_in("P/mild_steel", "mill", 10)), std::vector{cases[0].id});
  EXPECT_EQ(base.measured_in("P/mild_steel", {}, 10).size(), 2u);
  EXPECT_EQ(base.measured_in({}, "mill", 10).size(), 2u);
  ASSERT_TRUE(base.remove(std::vector{cases[0].id}, {"A. Smith", "", "wrong part"}).has_value());
  EXPECT_TRUE(base.measured_in("P/mild_steel", "mill", 10).empty());
}

TEST(MeasuredIn, GivesTheCasesOfTheLeastIdsWhateverTheirOrder) {
  const Folder folder;
  std::vector<Case> cases = random_cases(300, 17);
  fill(folder.file(), cases);
  std::vector<std::string> ids = ids_of(cases);
  std::sort(ids.begin(), ids.end());
  ids.resize(100);
  Job job;
  EXPECT_EQ(ids_of(CaseBase::open(folder.file(), job)->measured_in({}, {}, 100)), ids);
}

TEST(MeasuredIn, EndsWhenTheWorkIsToEnd) {
  const Folder folder;
  fill(folder.file(), random_cases(100, 19));
  Job job;
  const auto base = CaseBase::open(folder.file(), job).value();
  const auto read = [&] {
    return stoppable(
        job, [&] { return base.measured_in({}, {}, 1000).size(); }, [] { return std::size_t{0}; });
  };
  EXPECT_EQ(read(), 100u);
  job.request_stop();
  EXPECT_EQ(read(), 0u);
}

}  // namespace
}  // namespace capstan::casebase
