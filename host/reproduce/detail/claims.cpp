#include "reproduce/detail/claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gearsweep {
namespace {

// The verdict on a share of points: "holds" from `whole`, "in part" from `part` on.
Verdict by_share(double share, double whole = 0.8, double part = 0.5) {
  if (share >= whole) return Verdict::holds;
  return share >= part ? Verdict::in_part : Verdict::does_not_hold;
}

// All, some or none of several conditions.
Verdict by_count(const std::vector<bool>& conditions) {
  const auto met = std::count(conditions.begin(), conditions.end(), true);
  if (met == static_cast<std::ptrdiff_t>(conditions.size())) return Verdict::holds;
  return met > 0 ? Verdict::in_part : Verdict::does_not_hold;
}

bool inside(std::pair<double, double> range, double min, double max) {
  return range.first >= min && range.second <= max;
}

std::string show(std::pair<double, double> range) {
  return fmt::format("{:.3f} .. {:.3f}", range.first, range.second);
}

constexpr double kChaotic = 0.003;  // largest exponents beyond this count as chaos

class Judge {
 public:
  explicit Judge(const MeasuredFigures& measured) : measured_(measured) {}

  std::vector<Judgement> all() {
    resonances();
    friction_and_rms();
    friction_and_force();
    low_speed();
    middle_speed();
    constant_backlash();
    portraits();
    two_laws();
    dynamic_backlash();
    three_regimes();
    return std::move(judgements_);
  }

 private:
  const SweepResult& map(const std::string& figure) const { return measured_.maps.at(figure); }
  bool is_paper() const { return measured_.preset == "paper"; }

  void add(int figure, std::string claim, std::string rule, std::string measured, Verdict verdict) {
    judgements_.push_back(
        {figure, std::move(claim), std::move(rule), std::move(measured), verdict});
  }

  // x1's mean hides the resonances of `consistent`, whose load is heavy: there its standard
  // deviation tells.
  void resonances() {
    const std::string quantity = is_paper() ? "x1_rms" : "x1_std";
    const double reach = is_paper() ? 0.03 : 0.06;
    const MapCurve curve(map("fig4"), quantity);
    std::vector<bool> met;
    std::string found;
    for (const double resonance : {0.25, 0.5}) {
      const double at = curve.x(curve.max_in(resonance - 0.1, resonance + 0.08));
      met.push_back(std::abs(at - resonance) <= reach + 1e-9);
      found += fmt::format("{}{:.3f}", found.empty() ? "" : " and ", at);
    }
    add(4, "Resonances at omega = 0.25 and 0.5, a quarter and a half of the natural frequency.",
        fmt::format("the largest {} (mu = 0) in 0.15 .. 0.33 and in 0.40 .. 0.58 lies within {} "
                    "of them; in part: one of the two",
                    quantity, reach),
        fmt::format("largest at {}", found), by_count(met));
  }

  void friction_and_rms() {
    const MapCurve without(map("fig4"), "x1_rms"), with(map("fig4-friction"), "x1_rms");
    const double share =
        share_of(with.within(0.1, 1.5), [&](std::size_t i) { return without[i] > with[i]; });
    add(4, "The RMS is slightly higher without friction.",
        "at 80 % of the frequencies; in part: at half of them",
        fmt::format("higher at {:.0f} % of them", 100.0 * share), by_share(share));
  }

  void friction_and_force() {
    const MapCurve without(map("fig4"), "dmf_max"), with(map("fig4-friction"), "dmf_max");
    const auto larger = [&](std::size_t i) { return without[i] > with[i]; };
    const double low = share_of(with.within(0.1, 0.14), larger);
    const double above = 1.0 - share_of(with.within(0.14, 0.25), larger);
    add(4,
        "The largest meshing force is larger without friction for omega in 0.1 .. 0.14, and "
        "smaller from there to the end of the low band.",
        "at 80 % of the frequencies in 0.1 .. 0.14 and in 0.14 .. 0.25 each; in part: one of the "
        "two",
        fmt::format("larger at {:.0f} % of the first, smaller at {:.0f} % of the second",
                    100.0 * low, 100.0 * above),
        by_count({low >= 0.8, above >= 0.8}));
  }

