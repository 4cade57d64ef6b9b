#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/door/service/request.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"

// A shop's own settings in one file, which stand for options that a call leaves out:
//
//     capstan_shop: 1
//     machine: mill.yaml        # any option of the table with Option::of_shop, by its name
//     tools: tool.tbl
//     materials: [our_bronze.yaml]
//     fixtures: [our_vises.yaml]       # capstan_fixtures: 1; --workholding finds them by their ids
//     holders: {default: ER32, list: [...]}  # tooling/library/cutters/holders.h
//     texts: {title: "ACME, cell 3", header: ["ACME, CELL 3"], footer: ["CLEAN THE VISE"]}
//
// Paths count from the file's folder.

namespace capstan::service {

inline constexpr const char* kShopFile = "shop.yaml";
/// As a value of the option: no shop file is looked for.
inline constexpr const char* kNoShop = "none";

/// The shop file that a command finds: `shop.yaml` in the working folder, else in $XDG_CONFIG_HOME/capstan,
/// or where that is not set in ~/.config/capstan; nothing: there is none. A file of that name without an
/// entry `capstan_shop` is something else (tools, rules) and is passed over, and so is a folder that this
/// user may not look into.
///
/// Fails  SHOP-FILE, FILE-READ or as tooling::parse_tree, with the file, where one of that name is there and
///        cannot be read: whose settings hold is not known then.
[[nodiscard]] Result<std::optional<std::string>> found_shop();

/// The request with what its shop file (Request::shop) says and the caller does not. Where the caller names a
/// machine, the file's control is not that machine's, and is left out. Request::from_shop says what came from
/// the file.
///
/// Fails  as tooling::parse_tree; SHOP-FILE for another shape or version; NAME-UNKNOWN for an entry that
///        there is not; OPTION-VALUE; each with file and line.
[[nodiscard]] Result<Request> with_shop(Request request, Job& job);

/// The same, of the file's text.
[[nodiscard]] Result<Request> with_shop_text(Request request, std::string_view text, Job& job);

/// A shop file to fill in: every entry with what it is, as a comment; those that are given
/// ("machine=mill.yaml") hold. They are tried out: machine, tools, rules, cases, material and workholding are
/// read as a plan would read them; a cache that is not there is left to be made.
///
/// path   where it will stand: paths count from its folder
///
/// Fails  as with_shop_text, gather and tooling::find_material, all faults reported; OPTION-VALUE for one
///        without '='.
[[nodiscard]] Result<std::string> shop_template(const std::vector<std::string>& given,
                                                const std::string& path, Job& job);

/// The entries of the request's shop file and what of them holds, for people.
[[nodiscard]] Result<std::string> shop_text(const Request& request, Job& job);

}  // namespace capstan::service
