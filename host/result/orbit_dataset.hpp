// The periodic orbits of a point and of its branch as values.
#pragma once

#include "orbits/orbit_findings.hpp"
#include "result/dataset.hpp"

namespace gearsweep {

// With a range, along the dimension `orbit`, in one line from the range's `from` to its `to`; else
// of one orbit, without it:
//   the parameters that the point was given, `period` in forcing periods, `stable`, `section`
//   (state), `multiplier_real` and `multiplier_imag` (multiplier), largest modulus first.
// The `period` of a cycle counts its returns, and it has `cycle_time` and `multiplier_along`. An
// equilibrium has no `period`, and `eigenvalue` in place of `multiplier`. The attribute `kind` says
// what it is.
// It has, of the orbit at the start, `section_error` (state), `multiplier_error` (multiplier),
// `grazing`. With a range, along the dimension `bifurcation`, by the parameter's value:
// `bifurcation_kind`, `bifurcation_value` of the parameter, `bifurcation_error` of that,
// `bifurcation_grazing`, `bifurcation_born_of`, and all that an orbit has, as `bifurcation_period`.
// Where branches that leave others were asked for, all orbits and bifurcations stand there, branch
// after branch: `orbit_branch` and `bifurcation_branch` say on which, 0 for the first. Along
// `branch`, numbered from 1, stand those that leave: `branch_leaves`, the number of another one, 0
// for the first; `branch_origin`, the number of the bifurcation where; `branch_period`,
// `branch_orbits` (how many it has) and `branch_ended`. The attribute `coordinates` names what are
// coordinates.
Dataset dataset_of(const OrbitFindings& findings, const Provenance& provenance);

}  // namespace gearsweep