  // 20 log10 of the ratio of the amplitudes of x1 without and with friction.
  double louder_without(const std::string& figure, double order) const {
    const std::vector<Trace>& traces = measured_.traces.at(figure);
    return 20.0 *
           std::log10(amplitude_at(traces[0], "x1", order) / amplitude_at(traces[1], "x1", order));
  }

  void low_speed() {
    const auto range = range_of(measured_.traces.at("fig5")[0], "x1");
    add(5, "At omega = 0.1, x1 stays within about 0.93 .. 0.95.",
        "without friction x1 stays within 0.925 .. 0.95", show(range),
        inside(range, 0.925, 0.95) ? Verdict::holds : Verdict::does_not_hold);
    const double first = louder_without("fig5", 1.0), second = louder_without("fig5", 2.0);
    double high = 0.0;
    for (int order = 6; order <= 12; ++order) {
      high = std::max(high, std::abs(louder_without("fig5", order)));
    }
    add(5,
        "The spectra with and without friction agree at the first two mesh orders and differ at "
        "high ones.",
        "within 1 dB at order 1, and at order 2, and by more than 3 dB at some order from 6 to 12; "
        "in part: not all three",
        fmt::format(
            "without friction {:+.1f} dB at order 1, {:+.1f} dB at order 2, up to {:.0f} dB "
            "apart from 6 to 12",
            first, second, high),
        by_count({std::abs(first) <= 1.0, std::abs(second) <= 1.0, high > 3.0}));
  }

  void middle_speed() {
    const auto without = range_of(measured_.traces.at("fig6")[0], "x1");
    const auto with = range_of(measured_.traces.at("fig6")[1], "x1");
    add(6, "At omega = 0.7, x1 stays within about -0.5 .. 1.5.",
        "within -0.5 .. 1.8, without and with friction; in part: one of the two",
        fmt::format("{} without, {} with", show(without), show(with)),
        by_count({inside(without, -0.5, 1.8), inside(with, -0.5, 1.8)}));
    double halves = 0.0, sixths = 0.0;
    int count = 0;
    for (int n = 1; n <= 4; ++n) {
      halves = std::max(halves, std::abs(louder_without("fig6", n / 2.0)));
    }
    for (int n = 1; n <= 11; ++n) {
      if (n % 3 == 0) continue;
      sixths += louder_without("fig6", n / 6.0);
      ++count;
    }
    sixths /= count;
    add(6, "Lines at n/2 of the mesh order are alike, lines at n/6 are higher without friction.",
        "within 3 dB at 1/2, 1, 3/2 and 2; at n/6 up to 11/6, less these, by more than 3 dB in the "
        "mean; in part: one of the two",
        fmt::format("{:.1f} dB at most at n/2, {:+.1f} dB in the mean at n/6", halves, sixths),
        by_count({halves <= 3.0, sixths > 3.0}));
  }

  // The first jump of a figure; null when there is none.
  const MeasuredFigures::Jump* first_jump(const std::string& figure) const {
    const auto found = measured_.jumps.find(figure);
    return found == measured_.jumps.end() || found->second.empty() ? nullptr
                                                                   : &found->second.front();
  }

  std::string describe_jump(const std::string& figure) const {
    const MeasuredFigures::Jump* jump = first_jump(figure);
    if (jump == nullptr) return "no jump";
    return fmt::format("jump between b = {:.4f} and {:.4f}; {} attractors below, {} above",
                       jump->below, jump->above, jump->count_below, jump->count_above);
  }

