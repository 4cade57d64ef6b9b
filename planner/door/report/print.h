#pragma once

#include <string>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"

namespace capstan::report {

/// The browser that prints: the first of chromium, chromium-browser, google-chrome and google-chrome-stable
/// that the folders of PATH have.
/// Fails  OUT-BROWSER: none is there.
[[nodiscard]] Result<std::string> find_browser();

/// A page of html() as a PDF: printed by the browser, in a folder of its own that is gone afterwards, without
/// network and with a limit of time.
///
/// Determinism  the same page, browser and fonts, the same bytes: what the browser writes of the time is left
///              out (timeless).
/// Fails        as find_browser; OUT-PRINT: the browser ended without a PDF, or took too long; FILE-WRITE;
///              APP-STOPPED with the job.
/// Cost         some seconds, in a process of its own.
[[nodiscard]] Result<std::string> printed(const std::string& page, const Job& job);

/// A PDF without the dates of its making. Its length stays, and so does where everything lies in it.
[[nodiscard]] std::string timeless(std::string pdf);

}  // namespace capstan::report
