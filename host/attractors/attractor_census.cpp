#include "attractors/attractor_census.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "attractors/detail/disjoint_sets.hpp"
#include "attractors/detail/moment_groups.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

constexpr double kSameOrbit = 1e-3;
constexpr double kSameOrbitFp32 = 1e-2;
constexpr double kSameBranch = 0.05;
constexpr double kMinScale = 1e-3;
// Moments are known so badly that smaller differences say nothing of an order.
constexpr double kGrain = 0.02;
// What numbers of one state differ by through rounding, in terms of the largest of any state.
constexpr double kRounding = 1e-13;
constexpr double kRoundingFp32 = 1e-5;

bool is_periodic(const TrajectorySummary& summary) { return summary.motion == MOTION_periodic; }

// How far out any state of a motion with these moments mostly goes.
double max_magnitude(const TrajectorySummary& summary) {
  constexpr double kFarOut = 2.0;  // standard deviations
  const std::vector<double>& place = summary.place;
  const std::size_t states = place.size() / 2;
  double max = 0.0;
  for (std::size_t i = 0; i < place.size(); ++i) {
    double size = std::abs(place[i]);
    if (!summary.errors.empty() && i < states) size += kFarOut * place[states + i];
    max = std::max(max, size);
  }
  return max;
}

double max_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double max = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) max = std::max(max, std::abs(a[i] - b[i]));
  return max;
}

// What kinds of motion are told apart by, in the order in which they are listed: rest, then
// periodic motion by its period, then all other.
std::pair<int, double> kind_of(std::size_t motion, double period) {
  if (motion == MOTION_equilibrium) return {0, 0.0};
  if (motion == MOTION_periodic) return {1, period};
  return {2, 0.0};
}

// A number that is none never agrees.
bool agree(const std::vector<double>& a, const std::vector<double>& b, double allowed) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(std::abs(a[i] - b[i]) <= allowed)) return false;
  }
  return true;
}

// Whether the place is known but for rounding and what is left of the way there.
bool has_exact_place(const TrajectorySummary& summary, double tolerance) {
  if (summary.errors.empty()) return true;
  const auto states = static_cast<std::ptrdiff_t>(summary.place.size() / 2);
  return (is_periodic(summary) || summary.motion == MOTION_equilibrium) &&
         std::all_of(summary.place.begin() + states, summary.place.end(),
                     [&](double deviation) { return deviation <= tolerance; });
}

// Numbers of the parameter values along an axis, place by place: 0 where it has initial states
// alone. Rows of a list that differ in initial states alone have the same number.
std::vector<std::size_t> numbers_along(const Axis& axis) {
  std::map<std::vector<double>, std::size_t> known;
  std::vector<std::size_t> numbers;
  for (std::size_t place = 0; place < axis.values.size(); ++place) {
    std::vector<double> values;
    for (const Swept& swept : axis.swept()) {
      if (!swept.is_state) values.push_back(swept.values[place]);
    }
    numbers.push_back(known.try_emplace(std::move(values), known.size()).first->second);
  }
  return numbers;
}

// A map's parameter values: points that differ in initial states alone are one site.
class Sites {
 public:
  explicit Sites(const Study& study) : column_(numbers_along(study.axes[0])) {
    if (study.axes.size() > 1) row_ = numbers_along(study.axes[1]);
    columns_ = 1 + *std::ranges::max_element(column_);
    rows_ = 1 + *std::ranges::max_element(row_);
  }
  std::size_t count() const { return columns_ * rows_; }
  std::size_t of_point(std::size_t point) const {
    return row_[point / column_.size()] * columns_ + column_[point % column_.size()];
  }
  // Those at the next value of each parameter.
  std::vector<std::size_t> after(std::size_t site) const {
    std::vector<std::size_t> next;
    if (site % columns_ + 1 < columns_) next.push_back(site + 1);
    if (site / columns_ + 1 < rows_) next.push_back(site + columns_);
    return next;
  }

 private:
  std::vector<std::size_t> column_, row_ = {0};  // of each place along x and y
  std::size_t columns_ = 1, rows_ = 1;
};

// Clusters of trajectories. Of what is told of a kind of motion, the first one speaks for all.
struct Clusters {
  std::vector<std::size_t> first;                 // [cluster] trajectory
  std::vector<std::vector<double>> place;         // [cluster]
  std::vector<std::vector<double>> rank;          // [cluster] by what they are listed
  std::vector<std::vector<std::size_t>> of_site;  // [site] clusters
  std::vector<std::size_t> of_trajectory;         // cluster, or npos
  std::size_t uncertain = 0;                      // trajectories

