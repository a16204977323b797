// gearsweep curves: the bifurcation curves that border the motions of a map.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "borders/border_search.hpp"
#include "borders/curve_accuracy.hpp"
#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/stop_on_signals.hpp"
#include "cli/detail/study_source.hpp"
#include "cli/standard_streams.hpp"
#include "journal/journal.hpp"
#include "journal/notes.hpp"
#include "model/error.hpp"
#include "model/version.hpp"
#include "point/point_trace.hpp"
#include "result/border_file.hpp"
#include "result/result_file.hpp"

namespace gearsweep {
namespace {

struct CurvesArguments {
  std::string map, output, device;
  std::optional<std::size_t> steps;
  std::size_t min_pairs = BorderRequest{}.min_edges;
  bool restart = false, quiet = false;
};

std::string curves_command_line(const CurvesArguments& arguments) {
  std::string line = "gearsweep curves " + shell_quoted(arguments.map);
  if (arguments.steps) line += fmt::format(" --steps {}", *arguments.steps);
  if (arguments.min_pairs != BorderRequest{}.min_edges) {
    line += fmt::format(" --min-pairs {}", arguments.min_pairs);
  }
  return line + " -o " + shell_quoted(arguments.output);
}

PeriodPixels read_periods(const std::string& path) {
  const ResultFile file(path);
  const std::vector<std::string>& known = file.quantities();
  if (std::ranges::find(known, "period") == known.end()) {
    throw InputError(fmt::format(
        "'{}' has no 'period', by which borders are found: compute the map again with it among its "
        "quantities, as in gearsweep run STUDY --set 'observe.quantities=[\"period\"]' -o MAP.nc",
        path));
  }
  const ResultMap map = file.read("period");
  if (map.axes.size() != 2) {
    throw InputError(
        fmt::format("'{}' is no map of two axes: curves are borders in a plane", path));
  }
  PeriodPixels pixels;
  for (std::size_t i = 0; i < 2; ++i) {
    if (map.axes[i].values.size() < 2) {
      throw InputError(fmt::format("axis '{}' of '{}' has one value: curves take two at least",
                                   map.axes[i].name, path));
    }
    pixels.axes[i] = map.axes[i].values;
    pixels.is_logarithmic[i] = map.axes[i].logarithmic;
  }
  pixels.period = map.values;
  const auto contact = std::ranges::find_if(known, [](const std::string& quantity) {
    return quantity == "contact_class" || quantity.ends_with("_contact_class") ||
           quantity.ends_with("_impacts");
  });
  if (contact != known.end()) pixels.contact = file.read(*contact).values;
  return pixels;
}

std::string label_of(int period) {
  return period == 0 ? "no period" : fmt::format("period {}", period);
}

// Curves that could not be solved again.
std::string unknown_steps(const BorderFindings& findings) {
  const auto count = std::ranges::count_if(
      findings.curves, [](const BorderCurve& curve) { return std::isnan(curve.step_error); });
  return count == 0 ? "" : fmt::format(" ({} curves could not be solved again)", count);
}

// What moves the curves most: a table, a parameter a line.
std::string describe_gradients(const BorderFindings& findings) {
  struct Row {
    std::string name;
    std::vector<double> shifts;  // of curves, in percent of the window
  };
  const Study& study = findings.study;
  std::vector<Row> rows;
  for (std::size_t i = 0; i < study.model->parameters.size(); ++i) {
    const double change = 0.01 * std::fabs(study.setting.parameters[i]);
    Row row{"", {}};
    for (const std::size_t parameter : changed_together(*study.model, i)) {
      row.name += (row.name.empty() ? "" : ", ") + study.model->parameters[parameter].name;
    }
    for (const BorderCurve& curve : findings.curves) {
      if (curve.gradients.empty() || change == 0.0) continue;
      const auto [x, y] = curve.gradients[i];
      const double shift =
          100.0 * change * std::hypot(x / findings.ranges[0], y / findings.ranges[1]);
      if (std::isfinite(shift)) row.shifts.push_back(shift);
    }
    if (row.shifts.empty()) continue;
    std::ranges::sort(row.shifts);
    rows.push_back(std::move(row));
  }
  if (rows.empty()) return "";
  const auto median = [](const Row& row) { return row.shifts[row.shifts.size() / 2]; };
  std::ranges::stable_sort(rows, std::ranges::greater(), median);
  std::string out =
      "what moves the curves across themselves, in % of the window, when a parameter grows by 1 "
      "%:\n"
      "  parameter        median        most\n";
  for (const Row& row : rows) {
    if (row.shifts.back() == 0.0) continue;
    out += fmt::format("  {:<12} {:>10.2g}  {:>10.2g}\n", row.name, median(row), row.shifts.back());
  }
  return out;
}

// What parts the pixels of the map.
std::string describe_borders(const BorderFindings& findings) {
  std::size_t pairs = 0;
  std::array<std::size_t, kEdgeReasons> counts{};
  if (findings.borders.empty()) return "no border of the map has as many pairs of pixels\n";
  std::string out = "borders of the map, in pairs of pixels:\n";
  for (const ExplainedBorder& border : findings.borders) {
    out += fmt::format("  {} | {}: {}", label_of(border.border.labels[0]),
                       label_of(border.border.labels[1]), border.reasons.size());
    const char* mark = " = ";
    pairs += border.reasons.size();
    for (std::size_t i = 0; i < kEdgeReasons; ++i) {
      const std::size_t count = border.count(static_cast<EdgeReason>(i));
      counts[i] += count;
      if (count == 0) continue;
      out += fmt::format("{}{} {}", mark, count, describe(static_cast<EdgeReason>(i)));
      mark = " + ";
    }
    out += "\n";
  }
  out += fmt::format("of {} pairs in {} borders:", pairs, findings.borders.size());
  const char* comma = "";
  for (std::size_t i = 0; i < kEdgeReasons; ++i) {
    if (counts[i] == 0) continue;
    out += fmt::format("{} {:.1f} % {}", std::exchange(comma, ","),
                       100.0 * static_cast<double>(counts[i]) / static_cast<double>(pairs),
                       describe(static_cast<EdgeReason>(i)));
  }
  out += "\n";
  if (findings.contacts.pairs > 0) {
    out += fmt::format(
        "of {} pairs of one period that differ in the contact {:.1f} % have a grazing curve "
        "between them\n",
        findings.contacts.pairs,
        100.0 * static_cast<double>(findings.contacts.on_curve) /
            static_cast<double>(findings.contacts.pairs));
  }
  return out;
}

std::string describe_curves(const BorderFindings& findings) {
  std::string out;
  const Study& study = findings.study;
  const std::string &x = study.axes[0].name, &y = study.axes[1].name;
  double residual = 0.0, step_error = 0.0;
  for (const BorderCurve& curve : findings.curves) {
    residual = std::max(residual, curve.max_residual());
    if (curve.step_error > step_error) step_error = curve.step_error;
    const std::string touches = curve.kind == BorderKind::grazing
                                    ? fmt::format(" ({})", describe(*study.model, curve.limit))
                                    : "";
    const PlanePlace &first = curve.points.front().place, &last = curve.points.back().place;
    out += fmt::format(
        "{} of period {}{}: {} points, {} = {:.6g}, {} = {:.6g} ({}) to {:.6g}, {:.6g} ({})\n",
        name_of(curve.kind), curve.period, touches, curve.points.size(), x, first[0], y, first[1],
        name_of(curve.begins), last[0], last[1], name_of(curve.ends));
    for (const SpecialPoint& special : curve.special) {
      out += fmt::format("    {} near {} = {:.5g}, {} = {:.5g}\n", name_of(special.kind), x,
                         special.place[0], y, special.place[1]);
    }
  }
  if (!findings.curves.empty()) {
    out += fmt::format(
        "{} curves; residuals of at most {:.1g} of the states' sizes, with {} steps "
        "a period; with twice as many curves move by at most {:.1g} pixels{}\n",
        findings.curves.size(), residual, findings.steps, step_error, unknown_steps(findings));
    out += describe_gradients(findings);
  }
  return out + describe_borders(findings);
}

void warn_of_steps(const BorderFindings& findings) {
  const auto is_rough = [](const BorderCurve& curve) { return curve.step_error > kHalfPixel; };
  const auto count = std::ranges::count_if(findings.curves, is_rough);
  if (count == 0) return;
  tell(
      "warning: {} of {} curves move by more than half a pixel with twice the steps: "
      "use --steps {}\n",
      count, findings.curves.size(), 4 * findings.steps);
}

int run_curves(const CurvesArguments& arguments, SignalWatch* signals) {
  if (is_netcdf(arguments.map) && holds_borders(arguments.map)) {
    throw InputError(fmt::format(
        "'{}' holds curves already: give the map that they are of (plot MAP.nc --curves {})",
        arguments.map, arguments.map));
  }
  if (!is_netcdf(arguments.map)) {
    throw InputError(fmt::format(
        "'{}' is no result file: compute the map first, with period among its quantities "
        "(gearsweep run STUDY -o MAP.nc), and give MAP.nc",
        arguments.map));
  }
  if (!arguments.output.ends_with(".nc")) {
    throw InputError(
        fmt::format("cannot write curves to '{}': its name must end in .nc", arguments.output));
  }
  refuse_own_output(arguments.map, arguments.output);
  ensure_writable(arguments.output);
  Study study = load_study(arguments.map, {});
  settle_step(read_pilot_step(arguments.map), &study);
  BorderRequest request;
  request.pixels = read_periods(arguments.map);
  request.steps = arguments.steps.value_or(0);
  request.min_edges = arguments.min_pairs;
  if (!arguments.quiet) request.tell = [](const std::string& line) { tell("{}\n", line); };
  SweepOptions options;
  options.devices = chosen_devices(arguments.device);
  options.stop = stop_on_signals(signals, arguments.quiet, options.scheduler);
  options.journal_path = arguments.output + ".journal";
  options.notes = {{notes::kCommand, curves_command_line(arguments)}};
  if (arguments.restart) Journal::discard(options.journal_path);
  const std::optional<BorderFindings> findings = find_borders(study, request, options);
  if (!findings) {
    tell("gearsweep: interrupted; what is finished is kept, and the same command continues\n");
    return kInterrupted;
  }
  write_borders(*findings, arguments.output,
                {curves_command_line(arguments), version(), source_hash()});
  Journal::discard(options.journal_path);
  answer("{}", describe_curves(*findings));
  warn_of_steps(*findings);
  if (!arguments.quiet) {
    tell("{}: {} curves in {:.1f} s\n", arguments.output, findings->curves.size(),
         findings->seconds);
  }
  return kDone;
}

}  // namespace

void add_curves_command(CLI::App* app, SignalWatch* signals, int* status) {
  CLI::App* command = app->add_subcommand(
      "curves", "The bifurcation curves that border the periods of a map, exact and classified");
  const auto arguments = std::make_shared<CurvesArguments>();
  command->add_option("map", arguments->map, "A result file over two parameters, with its period")
      ->type_name(kResultValue)
      ->required();
  command->add_option("-o,--output", arguments->output, "The curves: .nc")
      ->type_name(kFileValue)
      ->required();
  command
      ->add_option("--steps", arguments->steps,
                   fmt::format("Integration steps per forcing period (default: {}, or the "
                               "study's, if that is more)",
                               kBorderSteps))
      ->type_name(kNumberValue)
      ->check(whole_number(64, 65536));
  command
      ->add_option("--min-pairs", arguments->min_pairs,
                   fmt::format("Borders of fewer pairs of neighbouring pixels are left out "
                               "(default: {})",
                               arguments->min_pairs))
      ->type_name(kNumberValue)
      ->check(whole_number(1, 1000000));
  add_device_option(command, &arguments->device, false);
  command->add_flag("--restart", arguments->restart,
                    "Start afresh: discard what an interrupted search left in OUT.nc.journal");
  command->add_flag("--quiet", arguments->quiet, "No progress");
  command->footer(
      "Examples:\n"
      "  gearsweep run coarse-backlash -o map.nc\n"
      "  gearsweep curves map.nc -o curves.nc\n"
      "  gearsweep plot map.nc --curves curves.nc -q period -o borders.pdf\n\n"
      "Where neighbouring pixels differ in their period, Newton's method finds the bifurcation\n"
      "between them: a fold, a flip (the period doubles), a Neimark-Sacker bifurcation (a torus\n"
      "is born) or the breaking of a symmetry. Its curve is followed through the plane, and so "
      "are\n"
      "those along which a motion only just touches a limit. Of all other pairs the summary says\n"
      "whether the orbit of one goes on, stable, beyond the other: then two motions are stable "
      "there,\n"
      "and the starts of the two pixels lie in different basins.\n\n"
      "An interrupted search keeps what it has finished in OUT.nc.journal; the same command\n"
      "continues from there, and 'gearsweep status OUT.nc' tells of it.");
  command->callback([arguments, signals, status] { *status = run_curves(*arguments, signals); });
}

}  // namespace gearsweep
