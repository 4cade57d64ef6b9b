#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <regex>
#include <sstream>
#include <thread>

#include "planner/ground/base/file.h"
#include "tests/door/app/command/command.h"
#include "tests/door/app/programs.h"
#include "tests/files/exchange/brep/step_part.h"

// CAD files that are broken or made to do harm, and helpers that fail, at the command: one error, nothing
// written, no process left.

namespace capstan::app {
namespace {

using exchange::testing::StepPart;
using geometry::Vec3;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string boxed() {
  StepPart part;
  part.product({part.box({0, 0, 0}, {30, 40, 20})}, part.context());
  return part.text();
}

std::string with(std::string text, const std::string& what, const std::string& instead) {
  const auto at = text.rfind(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), instead);
}

std::string open_shell() {
  StepPart part;
  auto faces = part.flat_faces(StepPart::box_corners({0, 0, 0}, {30, 40, 20}), StepPart::box_faces());
  faces.pop_back();
  part.product({part.solid(faces)}, part.context());
  return part.text();
}

/// A prism over an outline that crosses itself off its middle.
std::string crossing() {
  StepPart part;
  std::vector<Vec3> corners;
  for (const double z : {0.0, 3.0}) {
    for (const geometry::Vec2 p : {geometry::Vec2{0, 0}, {10, 14}, {10, 0}, {0, 10}})
      corners.push_back({p.x, p.y, z});
  }
  std::vector<std::vector<int>> faces{{3, 2, 1, 0}, {4, 5, 6, 7}};
  for (int i = 0; i < 4; ++i) faces.push_back({i, (i + 1) % 4, (i + 1) % 4 + 4, i + 4});
  part.product({part.solid(part.flat_faces(corners, faces))}, part.context());
  return part.text();
}

/// A side of the box on a B-spline whose control points are all one.
std::string spline_of_one_point() {
  StepPart part;
  auto faces = part.flat_faces(StepPart::box_corners({0, 0, 0}, {30, 40, 20}), StepPart::box_faces());
  const std::string p = StepPart::ref(part.point({30, 40, 20}));
  const int surface = part.add("B_SPLINE_SURFACE_WITH_KNOTS('',1,1,((" + p + "," + p + "),(" + p + "," + p +
                               ")),.UNSPECIFIED.,.F.,.F.,.F.,(2,2),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED.)");
  part.product({part.solid(faces)}, part.context());
  std::string text = part.text();
  const auto at = text.find("ADVANCED_FACE('5',");
  const auto comma = text.find(",#", text.find(')', at));
  return text.replace(comma, text.find(',', comma + 1) - comma, "," + StepPart::ref(surface));
}

/// All vertices are at one place: no edge has a length.
std::string edges_without_length() {
  const std::string text = boxed();
  const auto first = text.find("VERTEX_POINT('',#");
  const std::string one = text.substr(first, text.find(')', first) + 1 - first);
  return std::regex_replace(text, std::regex(R"(VERTEX_POINT\('',#\d+\))"), one);
}

std::string million_faces() {
  std::string text = boxed();
  std::string more;
  for (int i = 0; i < 1'000'000; ++i)
    more += "#" + std::to_string(10'000 + i) + "=ADVANCED_FACE('',(),#1,.T.);\n";
  return with(std::move(text), "ENDSEC;\nEND-ISO", more + "ENDSEC;\nEND-ISO");
}

struct Hostile {
  const char* name;
  std::function<std::string()> make;
};
void PrintTo(const Hostile& h, std::ostream* out) { *out << h.name; }

class HostileCad : public CommandTest, public ::testing::WithParamInterface<Hostile> {
 protected:
  static bool built() {
    return std::filesystem::exists(std::filesystem::path(command_file()).parent_path() / "capstan-brep");
  }
  /// Plans part.step into two files: refused by one error, and neither file is there.
  void expect_refused(const std::string& code = "") {
    const Ran r = run("plan part.step --material 6061 -o part.json -o part.ngc");
    EXPECT_GE(r.code, 1);
    EXPECT_LE(r.code, 3) << r.err;
    // A file that is no Part 21 has one summary behind its faults, each of which has a line; one that is not
    // read at all, for its size, has the fault alone.
    std::istringstream lines(r.err);
    std::size_t errors = 0, faults = 0;
    for (std::string line; std::getline(lines, line);) {
      if (line.find(" error: ") == std::string::npos) continue;
      const bool fault = line.find("[P21-") != std::string::npos;
      faults += fault ? 1 : 0;
      errors += !fault || line.find("cannot be read as Part 21") != std::string::npos ? 1 : 0;
    }
    EXPECT_EQ(errors == 0 ? faults : errors, 1U) << r.err;
    EXPECT_THAT(r.err, HasSubstr("part.step"));
    EXPECT_THAT(r.err, HasSubstr(code));
    EXPECT_THAT(files(), ::testing::Not(::testing::Contains("part.json")));
    EXPECT_THAT(files(), ::testing::Not(::testing::Contains("part.ngc")));
    RecordProperty("said", r.err);
  }
};

TEST_P(HostileCad, GetsOneErrorAndNothingIsWritten) {
  if (!built()) GTEST_SKIP() << "built without OpenCASCADE";
  put("part.step", GetParam().make());
  expect_refused();
}

INSTANTIATE_TEST_SUITE_P(
    Each, HostileCad,
    ::testing::Values(
        Hostile{"truncated_in_the_data", [] { return boxed().substr(0, boxed().size() / 2); }},
        Hostile{"truncated_before_its_end", [] { return boxed().substr(0, boxed().size() - 20); }},
        Hostile{"nan",
                [] { return with(boxed(), "CARTESIAN_POINT('',(30.0", "CARTESIAN_POINT('',(NAN,0.0"); }},
        Hostile{"corner_at_1e300",
                [] { return with(boxed(), "CARTESIAN_POINT('',(30.0", "CARTESIAN_POINT('',(1.E300,0.0"); }},
        Hostile{"number_too_large",
                [] { return with(boxed(), "CARTESIAN_POINT('',(30.0", "CARTESIAN_POINT('',(1.E400,0.0"); }},
        Hostile{"open_shell", &open_shell}, Hostile{"crosses_itself", &crossing},
        Hostile{"spline_of_one_point", &spline_of_one_point},
        Hostile{"edges_without_length", &edges_without_length}, Hostile{"million_faces", &million_faces},
        Hostile{"without_shapes", [] { return StepPart().text(); }},
        Hostile{"dangling_shell",
                [] { return with(boxed(), "MANIFOLD_SOLID_BREP('',#", "MANIFOLD_SOLID_BREP('',#9"); }}),
    [](const auto& row) { return std::string(row.param.name); });

// A file of more than 2 GiB, of which nothing stands on the disk.
TEST_F(HostileCad, AHugeFileIsRefusedByItsSize) {
  put("part.step", boxed());
  std::filesystem::resize_file(folder_ / "part.step", kDefaultFileCap + 1);
  expect_refused("FILE-TOO-LARGE");
}

class HostileHelper : public HostileCad {
 protected:
  void helper(const std::string& script) {
    const auto path = folder_ / "capstan-brep";
    std::ofstream(path) << "#!/bin/sh\necho $$ >'" << (folder_ / "pid").string() << "'\n" << script << "\n";
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    ::setenv("CAPSTAN_BREP", path.c_str(), 1);
  }
  void TearDown() override { ::unsetenv("CAPSTAN_BREP"); }
  /// Whether the helper that ran last is gone, at once or when it is reaped.
  [[nodiscard]] bool gone() const {
    pid_t pid = 0;
    std::ifstream(folder_ / "pid") >> pid;
    if (pid <= 0) return false;
    for (int i = 0; i < 2000; ++i) {
      std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
      std::string number, name, state;
      if (!(stat >> number >> name >> state) || state == "Z") return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }
};

TEST_F(HostileHelper, OneThatIsKilledIsOneError) {
  helper("kill -KILL $$");
  put("part.step", boxed());
  expect_refused("[BREP-CRASH]");
  EXPECT_TRUE(gone());
}

TEST_F(HostileHelper, OneThatSaysNothingIsOneError) {
  helper("cat >/dev/null");
  put("part.step", boxed());
  expect_refused("[BREP-MESSAGE]");
  EXPECT_TRUE(gone());
}

// The command is interrupted, and killed, while the helper hangs.
TEST_F(HostileHelper, OneThatHangsIsGoneWithTheCommand) {
  for (const char* signal : {"INT", "TERM", "KILL"}) {
    helper("exec sleep 600");
    put("part.step", boxed());
    const std::string line = "cd '" + folder_.string() + "' && timeout -s " + signal + " 1 " +
                             command_quoted() +
                             " plan part.step -o part.json -o part.ngc >stdout.txt 2>stderr.txt";
    EXPECT_NE(std::system(line.c_str()), 0) << signal;
    EXPECT_TRUE(gone()) << signal;
    EXPECT_THAT(files(), ::testing::ElementsAre("capstan-brep", "part.step", "pid")) << signal;
    std::filesystem::remove(folder_ / "pid");
  }
}

}  // namespace
}  // namespace capstan::app