  // grain: what two numbers of a place must differ by to be listed in that order.
  std::size_t add(std::size_t trajectory, std::size_t site, std::vector<double> its_place,
                  double grain = 0.0) {
    of_site[site].push_back(first.size());
    first.push_back(trajectory);
    place.push_back(std::move(its_place));
    rank.push_back(place.back());
    for (double& number : rank.back()) {
      if (grain > 0.0) number = grain * std::round(number / grain);
    }
    return first.size() - 1;
  }
};
constexpr std::size_t npos = static_cast<std::size_t>(-1);

// Those whose places have errors, at one site.
void add_groups(const std::vector<TrajectorySummary>& summaries,
                const std::vector<std::size_t>& members, std::size_t site, double rounding,
                double grain, Clusters* clusters) {
  if (members.empty()) return;
  const MomentGroups groups = group_by_moments(summaries, members, rounding);
  clusters->uncertain += groups.uncertain.size();
  for (const std::vector<std::size_t>& group : groups.members) {
    std::vector<double> mean(summaries[group.front()].place.size());
    for (const std::size_t member : group) {
      for (std::size_t i = 0; i < mean.size(); ++i) {
        mean[i] += summaries[member].place[i] / static_cast<double>(group.size());
      }
    }
    const std::size_t added = clusters->add(group.front(), site, std::move(mean), grain);
    for (const std::size_t member : group) clusters->of_trajectory[member] = added;
  }
}

Clusters cluster(const Study& study, const Sites& sites,
                 const std::vector<TrajectorySummary>& summaries) {
  Clusters clusters;
  clusters.of_site.resize(sites.count());
  clusters.of_trajectory.assign(summaries.size(), npos);
  std::vector<double> scale(sites.count(), kMinScale);
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    double& max = scale[sites.of_point(i % study.points())];
    max = std::max(max, max_magnitude(summaries[i]));
  }
  const double tolerance = study.integrate.fp64 ? kSameOrbit : kSameOrbitFp32;
  std::vector<std::vector<std::size_t>> inexact(sites.count());
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    const TrajectorySummary& summary = summaries[i];
    if (!summary.is_known) continue;
    const std::size_t site = sites.of_point(i % study.points());
    const double allowed = tolerance * scale[site];
    if (!has_exact_place(summary, allowed)) {
      inexact[site].push_back(i);
      continue;
    }
    const std::vector<std::size_t>& here = clusters.of_site[site];
    const auto known = std::find_if(here.begin(), here.end(), [&](std::size_t other) {
      return agree(clusters.place[other], summary.place, allowed);
    });
    clusters.of_trajectory[i] = known != here.end() ? *known : clusters.add(i, site, summary.place);
  }
  const double rounding = study.integrate.fp64 ? kRounding : kRoundingFp32;
  for (std::size_t site = 0; site < sites.count(); ++site) {
    add_groups(summaries, inexact[site], site, rounding * scale[site], kGrain * scale[site],
               &clusters);
  }
  return clusters;
}

// The nearest attractor of its kind among `others`; npos when there is none.
std::size_t nearest(const std::vector<TrajectorySummary>& summaries, const Clusters& clusters,
                    std::size_t cluster, const std::vector<std::size_t>& others) {
  const TrajectorySummary& own = summaries[clusters.first[cluster]];
  std::size_t best = npos;
  double min = std::numeric_limits<double>::infinity();
  for (const std::size_t other : others) {
    const TrajectorySummary& candidate = summaries[clusters.first[other]];
    if (kind_of(own.motion, own.period) != kind_of(candidate.motion, candidate.period)) continue;
    const double difference = max_difference(clusters.place[cluster], clusters.place[other]);
    if (difference < min) {
      min = difference;
      best = other;
    }
  }
  return best;
}

