#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "planner/model/nouns/all.h"
#include "planner/model/plan/cutter_path.h"

// The header entities of a plan's paths: their keywords, and their columns in order. For the two files that
// write and read them (exact_paths.h).

namespace capstan::exchange::path_columns {

using model::CutterPath;

inline constexpr std::string_view kPath = "!CAPSTAN_PATH", kSchedule = "!CAPSTAN_SCHEDULE",
                                  kSections = "!CAPSTAN_SECTIONS", kStepPath = "!CAPSTAN_STEP_PATH",
                                  kToolpath = "!CAPSTAN_TOOLPATH";

inline constexpr std::array<std::vector<double> CutterPath::*, 5> kPathColumns = {
    &CutterPath::x, &CutterPath::y, &CutterPath::z, &CutterPath::cx, &CutterPath::cy};
inline constexpr std::array<std::vector<double> model::FeedSchedule::*, 3> kScheduleColumns = {
    &model::FeedSchedule::feed_mm_min, &model::FeedSchedule::spindle_rpm, &model::FeedSchedule::dwell_s};
inline constexpr std::array<std::vector<double> model::SectionSeries::*, 9> kSectionColumns = {
    &model::SectionSeries::at_mm,        &model::SectionSeries::ad_max_mm,
    &model::SectionSeries::rd_max_mm,    &model::SectionSeries::x_max_ofs_mm,
    &model::SectionSeries::y_max_ofs_mm, &model::SectionSeries::csa_mm2,
    &model::SectionSeries::x_cg_ofs_mm,  &model::SectionSeries::y_cg_ofs_mm,
    &model::SectionSeries::removed_mm3};

/// How a type of toolpath is spelled, by the descriptor's enumerators.
inline const model::Attribute& type_attribute() {
  return *model::find_attribute(model::TypeId::kCutterLocationTrajectory, "its_type");
}

}  // namespace capstan::exchange::path_columns