  void constant_backlash() {
    const MapCurve force(map("fig7"), "dmf_max"), rms(map("fig7"), "x1_rms");
    const std::vector<std::size_t> small = force.within(0.30, 0.42);
    const bool flat =
        share_of(small, [&](std::size_t i) { return force[i] >= 0.21 && force[i] <= 0.23; }) == 1.0;
    const bool rises = share_of(small, [&](std::size_t i) {
                         return i == small.front() || rms[i] > rms[i - 1];
                       }) == 1.0;
    add(7, "For small b the largest meshing force is constant and the RMS rises.",
        "for b in 0.30 .. 0.42 the force stays within 0.21 .. 0.23 and the RMS rises from point to "
        "point; in part: one of the two",
        fmt::format("force {:.4f} .. {:.4f}, RMS {:.4f} to {:.4f}{}", *min_of(force, small),
                    *max_of(force, small), rms[small.front()], rms[small.back()],
                    rises ? ", rising" : ""),
        by_count({flat, rises}));

    const MeasuredFigures::Jump* jump = first_jump("fig7");
    const bool jumps = jump != nullptr && jump->above >= 0.43 && jump->above <= 0.8;
    add(7, "At a first value of b the motion jumps to another with a much larger force.",
        "the first b with a force above 0.6 lies in 0.43 .. 0.8", describe_jump("fig7"),
        jumps ? Verdict::holds : Verdict::does_not_hold);
    add(7, "The jump is a bifurcation (\"blue sky\").",
        "on one side of it an ensemble of 16 initial states reaches one attractor alone; with two "
        "or more on both sides the jump is a change of basin, and the claim does not hold",
        describe_jump("fig7"),
        jump != nullptr && !jump->is_change_of_basin() ? Verdict::holds : Verdict::does_not_hold);

    const MapCurve exponent(map("fig7"), "lyapunov_max");
    const double chaos =
        share_of(force.within(0.8, 1.3), [&](std::size_t i) { return exponent[i] > kChaotic; });
    add(7, "Beyond the first b the motion is chaotic.",
        "a largest exponent above 0.003 at 80 % of b in 0.8 .. 1.3; in part: at a tenth of them",
        fmt::format("at {:.0f} %", 100.0 * chaos), by_share(chaos, 0.8, 0.1));
  }

  static std::optional<double> extreme(const MapCurve& curve,
                                       const std::vector<std::size_t>& points, double sign) {
    std::optional<double> best;
    for (const std::size_t i : points) {
      if (!best || sign * curve[i] > sign * *best) best = curve[i];
    }
    return best;
  }
  static std::optional<double> min_of(const MapCurve& curve,
                                      const std::vector<std::size_t>& points) {
    return extreme(curve, points, -1.0);
  }
  static std::optional<double> max_of(const MapCurve& curve,
                                      const std::vector<std::size_t>& points) {
    return extreme(curve, points, 1.0);
  }

  void portraits() {
    const auto early = range_of(measured_.traces.at("fig8")[0], "x1");
    const auto late = range_of(measured_.traces.at("fig8-late")[0], "x1");
    add(8,
        "At b = 0.39 the motion lies within 0.15 .. 0.45 and still changes between 600 and 1500 "
        "periods.",
        "x1 within 0.15 .. 0.45 after 600 periods, and a range narrower by a fifth after 1500; in "
        "part: one of the two",
        fmt::format("{} after 600, {} after 1500", show(early), show(late)),
        by_count({inside(early, 0.15, 0.45),
                  late.second - late.first < 0.8 * (early.second - early.first)}));
    const MapCurve force(map("fig8"), "dmf_min"), exponent(map("fig8"), "lyapunov_max");
    const auto wide = range_of(measured_.traces.at("fig8")[3], "x1");
    add(8, "At b = 1.2 the motion is chaotic, within -8 .. 8, with negative force.",
        "a largest exponent above 0.003; x1 beyond -5 and 5, within -8 .. 8; a negative force; in "
        "part: not all of them",
        fmt::format("exponent {:.4f}, x1 {}, smallest force {:.3f}", exponent[3], show(wide),
                    force[3]),
        by_count({exponent[3] > kChaotic,
                  wide.first < -5.0 && wide.second > 5.0 && inside(wide, -8.0, 8.0),
                  force[3] < 0.0}));
    add(8, "At b = 0.70 the motion is chaotic, within -1 .. 2.5.", "a largest exponent above 0.003",
        fmt::format("exponent {:.4f}, x1 {}", exponent[1],
                    show(range_of(measured_.traces.at("fig8")[1], "x1"))),
        exponent[1] > kChaotic ? Verdict::holds : Verdict::does_not_hold);
  }