// Joins the clusters that are one attractor, followed from one parameter value to the next.
DisjointSets follow(const Sites& sites, const std::vector<TrajectorySummary>& summaries,
                    const Clusters& clusters) {
  double scale = 0.0;
  for (const std::size_t i : clusters.first) scale = std::max(scale, max_magnitude(summaries[i]));
  DisjointSets branches(clusters.first.size());
  for (std::size_t site = 0; site < sites.count(); ++site) {
    for (const std::size_t next : sites.after(site)) {
      for (const std::size_t own : clusters.of_site[site]) {
        const std::size_t other = nearest(summaries, clusters, own, clusters.of_site[next]);
        if (other == npos) continue;
        if (nearest(summaries, clusters, other, clusters.of_site[site]) != own) continue;
        const double difference = max_difference(clusters.place[own], clusters.place[other]);
        if (difference <= kSameBranch * scale) branches.join(own, other);
      }
    }
  }
  return branches;
}

// Clusters that are one attractor, by the first of them.
struct Branch {
  std::size_t cluster;
  Attractor attractor;
};

template <class Value>
Value most_frequent(const std::map<Value, std::size_t>& counts) {
  return std::max_element(counts.begin(), counts.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

// Attractor::impacts of a trajectory.
std::string impacts_of(const TrajectorySummary& summary) {
  if (!is_periodic(summary) || summary.period <= 0.0 || std::isnan(summary.impacts_drive)) {
    return "";
  }
  return fmt::format("{}-{}-{}", summary.period, std::round(summary.impacts_drive * summary.period),
                     std::round(summary.impacts_back * summary.period));
}

Attractor describe(const std::vector<TrajectorySummary>& summaries,
                   const std::vector<std::size_t>& trajectories) {
  std::map<std::size_t, std::size_t> motions;
  std::map<double, std::size_t> periods;
  std::map<std::string, std::size_t> impacts;
  Attractor attractor;
  attractor.peak = summaries[trajectories.front()].peak;
  for (const std::size_t i : trajectories) {
    const TrajectorySummary& summary = summaries[i];
    ++motions[summary.motion];
    ++periods[summary.period];
    ++impacts[impacts_of(summary)];
    attractor.rms += summary.rms;
    attractor.exponent += summary.exponent;
    attractor.peak = std::max(attractor.peak, summary.peak);
  }
  attractor.trajectories = trajectories.size();
  const auto count = static_cast<double>(trajectories.size());
  attractor.rms /= count;
  attractor.exponent /= count;
  attractor.motion = most_frequent(motions);
  attractor.period = most_frequent(periods);
  attractor.impacts = most_frequent(impacts);
  return attractor;
}

}  // namespace

AttractorList find_attractors(const Study& study, const std::vector<TrajectorySummary>& summaries) {
  const Sites sites(study);
  const Clusters clusters = cluster(study, sites, summaries);
  DisjointSets branches = follow(sites, summaries, clusters);

  std::map<std::size_t, std::vector<std::size_t>> members;  // of each branch, by its first cluster
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    if (clusters.of_trajectory[i] == npos) continue;
    members[branches.find(clusters.of_trajectory[i])].push_back(i);
  }
  std::vector<Branch> order;
  for (const auto& [first, trajectories] : members) {
    order.push_back({first, describe(summaries, trajectories)});
  }
  const auto place = [&](const Branch& branch) -> const std::vector<double>& {
    return clusters.place[branch.cluster];
  };
  std::stable_sort(order.begin(), order.end(), [&](const Branch& a, const Branch& b) {
    const auto kind = [](const Branch& branch) {
      return kind_of(branch.attractor.motion, branch.attractor.period);
    };
    if (kind(a) != kind(b)) return kind(a) < kind(b);
    const std::vector<double>&rank_of_a = clusters.rank[a.cluster],
          &rank_of_b = clusters.rank[b.cluster];
    return rank_of_a != rank_of_b ? rank_of_a < rank_of_b : place(a) < place(b);
  });

  AttractorList list;
  list.uncertain = clusters.uncertain;
  std::map<std::size_t, std::size_t> numbers;  // of each branch
  for (const Branch& branch : order) {
    list.attractors.push_back(branch.attractor);
    numbers[branch.cluster] = list.attractors.size();
  }
  list.number.assign(summaries.size(), 0);
  std::vector<std::set<std::size_t>> reached(study.points());
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    const std::size_t cluster = clusters.of_trajectory[i];
    if (cluster == npos) continue;
    list.number[i] = numbers[branches.find(cluster)];
    reached[i % study.points()].insert(cluster);
  }
  for (const std::set<std::size_t>& clusters_here : reached) {
    list.count.push_back(clusters_here.size());
  }
  return list;
}

}  // namespace gearsweep
