#include <cstdlib>
#include <sstream>

#include "tests/removal/simulation/compare.h"

namespace capstan::testing::removal {
namespace {

// The instances of a written file, one a line: "#12=KEYWORD(...);".
std::map<std::string, std::string> instances(const std::string& text) {
  std::map<std::string, std::string> out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto equals = line.find('=');
    if (line.empty() || line.front() != '#' || equals == std::string::npos) continue;
    out[line.substr(0, equals)] = line.substr(equals + 1);
  }
  return out;
}

// Its parameters, those in brackets as one.
std::vector<std::string> parameters(const std::string& instance) {
  std::vector<std::string> out;
  int depth = 0;
  bool quoted = false;
  std::string now;
  for (std::size_t i = instance.find('(') + 1; i < instance.size(); ++i) {
    const char c = instance[i];
    if (c == '\'') quoted = !quoted;
    if (!quoted && c == ')' && depth-- == 0) break;
    if (!quoted && c == '(') ++depth;
    if (!quoted && c == ',' && depth == 0) {
      out.push_back(now);
      now.clear();
    } else {
      now += c;
    }
  }
  out.push_back(now);
  return out;
}

Point triple(const std::string& parameter) {
  Point p;
  const char* at = parameter.c_str() + parameter.find_first_of("-+.0123456789");
  char* end = nullptr;
  p.x = std::strtod(at, &end);
  p.y = std::strtod(end + 1, &end);
  p.z = std::strtod(end + 1, &end);
  return p;
}

// 1 to 3 and sign for a direction along an axis; 0 for any other.
int axis_of(const Point& d) {
  constexpr double kNear = 1e-6;
  const double length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
  const double v[3] = {d.x / length, d.y / length, d.z / length};
  for (int k = 0; k < 3; ++k) {
    if (std::abs(v[k] - 1.0) < kNear) return k + 1;
    if (std::abs(v[k] + 1.0) < kNear) return -(k + 1);
  }
  return 0;
}

double part(const Point& p, int axis) {
  const double v[3] = {p.x, p.y, p.z};
  return axis > 0 ? v[axis - 1] : -v[-axis - 1];
}

}  // namespace

std::map<int, Frame> frames_of(const std::string& iso14649, std::string& fault) {
  std::map<int, Frame> out;
  const auto all = instances(iso14649);
  const auto at = [&](const std::string& id) {
    const auto found = all.find(id);
    return found == all.end() ? std::string("NONE($,$,$,$,$)") : found->second;
  };
  std::istringstream lines(iso14649);
  for (std::string line; std::getline(lines, line);) {
    const std::string key = "!CAPSTAN_SETUP('";
    if (line.rfind(key, 0) != 0) continue;
    const std::string id = line.substr(key.size(), line.find('\'', key.size()) - key.size());
    const int number = static_cast<int>(out.size()) + 1;
    const std::string list = parameters(at(id)).at(3);  // of SETUP: its_workpiece_setup
    const auto hash = list.find('#');
    const std::string placed = at(list.substr(hash, list.find_first_of(",)", hash) - hash));
    const auto of_placement = parameters(at(parameters(placed).at(1)));
    if (of_placement.size() < 4) {
      fault = "set-up " + std::to_string(number) + " has no placement of the workpiece";
      return {};
    }
    const auto direction = [&](const std::string& ref, Point otherwise) {
      return ref == "$" ? otherwise : triple(parameters(at(ref)).at(1));
    };
    const Point o = triple(parameters(at(of_placement[1])).at(1));
    const Point z = direction(of_placement[2], {0, 0, 1}), x = direction(of_placement[3], {1, 0, 0});
    // Of the workpiece in the set-up: its axes as signed axes of the set-up.
    const int wx = axis_of(x), wz = axis_of(z);
    const Point y{z.y * x.z - z.z * x.y, z.z * x.x - z.x * x.z, z.x * x.y - z.y * x.x};
    const int wy = axis_of(y);
    if (wx == 0 || wy == 0 || wz == 0) {
      fault = "set-up " + std::to_string(number) + " does not lie along the axes of the workpiece";
      return {};
    }
    Frame f;
    const int of[3] = {wx, wy, wz};
    for (int k = 0; k < 3; ++k)
      f.axis[static_cast<std::size_t>(std::abs(of[k]) - 1)] = of[k] > 0 ? k + 1 : -(k + 1);
    f.origin = {-part(o, wx), -part(o, wy), -part(o, wz)};
    out[number] = f;
  }
  if (out.empty()) fault = "the file names no set-up";
  return out;
}

}  // namespace capstan::testing::removal