  static std::optional<double> first_chaos(const SweepResult& result) {
    const MapCurve exponent(result, "lyapunov_max");
    for (std::size_t i = 0; i < exponent.size(); ++i) {
      if (exponent[i] > kChaotic) return exponent.x(i);
    }
    return std::nullopt;
  }

  void two_laws() {
    const std::optional<double> constant = first_chaos(map("fig9"));
    const std::optional<double> dynamic = first_chaos(map("fig9-dynamic"));
    const auto show_first = [](const std::optional<double>& omega) {
      return omega ? fmt::format("omega = {:.4f}", *omega) : std::string("nowhere");
    };
    add(9, "Over omega both laws lead to chaos, the dynamic backlash earlier.",
        "the first omega with a largest exponent above 0.003 is lower for the dynamic backlash; in "
        "part: both have one",
        fmt::format("constant: {}; dynamic: {}", show_first(constant), show_first(dynamic)),
        by_count({constant && dynamic, constant && dynamic && *dynamic < *constant}));
  }

  void dynamic_backlash() {
    const MapCurve force(map("fig10"), "dmf_max"), rms(map("fig10"), "x1_rms");
    const std::vector<std::size_t> small = force.within(0.30, 0.42);
    const double spread = *max_of(force, small) - *min_of(force, small);
    add(10, "With dynamic backlash, for small b the force is constant and the RMS linear in b.",
        "for b in 0.30 .. 0.42 the force varies by less than 5 %, the RMS rises by 0.9 .. 1.1 "
        "times b; in part: one of the two",
        fmt::format("force varies by {:.1f} %, RMS by {:.3f} b", 100.0 * spread / force[small[0]],
                    slope(rms, small)),
        by_count({spread < 0.05 * force[small[0]], std::abs(slope(rms, small) - 1.0) <= 0.1}));
    const MapCurve exponent(map("fig10"), "lyapunov_max");
    std::size_t changes = 0;
    const std::vector<std::size_t> large = force.within(0.42, 1.3);
    for (std::size_t i = 1; i < large.size(); ++i) {
      changes += (exponent[large[i]] > kChaotic) != (exponent[large[i - 1]] > kChaotic) ? 1 : 0;
    }
    add(10, "Then periodic and chaotic motion alternate.",
        "a largest exponent above 0.003 comes and goes four times or more for b > 0.42; in part: "
        "at all",
        fmt::format("{} changes; {}", changes, describe_jump("fig10")),
        changes >= 4  ? Verdict::holds
        : changes > 0 ? Verdict::in_part
                      : Verdict::does_not_hold);
  }

  static double slope(const MapCurve& curve, const std::vector<std::size_t>& points) {
    return (curve[points.back()] - curve[points.front()]) /
           (curve.x(points.back()) - curve.x(points.front()));
  }

  void three_regimes() {
    const MapCurve constant(map("fig7"), "contact_class");
    const MapCurve dynamic(map("fig10"), "contact_class");
    const auto occurs = [&](double kind) {
      return std::ranges::count(constant.values(), kind) > 0 ||
             std::ranges::count(dynamic.values(), kind) > 0;
    };
    const auto word = [&](double kind) { return occurs(kind) ? "occurs" : "does not occur"; };
    add(11,
        "Motion without impact, with single-sided and with double-sided impacts all occur over b.",
        "all three classes of contact occur in figures 7 and 10; in part: two or one of them",
        fmt::format("no impact {}, single-sided {}, double-sided {}", word(0.0), word(1.0),
                    word(2.0)),
        by_count({occurs(0.0), occurs(1.0), occurs(2.0)}));
  }

  const MeasuredFigures& measured_;
  std::vector<Judgement> judgements_;
};

}  // namespace

std::string name_of(Verdict verdict) {
  if (verdict == Verdict::holds) return "holds";
  return verdict == Verdict::in_part ? "holds in part" : "does not hold";
}

std::vector<Judgement> judge(const MeasuredFigures& measured) { return Judge(measured).all(); }

}  // namespace gearsweep
