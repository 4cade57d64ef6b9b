#pragma once

#include <string>

#include "tests/validation/nist/plate_time.h"
#include "tests/validation/report.h"

namespace capstan::validation {

/// Bores milled by the slender end mills of the NIST plates: measured sizes, and what the model holds of
/// them.
[[nodiscard]] Comparison small_holes(const nist::Plate& plate, const nist::TimeStudy& study,
                                     const std::vector<nist::Measured>& measured);

/// The extended life law on the NASA milling data, with leave-one-out prediction.
[[nodiscard]] Comparison wear(const std::string& corpus);

/// Mean and peak forces against the tabulated cases, and the spread between published coefficients.
[[nodiscard]] Comparison forces();

/// Milling power by published tables and by our law.
[[nodiscard]] Comparison power();

/// Feeds in slots beside a maker's, by the diameter.
[[nodiscard]] Comparison slots();

/// Fits of Kienzle's law against the tables they are made from.
[[nodiscard]] Comparison kienzle();

/// The published problems by both solvers against the optima of our statement.
[[nodiscard]] Comparison optima();

/// Stability lobes against a simulation in time.
[[nodiscard]] Comparison lobes();

/// Measured sections of skewed paths against closed forms, by size of cell.
[[nodiscard]] Comparison sections();

/// Edits of emitted programs and what the check finds of them: `tests/mutation`.
[[nodiscard]] Comparison edits();

/// Edits of plans' files and what the check finds of them: `tests/mutation/plans`.
[[nodiscard]] Comparison plan_edits();

/// Machining times against a good shop's estimates, and what holds the parts that take longer.
[[nodiscard]] Comparison productivity(const std::string& corpus);

/// Times of plans over a catalogue's: all features, materials and machines as `capstan_catalogue_times`
/// recorded them in a file, and a sample planned now, which is held against the record.
[[nodiscard]] Comparison catalogue_times(const std::string& record, Extent extent);
/// Tuned speeds and feeds in simulated shops: no cases, regression only, Gaussian process.
[[nodiscard]] Comparison tuning(Extent extent);

/// The plates of the NIST test bed as cases: each plate's times and bores predicted from the others.
[[nodiscard]] Comparison plates(const std::string& corpus);

/// Roughing of pockets against FreeCAD's paths at equal limits (freecad/rivals.h); `record`: the times on
/// LinuxCNC's simulated machine, as `capstan_rival_times` recorded them.
[[nodiscard]] Comparison freecad(const std::string& record, Extent extent);

/// Recognition of MFCAD's labelled faces, tolerances read of NIST's parts, and the plans of both as
/// cad/record_plans.py recorded them in a file.
[[nodiscard]] Comparison recognition(const std::string& corpus, const std::string& record);

/// Cycle times on LinuxCNC's simulated machine, as `capstan_cycle_times` recorded them in a file.
[[nodiscard]] Comparison cycle_times(const std::string& file);

/// Times of late binding, as `capstan_bind_times` recorded them in a file.
[[nodiscard]] Comparison bind_times(const std::string& file);

}  // namespace capstan::validation
