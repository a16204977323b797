// Geared systems from textbooks with complete data, as texts of equations, and what was printed of
// them. doc/validation.md says where each number comes from.
#pragma once

#include <string>
#include <vector>

namespace gearsweep::testing {

// Three shafts on one hub of rigidly meshing gears. a, b, c: their twists, with each inertia `m`
// and stiffness `k` referred to the hub's speed. Friswell, Penny, Garvey and Lees, Dynamics of
// Rotating Machines (2010), chapter 9.
inline std::string geared_hub() {
  return R"toml([model]
name = "geared_hub"
summary = "three shafts on one hub of gears"
[states]
a = { start = "0" }
b = { start = "0" }
c = { start = "0" }
u = { start = "0" }
v = { start = "0" }
w = { start = "0" }
[parameters]
interval = { value = 1e-4, min = 1e-9 }
hub = { value = 1.0, min = 1e-9 }
m1 = { value = 1.0, min = 1e-9 }
m2 = { value = 1.0, min = 1e-9 }
m3 = { value = 1.0, min = 1e-9 }
k1 = 1.0
k2 = 1.0
k3 = 1.0
[constants]
turn = "(k1*a + k2*b + k3*c)/hub"
[equations]
a = "u"
b = "v"
c = "w"
u = "-k1*a/m1 - turn"
v = "-k2*b/m2 - turn"
w = "-k3*c/m3 - turn"
[forcing]
period = "interval"
)toml";
}

// A ship's propeller that two steam turbines drive, each over two rigid gear meshes. Gunter
// and Chen, Introduction to Dynamics of Rotor-Bearing Systems, example 8.1. Twists of the five
// shafts, then the speeds; lbf in times 10^6, and seconds. The propeller is shaken five times a
// turn by a tenth of its torque. `damped` = 0 leaves out all dampers.
inline std::string ship_drive() {
  return R"toml([model]
name = "ship_drive"
summary = "propeller, two turbines and their gears"
max_step = 0.002
[states]
prop = { start = "0" }
low = { start = "0" }
low_turbine = { start = "0" }
high = { start = "0" }
high_turbine = { start = "0" }
w = { start = "0" }
u1 = { start = "0" }
u2 = { start = "0" }
u3 = { start = "0" }
u4 = { start = "0" }
u5 = { start = "0" }
[parameters]
rpm = { value = 60.0, min = 1.0, max = 1e6 }
damped = 1.0
ratio = 9.4094
low_ratio = 40.0424
high_ratio = 78.2365
material = { value = 0.0, min = 0.0 }
[constants]
c = "damped*material"
t1 = "826*(prop + c*u1)"
t2 = "203.94*ratio^2*(low + c*u2)"
t3 = "30.51*low_ratio^2*(low_turbine + c*u3)"
t4 = "24.17*ratio^2*(high + c*u4)"
t5 = "14.26*high_ratio^2*(high_turbine + c*u5)"
hub = "(t1 + t2 + t4)/0.826"
shake = "0.1*22.24*(rpm/85)^2*cos(phase)"
a1 = "(shake - t1 - damped*3.86*(w + u1))/2.454"
a2 = "(t3 - t2)/(0.01283*ratio^2)"
a3 = "-t3/(0.01509*low_ratio^2) - damped*0.00010877/0.01509*(w + u2 + u3)"
a4 = "(t5 - t4)/(0.02723*ratio^2)"
a5 = "-t5/(0.0002612*high_ratio^2) - damped*0.000042738/0.0002612*(w + u4 + u5)"
[equations]
prop = "u1"
low = "u2"
low_turbine = "u3"
high = "u4"
high_turbine = "u5"
w = "hub"
u1 = "a1 - hub"
u2 = "a2 - hub"
u3 = "a3 - a2"
u4 = "a4 - hub"
u5 = "a5 - a4"
[forcing]
period = "12/rpm"
[signals]
torque = { expression = "826*prop", unit = "10^6 lbf in", meaning = "torque of the propeller's shaft" }
)toml";
}

struct FigurePoint {
  double rpm, torque;  // of the propeller; lbf in
};

// Figure 8.10-5 of the same book, p. 392, as openTorsion's authors read it: vibratory torque of the
// propeller's shaft. All of their points.
inline std::vector<FigurePoint> ship_drive_figure() {
  return {{14.4828, 69148.9},  {19.0464, 132978.7}, {21.0217, 180851.1}, {24.5636, 324468.1},
          {26.9476, 468085.1}, {28.1056, 595744.7}, {29.1273, 739361.7}, {30.0809, 898936.2},
          {30.7620, 1053191},  {31.1707, 1218085},  {31.6475, 1367021},  {32.1924, 1574468},
          {32.8054, 1856383},  {33.0779, 2095745},  {33.2822, 2345745},  {33.6228, 2585106},
          {33.8953, 2803191},  {34.0996, 3042553},  {34.3721, 3319149},  {34.7126, 3585106},
          {34.9851, 3824468},  {35.4619, 4148936},  {35.1213, 3984043},  {36.1430, 3984043},
          {36.2793, 3776596},  {36.4836, 3585106},  {36.8242, 3319149},  {37.0966, 3122340},
          {37.3010, 2877660},  {37.7097, 2563830},  {38.1865, 2297872},  {38.4589, 2117021},
          {39.0038, 1851064},  {39.6850, 1643617},  {40.6386, 1436170},  {41.7965, 1218085},
          {43.7037, 1021277},  {45.2022, 893617.0}, {46.9051, 797872.3}, {48.3355, 744680.9},
          {50.0383, 696808.5}, {51.8774, 659574.5}, {53.7165, 622340.4}, {56.6454, 569148.9},
          {58.8931, 553191.5}, {61.2090, 521276.6}, {64.0017, 500000.0}, {67.8842, 473404.3},
          {72.5841, 454787.2}, {82.3244, 425531.9}, {87.5011, 414893.6}, {91.4517, 409574.5},
          {97.1052, 409574.5}, {75.7173, 457446.8}, {78.7825, 425531.9}};
}

}  // namespace gearsweep::testing
