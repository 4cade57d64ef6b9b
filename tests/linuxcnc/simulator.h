#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace capstan::linuxcnc {

/// A program for the simulated machine.
struct Order {
  std::string program;                    ///< G-code
  std::string tools;                      ///< tool table (.tbl)
  std::vector<std::string> offsets = {};  ///< "G54:0,0,-58": where a work offset's zero is on the machine, mm
  bool keep_samples = false;
  double rate = 16.0;  ///< how many times faster than real time; what is measured does not depend on it
};

/// What the machine did: columns, one entry per servo period (1 ms of its time).
struct Record {
  std::vector<double> x_mm, y_mm, z_mm;  ///< of the machine, at the spindle's nose
  std::vector<double> speed_mm_s;        ///< along the path; 0 where it stands
  std::vector<int> line;                 ///< of the program, from 1
  std::vector<double> rpm;               ///< of the spindle as it turns
  std::vector<int> tool;                 ///< in the spindle; 0: none
  std::vector<int> mark;                 ///< set by who runs the machine, to tell runs from each other
  std::vector<double> lag_mm;            ///< of the axes together, from where they were told to be
  std::vector<int> kind;                 ///< of move, as motion.motion-type: 1 rapid, 2 feed, 3 arc; 0 none
  std::string samples;                   ///< the same as the sampler wrote it, where it was to be kept
  std::string absent;                    ///< why there is no LinuxCNC to ask; empty: there is
  std::string failed;                    ///< why the program did not run to its end; empty: it did
  [[nodiscard]] std::size_t size() const { return line.size(); }
};

/// Seconds between two entries of a record. Source: SERVO_PERIOD of machine/machine.ini.
inline constexpr double kServoPeriod = 0.001;
/// Of Record::kind: a rapid move, G0. Source: motion.motion-type (LinuxCNC's manual page motion(9)).
inline constexpr int kRapid = 1;

/// Adds what simulated.py sampled, a row per servo period, to `out`; why it cannot be used, or nothing.
[[nodiscard]] std::string read_samples(std::string_view text, Record& out);

/// Runs the program on LinuxCNC without a screen (run.py) and waits for its end. One at a time on a computer:
/// others wait. Leaves no process, file or shared memory behind.
[[nodiscard]] Record run(const Order& order);

}  // namespace capstan::linuxcnc
