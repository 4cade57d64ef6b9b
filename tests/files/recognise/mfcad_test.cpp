#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <random>
#include <sstream>

#include "tests/files/recognise/changed_brep.h"
#include "tests/files/recognise/mfcad.h"
#include "tests/files/recognise/planar_step.h"
#include "tests/support/corpus.h"

namespace capstan::testing {
namespace {

using recognise::Recognition;

/// The labelled parts, by name.
std::vector<std::string> parts() {
  std::vector<std::string> stems;
  for (const auto& entry : std::filesystem::directory_iterator(corpus_folder() + "/cad/mfcad")) {
    if (entry.path().extension() == ".step") stems.push_back(entry.path().stem().string());
  }
  std::sort(stems.begin(), stems.end());
  return stems;
}

std::string file_of(const std::string& stem, const char* extension) {
  return corpus_folder() + "/cad/mfcad/" + stem + extension;
}

struct Score {
  std::size_t faces = 0;
  std::size_t faces_right = 0;
  std::size_t parts = 0;
  std::size_t parts_right = 0;
  double seconds = 0;
  std::array<std::array<std::size_t, kMfcadClasses + 1>, kMfcadClasses> confusion{};
};

std::string to_text(const Score& score) {
  std::ostringstream text;
  text << score.faces_right << " of " << score.faces << " faces, " << score.parts_right << " of "
       << score.parts << " parts, " << 1e3 * score.seconds / static_cast<double>(score.parts)
       << " ms CPU a part\n";
  text << "label by row, recognised as by column, the last: none\n";
  for (const auto& row : score.confusion) {
    for (const std::size_t n : row) text << n << ' ';
    text << '\n';
  }
  return text.str();
}

// The gates of recognition: 99.0 % of faces and 90 % of parts, aimed at 99.6 % and 97 %, in at most 0.1 s CPU
// a part.
TEST(Mfcad, FacesHaveTheClassesOfTheirLabels) {
  CAPSTAN_CORPUS_FILE(folder, "cad/mfcad");
  Score score;
  for (const std::string& stem : parts()) {
    const exchange::Brep brep = read_planar_step(slurp(file_of(stem, ".step")));
    const std::vector<int> labels = mfcad_labels(slurp(file_of(stem, ".labels.json")));
    ASSERT_EQ(brep.faces.size(), labels.size()) << stem;
    const std::clock_t before = std::clock();
    const Recognition found = recognise::recognise(brep);
    score.seconds += static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
    const std::vector<int> classes = mfcad_classes(brep, found);
    std::size_t right = 0;
    for (std::size_t f = 0; f < labels.size(); ++f) {
      const int label = labels.at(static_cast<std::size_t>(std::stoi(brep.faces[f].name)));
      const int column = classes[f] == kNoMfcadClass ? kMfcadClasses : classes[f];
      ++score.confusion[static_cast<std::size_t>(label)][static_cast<std::size_t>(column)];
      if (label == classes[f]) ++right;
    }
    score.faces += labels.size();
    score.faces_right += right;
    ++score.parts;
    if (right == labels.size()) ++score.parts_right;
  }
  std::cout << folder << ": " << to_text(score);
  ASSERT_GE(score.parts, 570U);
  EXPECT_GE(static_cast<double>(score.faces_right), 0.996 * static_cast<double>(score.faces));
  EXPECT_GE(static_cast<double>(score.parts_right), 0.97 * static_cast<double>(score.parts));
  EXPECT_LE(score.seconds, 0.1 * static_cast<double>(score.parts));
}

TEST(Mfcad, EveryFaceStandsOnce) {
  CAPSTAN_CORPUS_FILE(folder, "cad/mfcad");
  for (const std::string& stem : parts()) {
    const exchange::Brep brep = read_planar_step(slurp(file_of(stem, ".step")));
    const Recognition found = recognise::recognise(brep);
    std::vector<int> times(brep.faces.size(), 0);
    for (const std::uint32_t f : found.on_raw) ++times[f];
    for (const recognise::Feature& feature : found.features) {
      for (const std::uint32_t f : feature.faces) ++times[f];
    }
    for (const recognise::Rest& rest : found.unrecognised) {
      for (const std::uint32_t f : rest.faces) ++times[f];
    }
    EXPECT_EQ(times, std::vector<int>(brep.faces.size(), 1)) << folder << " " << stem;
  }
}

constexpr double kInch = 25.4;

/// 200 of the parts, evenly.
std::vector<std::string> some_parts() {
  const std::vector<std::string> all = parts();
  std::vector<std::string> chosen;
  for (std::size_t i = 0; i < 200; ++i) chosen.push_back(all[i * all.size() / 200]);
  return chosen;
}

TEST(Recognition, StaysWhenThePartIsTurned) {
  CAPSTAN_CORPUS_FILE(folder, "cad/mfcad");
  std::mt19937_64 random(18);
  for (const std::string& stem : some_parts()) {
    const exchange::Brep brep = read_planar_step(slurp(file_of(stem, ".step")));
    const auto expected = summary(brep, recognise::recognise(brep), 1.0);
    for (int i = 0; i < 10; ++i) {
      const exchange::Brep other = turned(brep, random);
      ASSERT_EQ(summary(other, recognise::recognise(other), 1.0), expected) << folder << " " << stem;
    }
  }
}

TEST(Recognition, StaysWhenFacesAreShuffledSplitOrInInches) {
  CAPSTAN_CORPUS_FILE(folder, "cad/mfcad");
  std::mt19937_64 random(19);
  for (const std::string& stem : some_parts()) {
    const exchange::Brep brep = read_planar_step(slurp(file_of(stem, ".step")));
    const auto expected = summary(brep, recognise::recognise(brep), 1.0);
    const exchange::Brep mixed = shuffled(brep, random);
    EXPECT_EQ(summary(mixed, recognise::recognise(mixed), 1.0), expected) << folder << " " << stem;
    const exchange::Brep inch = turned(brep, random, kInch);
    EXPECT_EQ(summary(inch, recognise::recognise(inch), kInch), expected) << stem;
    const exchange::Brep halves = split(brep, random, 4);
    ASSERT_GT(halves.faces.size(), brep.faces.size()) << stem;
    EXPECT_EQ(summary(halves, recognise::recognise(halves), 1.0), expected) << stem;
    const exchange::Brep all = turned(shuffled(halves, random), random, kInch);
    EXPECT_EQ(summary(all, recognise::recognise(all), kInch), expected) << stem;
  }
}

}  // namespace
}  // namespace capstan::testing
