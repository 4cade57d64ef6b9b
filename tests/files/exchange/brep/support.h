#pragma once

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "planner/files/exchange/brep/message.h"
#include "planner/files/exchange/brep/read_brep.h"
#include "tests/support/corpus.h"
#include "tests/support/processes/children.h"

namespace capstan::exchange::testing {

/// The helper of this build, or empty where it is built without OpenCASCADE.
inline std::string helper() {
  const auto build = std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path();
  const auto path = build / "planner" / "door" / "app" / "capstan-brep";
  return std::filesystem::exists(path) ? path.string() : std::string();
}

/// A program in the shell's language, in place of the helper.
inline std::string script(const capstan::testing::ScratchFolder& folder, const std::string& text) {
  const std::string path = folder.file("helper.sh");
  std::ofstream(path) << "#!/bin/sh\n" << text << "\n";
  ::chmod(path.c_str(), 0700);
  return path;
}

using capstan::testing::children;

/// A message with something in each field, its sizes chosen by `random`.
inline BrepMessage some_message(std::mt19937& random) {
  const auto upto = [&random](unsigned n) { return std::uniform_int_distribution<unsigned>(0, n)(random); };
  const auto real = [&random] { return std::normal_distribution<double>(0.0, 1e3)(random); };
  const auto point = [&] { return geometry::Vec3{real(), real(), real()}; };
  const auto text = [&] {
    std::string out(upto(12), '\0');
    for (char& c : out) c = static_cast<char>(upto(255));
    return out;
  };
  BrepMessage m;
  for (unsigned i = upto(3); i > 0; --i)
    m.remarks.push_back({.code = text(),
                         .severity = static_cast<Severity>(upto(2)),
                         .message = text(),
                         .instance = upto(1000),
                         .expected = text(),
                         .hint = text()});
  Brep& b = m.brep.emplace();
  const unsigned faces = 1 + upto(6), edges = 1 + upto(9), points = 1 + upto(9);
  for (unsigned i = 0; i < points; ++i) b.points.push_back(point());
  for (unsigned i = 0; i < faces; ++i) {
    Face f{.carrier = static_cast<Carrier>(upto(6)),
           .point = point(),
           .axis = point(),
           .radius = real(),
           .minor_radius = real(),
           .half_angle = real(),
           .same_sense = upto(1) == 1,
           .outward = upto(1) == 1,
           .id = static_cast<std::int64_t>(upto(9999)),
           .name = text(),
           .loops = {},
           .first_triangle = static_cast<std::uint32_t>(b.triangles.size()),
           .triangle_count = upto(4),
           .area = real()};
    for (unsigned n = upto(2); n > 0; --n) {
      Loop& loop = f.loops.emplace_back();
      for (unsigned k = upto(5); k > 0; --k) {
        loop.edges.push_back(upto(edges - 1));
        loop.forward.push_back(upto(1) == 1);
      }
    }
    for (unsigned n = f.triangle_count; n > 0; --n)
      b.triangles.push_back({upto(points - 1), upto(points - 1), upto(points - 1)});
    b.faces.push_back(std::move(f));
  }
  for (unsigned i = 0; i < edges; ++i)
    b.edges.push_back({.curve = static_cast<Curve>(upto(4)),
                       .start = point(),
                       .end = point(),
                       .middle = point(),
                       .centre = point(),
                       .axis = point(),
                       .radius = real(),
                       .minor_radius = real(),
                       .length = real(),
                       .face = {upto(faces - 1), upto(faces - 1)},
                       .convexity = static_cast<Convexity>(upto(3)),
                       .dihedral = real()});
  for (unsigned left = faces; left > 0;) {
    const unsigned n = 1 + upto(left - 1);
    b.bodies.push_back({.solid = upto(1) == 1,
                        .first_face = faces - left,
                        .face_count = n,
                        .volume = real(),
                        .area = real(),
                        .id = static_cast<std::int64_t>(upto(99)),
                        .name = text()});
    left -= n;
  }
  b.chord = real();
  b.unit = text();
  b.box = {point(), point()};
  return m;
}

}  // namespace capstan::exchange::testing
