#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <map>

#include "tests/files/exchange/brep/support.h"
#include "tests/files/recognise/changed_brep.h"

// Real parts: NIST's test cases, read by OpenCASCADE.

namespace capstan::testing {
namespace {

using exchange::Brep;
using model::TypeId;
using recognise::Recognition;

class NistParts : public ::testing::Test {
 protected:
  void SetUp() override {
    if (corpus_folder().empty()) GTEST_SKIP() << "corpus is absent";
    if (exchange::testing::helper().empty()) GTEST_SKIP() << "built without OpenCASCADE";
  }
  /// The part, or nothing where its geometry is not a B-rep.
  static std::optional<Brep> read(const std::string& path) {
    exchange::BrepLimits limits;
    limits.helper = exchange::testing::helper();
    limits.chord_mm = 0.1;
    Job job;
    auto brep = exchange::read_brep(path, limits, job);
    if (!brep) return std::nullopt;
    return *std::move(brep);
  }
  static std::vector<std::string> files() {
    std::vector<std::string> found;
    for (const char* folder : {"/cad", "/cad/nist"}) {
      for (const auto& entry : std::filesystem::directory_iterator(corpus_folder() + folder)) {
        if (entry.path().extension() == ".stp") found.push_back(entry.path().string());
      }
    }
    std::sort(found.begin(), found.end());
    return found;
  }
};

// Accounting: every face is in a feature, on the raw piece or unrecognised with a reason; of the last, at
// most 3 %. Time: at most 5 s CPU.
TEST_F(NistParts, EveryFaceStandsOnceAndFewAreUnrecognised) {
  std::size_t parts = 0;
  for (const std::string& path : files()) {
    const auto brep = read(path);
    if (!brep) continue;
    ++parts;
    for (std::size_t b = 0; b < brep->bodies.size(); ++b) {
      const exchange::Body& body = brep->bodies[b];
      const std::clock_t before = std::clock();
      const Recognition found = recognise::recognise(*brep, b);
      EXPECT_LE(static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC, 5.0) << path;
      std::vector<int> times(brep->faces.size(), 0);
      for (const std::uint32_t f : found.on_raw) ++times[f];
      for (const recognise::Feature& feature : found.features) {
        EXPECT_FALSE(feature.reason.empty());
        for (const std::uint32_t f : feature.faces) ++times[f];
      }
      std::size_t unrecognised = 0;
      for (const recognise::Rest& rest : found.unrecognised) {
        EXPECT_FALSE(rest.reason.empty());
        unrecognised += rest.faces.size();
        for (const std::uint32_t f : rest.faces) ++times[f];
      }
      for (std::uint32_t f = 0; f < brep->faces.size(); ++f) {
        const bool inside = f >= body.first_face && f - body.first_face < body.face_count;
        EXPECT_EQ(times[f], inside ? 1 : 0) << path << " face " << f;
      }
      EXPECT_LE(static_cast<double>(unrecognised), 0.03 * body.face_count) << path;
    }
  }
  EXPECT_GE(parts, 12U);
}

TEST_F(NistParts, FrameAndOrderOfFacesDoNotMatter) {
  std::mt19937_64 random(20);
  for (const char* part :
       {"ctc_01_asme1_ap242-e1", "ctc_03_asme1_ap242-e2", "ftc_06_asme1_rd", "ftc_09_asme1_rd"}) {
    const std::string path = corpus_folder() + "/cad/nist/nist_" + part + ".stp";
    const auto brep = read(path);
    ASSERT_TRUE(brep) << path;
    const auto expected = summary(*brep, recognise::recognise(*brep), 1.0);
    for (int i = 0; i < 3; ++i) {
      const Brep other = turned(shuffled(*brep, random), random);
      EXPECT_EQ(summary(other, recognise::recognise(other), 1.0), expected) << path;
    }
  }
}

// In inches its pairs of coaxial cylinders are 4 x 0.415 and 0.625; 2 x 0.5625 and 0.8125; 4 x 0.281 and
// 0.400.
TEST_F(NistParts, CounterboresOfFtc06HaveTheSizesOfItsCylinders) {
  constexpr double kInch = 25.4;
  const auto brep = read(corpus_folder() + "/cad/nist/nist_ftc_06_asme1_rd.stp");
  ASSERT_TRUE(brep);
  std::map<std::pair<long, long>, int> counted;
  for (const recognise::Feature& f : recognise::recognise(*brep).features) {
    if (f.type != TypeId::kCounterboreHole) continue;
    EXPECT_TRUE(f.through);
    std::map<std::string, double> sizes;
    for (const recognise::Parameter& p : f.parameters) sizes[p.name] = p.value;
    ++counted[{std::lround(1e4 * sizes["diameter"] / kInch),
               std::lround(1e4 * sizes["counterbore_diameter"] / kInch)}];
  }
  EXPECT_EQ(counted,
            (std::map<std::pair<long, long>, int>{{{4150, 6250}, 4}, {{5625, 8125}, 2}, {{2810, 4000}, 4}}));
}

}  // namespace
}  // namespace capstan::testing
