#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "planner/making/optimise/problem/problem.h"
#include "tests/making/optimise/differentiated.h"

/// Published machining problems as this project states them. Provenance of each number:
/// [S] read in a source named here, [M] recalled and not checked against the paper, [C] computed here.
/// The optima are those of *our statement*; the papers are cited for the form of the problem only.
namespace capstan::optimise::examples {

struct Example {
  const char* name = "";
  Problem problem;
  double best_objective = 0.0;
  std::vector<double> best_x;       ///< empty where it was not tabulated
  std::vector<std::string> active;  ///< constraints that hold it
};

inline constexpr double kPi = std::numbers::pi;

// --- Tolouei-Rad & Bidhendi 1997, Int. J. Mach. Tools Manuf. 37:1-16: five milling operations ------------

struct MillingOperation {
  const char* name;
  double depth_mm;
  double travel_mm;
  double ra_um;  ///< 0: none asked
  double v_low, v_high;
  double f_low, f_high;
  std::size_t tool;
};

struct MillingTool {
  double diameter_mm;
  double teeth;
  double price;
  double life_c, life_n;
  double lead_deg, clearance_deg;
  bool face;
};

// All [M].
inline constexpr std::array<MillingOperation, 5> kOperations = {{
    {"face", 10.0, 450.0, 2.0, 60.0, 120.0, 0.05, 0.4, 0},
    {"corner", 5.0, 90.0, 6.0, 40.0, 70.0, 0.05, 0.5, 1},
    {"pocket", 10.0, 450.0, 5.0, 40.0, 70.0, 0.05, 0.5, 1},
    {"slot 1", 10.0, 32.0, 0.0, 30.0, 50.0, 0.05, 0.5, 2},
    {"slot 2", 5.0, 84.0, 1.0, 30.0, 50.0, 0.05, 0.5, 2},
}};
inline constexpr std::array<MillingTool, 3> kTools = {{
    {50.0, 6.0, 49.50, 100.05, 0.30, 45.0, 5.0, true},
    {10.0, 4.0, 7.55, 33.98, 0.15, 0.0, 5.0, false},
    {12.0, 4.0, 7.55, 33.98, 0.15, 0.0, 5.0, false},
}};

/// Cutting-contact proportion Q is not known from the paper; 0.5 is our choice [C], as are a radial depth of
/// the full diameter and three tool changes.
struct MillingStatement {
  double contact = 0.5;  ///< Q
  bool power = true;     ///< false: the limit is left out
  bool roughness = true;
  enum class Goal { kProfitRate, kTime, kParametric } goal = Goal::kProfitRate;
  double earning = 0.0;  ///< of kParametric: cost + earning * time, $/min
};

template <class T>
void tolouei_rad(const std::array<T, 10>& x, const MillingStatement& statement, T& objective,
                 std::vector<T>& c, T& cost, T& time) {
  using std::pow;
  constexpr double kSalePrice = 25.0, kMaterial = 0.50, kLabour = 0.45, kOverhead = 1.45;   // [M]
  constexpr double kSetupMin = 2.0, kChangeMin = 0.5, kG = 0.14, kW = 0.28;                 // [M]
  constexpr double kPowerConstant = 2.24, kWear = 1.1, kMotorKw = 8.5, kEfficiency = 0.95;  // [M]
  constexpr double kChanges = 3.0;                                                          // [C]
  time = kSetupMin + kChanges * kChangeMin;
  T tool_cost = 0.0;
  std::size_t k = 0;
  for (std::size_t i = 0; i < kOperations.size(); ++i) {
    const MillingOperation& op = kOperations[i];
    const MillingTool& tool = kTools[op.tool];
    const T& v = x[2 * i];
    const T& f = x[2 * i + 1];
    const T cut = kPi * tool.diameter_mm * op.travel_mm / (1000.0 * tool.teeth * v * f);
    const T area = op.depth_mm * f;
    const T slenderness = op.depth_mm / f;
    const T life = 60.0 / statement.contact *
                   pow(tool.life_c * pow(slenderness / 5.0, kG) / (v * pow(area, kW)), 1.0 / tool.life_n);
    time = time + cut;
    tool_cost = tool_cost + tool.price * cut / life;
    T& power = c[k++];
    power = 0.78 * kPowerConstant * kWear * tool.teeth * tool.diameter_mm * op.depth_mm /
                (60.0 * kPi * tool.diameter_mm * kEfficiency * kMotorKw) * v * pow(f, 0.8) -
            1.0;
    if (!statement.power) power = -1.0;
    if (op.ra_um == 0.0) continue;
    T& roughness = c[k++];
    const double degree = kPi / 180.0;
    roughness =
        tool.face
            ? 318.0 * f /
                      ((std::tan(tool.lead_deg * degree) + 1.0 / std::tan(tool.clearance_deg * degree)) *
                       op.ra_um) -
                  1.0
            : 318.0 * f * f / (4.0 * tool.diameter_mm * op.ra_um) - 1.0;
    if (!statement.roughness) roughness = -1.0;
  }
  cost = kMaterial + (kLabour + kOverhead) * time + tool_cost;
  switch (statement.goal) {
    case MillingStatement::Goal::kProfitRate:
      objective = -(kSalePrice - cost) / time;  // $/min, maximised
      break;
    case MillingStatement::Goal::kTime:
      objective = time;
      break;
    case MillingStatement::Goal::kParametric:
      objective = cost + statement.earning * time;
      break;
  }
}

inline Example tolouei_rad_milling(Walk walk = Walk::kLogarithmic, MillingStatement statement = {}) {
  Example e{
      .name = "ToloueiRadMilling", .problem = {}, .best_objective = -2.6702, .best_x = {}, .active = {}};
  for (const MillingOperation& op : kOperations) {
    const std::string name = op.name;
    e.problem.variables.push_back(
        {name + " speed", "m/min", op.v_low, op.v_high, 0.5 * (op.v_low + op.v_high), walk});
    e.problem.variables.push_back({name + " feed", "mm", op.f_low, op.f_high, 0.1, walk});
    e.problem.constraints.push_back(name + " power");
    if (op.ra_um != 0.0) e.problem.constraints.push_back(name + " roughness");
  }
  e.problem.model = differentiate<10>([statement](const auto& x, auto& f, auto& c) {
    auto cost = f;
    auto time = f;
    tolouei_rad(x, statement, f, c, cost, time);
  });
  // [C]
  e.best_x = {101.414, 0.078176, 42.474, 0.5, 40.0, 0.41518, 34.472, 0.5, 47.221, 0.38851};
  e.active = {"face power", "face roughness", "pocket power", "slot 1 power", "slot 2 roughness"};
  return e;
}

// --- Chen & Tsai 1996, Int. J. Prod. Res.: multi-pass turning -----------------------------------------

/// Form of the objective [S] (as printed by Xie et al.); constants [M].
template <class T>
void chen_tsai(const std::array<T, 5>& x, double total_depth, int passes, T& objective, std::vector<T>& c) {
  using std::pow;
  const auto& [vr, fr, vs, fs, ds] = x;
  const T dr = (total_depth - ds) / static_cast<double>(passes);
  const auto life = [](const T& v, const T& f, const T& d) {
    return 6e11 / (pow(v, 5.0) * pow(f, 1.75) * pow(d, 0.75));
  };
  const auto force = [](const T& f, const T& d) { return 108.0 * pow(f, 0.75) * pow(d, 0.95); };
  const T tr = life(vr, fr, dr);
  const T ts = life(vs, fs, ds);
  const T tp = 0.8 * tr + 0.2 * ts;
  const T tm = kPi * 50.0 * 300.0 / 1000.0 * (static_cast<double>(passes) / (vr * fr) + 1.0 / (vs * fs));
  constexpr double kK0 = 0.5, kKt = 2.5;
  objective =
      kK0 * tm + kK0 * (0.75 + (7e-4 * 300.0 + 0.3) * (passes + 1)) + kK0 * 1.5 * tm / tp + kKt * tm / tp;
  std::size_t k = 0;
  for (const bool rough : {true, false}) {
    const T& v = rough ? vr : vs;
    const T& f = rough ? fr : fs;
    const T& d = rough ? dr : ds;
    const T& t = rough ? tr : ts;
    c[k++] = 25.0 / t - 1.0;
    c[k++] = t / 45.0 - 1.0;
    c[k++] = force(f, d) / 200.0 - 1.0;
    c[k++] = force(f, d) * v / (6120.0 * 0.85 * 5.0) - 1.0;
    c[k++] = 140.0 * d / (v * v * f) - 1.0;
    c[k++] = 132.0 * pow(v, 0.4) * pow(f, 0.2) * pow(d, 0.105) / 1000.0 - 1.0;
  }
  c[k++] = fs * fs / (8.0 * 1.2) / 0.010 - 1.0;
  c[k++] = vr / vs - 1.0;
  c[k++] = 2.5 * fs / fr - 1.0;
}

/// The linear limits on the depths (1 <= d_r, d_s <= 3, d_r >= d_s) are taken into the bounds of d_s; with
/// 6 mm in one roughing pass they leave d_s = 3 alone.
inline Example chen_tsai_turning(double total_depth, int passes, double best) {
  Example e{.name = "ChenTsaiTurning", .problem = {}, .best_objective = best, .best_x = {}, .active = {}};
  if (total_depth == 6.0 && passes == 1) e.best_x = {109.663, 0.56553, 169.978, 0.22621, 3.0};  // [C]
  const double ds_low = std::max(1.0, total_depth - 3.0 * passes);
  const double ds_high = std::min({3.0, total_depth / (passes + 1), total_depth - passes});
  e.problem.variables = {{"rough speed", "m/min", 50.0, 500.0, 150.0, Walk::kLogarithmic},
                         {"rough feed", "mm", 0.1, 0.9, 0.4, Walk::kLogarithmic},
                         {"finish speed", "m/min", 50.0, 500.0, 200.0, Walk::kLogarithmic},
                         {"finish feed", "mm", 0.1, 0.9, 0.15, Walk::kLogarithmic},
                         {"finish depth", "mm", ds_low, ds_high, 0.5 * (ds_low + ds_high)}};
  for (const std::string pass : {"rough", "finish"}) {
    for (const char* what : {" least life", " most life", " force", " power", " stability", " temperature"}) {
      e.problem.constraints.push_back(pass + what);
    }
  }
  for (const char* name : {"roughness", "speed order", "feed order"})
    e.problem.constraints.emplace_back(name);
  e.problem.model =
      differentiate<5>([=](const auto& x, auto& f, auto& c) { chen_tsai(x, total_depth, passes, f, c); });
  return e;
}

// --- Quiza Sardinas 2006: turning, two objectives -----------------------------------------------------

enum class QuizaGoal { kTime, kWear, kWearWithinTime };

/// Whole definition [S] (romden/engineering, MetalCutting.java, after Bandaru & Deb 2015).
template <class T>
void quiza(const std::array<T, 3>& x, QuizaGoal goal, T& objective, std::vector<T>& c) {
  using std::pow;
  const auto& [v, f, a] = x;
  constexpr double kVolume = 219912.0, kEta = 0.7976;
  const T life = 5.48e9 / (pow(v, 3.46) * pow(f, 0.696) * pow(a, 0.46));
  const T force = 6560.0 * pow(f, 0.917) * pow(a, 1.10) / pow(v, 0.286);
  const T rate = 1000.0 * v * f * a;
  const T time = 0.15 + kVolume * (1.0 + 0.2 / life) / rate + 0.05;
  const T wear = 100.0 * kVolume / (rate * life);
  objective = goal == QuizaGoal::kTime ? time : wear;
  c[0] = force / 5000.0 - 1.0;
  c[1] = v * force / 60000.0 / (kEta * 10.0) - 1.0;
  c[2] = 125.0 * f * f / 0.8 / 50.0 - 1.0;
  if (goal == QuizaGoal::kWearWithinTime) c[3] = time - 1.0;
}

inline Example quiza_turning(QuizaGoal goal) {
  Example e{.name = "QuizaTurning", .problem = {}, .best_objective = 0.0, .best_x = {}, .active = {"power"}};
  e.problem.variables = {{"speed", "m/min", 250.0, 400.0, 300.0, Walk::kLogarithmic},
                         {"feed", "mm", 0.15, 0.55, 0.3, Walk::kLogarithmic},
                         {"depth", "mm", 0.5, 6.0, 2.0, Walk::kLogarithmic}};
  e.problem.constraints = {"force", "power", "roughness"};
  if (goal == QuizaGoal::kWearWithinTime) e.problem.constraints.emplace_back("time");
  e.problem.model = differentiate<3>([=](const auto& x, auto& f, auto& c) { quiza(x, goal, f, c); });
  switch (goal) {  // [C]
    case QuizaGoal::kTime:
      e.best_objective = 0.81916;
      e.best_x = {400.0, 0.55, 1.66393};
      break;
    case QuizaGoal::kWear:
      e.best_objective = 2.06985;
      e.best_x = {250.0, 0.170263, 6.0};
      break;
    case QuizaGoal::kWearWithinTime:
      e.best_objective = 2.2189;
      e.best_x = {250.0, 0.2740, 4.0361};
      break;
  }
  return e;
}

// --- Textbook speeds and a drilled hole ----------------------------------------------------------------

/// Ghosh & Mallik, Manufacturing Science, examples 4.26 and 4.28 (solutions by FOSSEE, Scilab-TBC-Uploads
/// 3250/CH4): inputs [S], values [C]. Cost per length of cut: Lc / V + (Lc t + Tc) / (V T), T = (C /
/// V)^(1/n); time per length: 1 / V + t / (V T).
inline Example textbook_speed(bool least_cost) {
  Example e{.name = least_cost ? "LeastCostSpeed" : "MostProductionSpeed",
            .problem = {},
            .best_objective = 0.0,
            .best_x = {least_cost ? 27.417 : 47.921},
            .active = {}};
  e.problem.variables = {{"speed", "m/min", 5.0, 200.0, 100.0, Walk::kLogarithmic}};
  e.problem.model = differentiate<1>([least_cost](const auto& x, auto& f, auto&) {
    using std::pow;
    constexpr double kC = 75.0, kN = 0.25, kLabour = 0.15, kTool = 2.5, kChange = 2.0;  // [S]
    const auto& v = x[0];
    const auto life = pow(kC / v, 1.0 / kN);
    f = least_cost ? kLabour / v + (kLabour * kChange + kTool) / (v * life) : 1.0 / v + kChange / (v * life);
  });
  const double v = e.best_x[0];
  const double life = std::pow(75.0 / v, 4.0);
  e.best_objective = least_cost ? 0.15 / v + 2.8 / (v * life) : 1.0 / v + 2.0 / (v * life);
  return e;
}

/// A hole of 10 mm, 25 mm deep, at least cost; stated here, from no paper. V T^0.2 f^0.4 = 25.9; thrust
/// 6170 f^0.7 <= 3000 N; machine 1, change 1 min, edge 8. Optimum [C], also in closed form:
/// f = (3000 / 6170)^(1 / 0.7), V = C f^-0.4 [n / (1 - n) r / (r tc + ct)]^n.
inline Example drilled_hole() {
  Example e{.name = "DrilledHole",
            .problem = {},
            .best_objective = 0.144008,
            .best_x = {19.0981, 0.356963},
            .active = {"thrust"}};
  e.problem.variables = {{"speed", "m/min", 5.0, 60.0, 15.0, Walk::kLogarithmic},
                         {"feed", "mm", 0.05, 1.0, 0.2, Walk::kLogarithmic}};
  e.problem.constraints = {"thrust"};
  e.problem.model = differentiate<2>([](const auto& x, auto& f, auto& c) {
    using std::pow;
    const auto& [v, feed] = x;
    const auto life = pow(25.9 / (v * pow(feed, 0.4)), 5.0);
    const auto time = kPi * 10.0 * 25.0 / (1000.0 * v * feed);
    f = time + (1.0 + 8.0) * time / life;
    c[0] = 6170.0 * pow(feed, 0.7) / 3000.0 - 1.0;
  });
  return e;
}

// --- What the contract is tried on --------------------------------------------------------------------

/// min (x-3)^2 + (y-2)^2, x + y <= 3: (2, 1), objective 2, multiplier 2.
inline Problem projected_point(double limit = 3.0) {
  return {.variables = {{"x", "mm", 0.0, 5.0, 0.1}, {"y", "mm", 0.0, 5.0, 4.0}},
          .constraints = {"sum"},
          .model = differentiate<2>([limit](const auto& x, auto& f, auto& c) {
            f = (x[0] - 3.0) * (x[0] - 3.0) + (x[1] - 2.0) * (x[1] - 2.0);
            c[0] = x[0] + x[1] - limit;
          })};
}

}  // namespace capstan::optimise::examples
