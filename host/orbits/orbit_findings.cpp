#include "orbits/orbit_findings.hpp"

#include <algorithm>

namespace gearsweep {

std::vector<LocatedBifurcation> bifurcations_of(const OrbitFindings& findings) {
  return bifurcations_of(findings.branches);
}

std::vector<LocatedBifurcation> bifurcations_of(const std::vector<Branch>& branches) {
  std::vector<LocatedBifurcation> all;
  for (const Branch& branch : branches) {
    all.insert(all.end(), branch.bifurcations.begin(), branch.bifurcations.end());
  }
  std::sort(all.begin(), all.end(),
            [](const auto& a, const auto& b) { return a.parameter < b.parameter; });
  return all;
}

OrbitLine orbits_of(const OrbitFindings& findings) {
  OrbitLine line;
  const bool is_rising = findings.range && findings.range->from < findings.range->to;
  for (const Branch& branch : findings.branches) {
    if (branch.upwards == is_rising) continue;
    line.orbits.assign(branch.orbits.rbegin(), branch.orbits.rend());
  }
  if (!line.orbits.empty()) line.start = line.orbits.size() - 1;
  for (const Branch& branch : findings.branches) {
    if (branch.upwards != is_rising || branch.orbits.empty()) continue;
    // Both ways begin at the start.
    if (!line.orbits.empty()) line.orbits.pop_back();
    line.orbits.insert(line.orbits.end(), branch.orbits.begin(), branch.orbits.end());
  }
  if (line.orbits.empty()) {
    const std::vector<double>& parameters = findings.study.setting.parameters;
    line.orbits.push_back(
        {findings.range ? parameters[findings.range->parameter] : 0.0, findings.orbit});
  }
  return line;
}

std::vector<BranchOrbit> orbits_of(const OrbitFindings& findings, const LeavingBranch& leaving) {
  const bool is_rising = findings.range && findings.range->from < findings.range->to;
  std::vector<BranchOrbit> line;
  for (const Branch& branch : leaving.branches) {
    if (branch.upwards != is_rising) {
      line.insert(line.begin(), branch.orbits.rbegin(), branch.orbits.rend());
    } else {
      line.insert(line.end(), branch.orbits.begin(), branch.orbits.end());
    }
  }
  return line;
}

}  // namespace gearsweep
