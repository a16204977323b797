#include <fmt/format.h>

#include "model/version.hpp"
#include "plan/plan.hpp"
#include "result/output_file.hpp"
#include "result/result_file.hpp"
#include "verify/detail/check_list.hpp"
#include "verify/detail/host_stepper.hpp"

namespace gearsweep {
namespace {

// 32 points, from no impact to both flanks, for twelve periods of 128 steps.
std::string impacts(const std::string& integrate) {
  return "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nfrom = 0.4\nto = 1.6\ncount = 8\n"
         "[[axes]]\nname = 'b'\nfrom = 0.4\nto = 1.4\ncount = 4\n[integrate]\nsettle = 10\n"
         "record = 2\nsteps_per_period = 128\nstop = 'never'\n" +
         integrate +
         "[observe]\nquantities = ['x1_min', 'x1_max', 'x1_mean', 'x1_rms', 'dmf_min', 'dmf_max', "
         "'contact_drive', 'contact_gap', 'contact_class', 'poincare']\npoincare = ['x1', 'x2', "
         "'x3', 'x4', 'x5', 'v1', 'v2', 'v3', 'v4', 'v5']\n";
}

// "x1_rms at omega = 0.4, b = 1"
std::string name_of(const std::string& what, const Plan& plan, std::size_t point) {
  std::string name = what;
  for (std::size_t axis = 0; axis < plan.study().axes.size(); ++axis) {
    name += fmt::format("{} {} = {:.4g}", axis == 0 ? " at" : ",", plan.study().axes[axis].name,
                        plan.study().axis_value(axis, point));
  }
  return name;
}

// Every number of the result: status, maps and samples.
struct Numbers {
  std::vector<std::string> names;
  std::vector<double> values;
};

Numbers numbers_of(const SweepResult& result) {
  const Plan plan(result.study, result.study.points());
  Numbers numbers;
  const auto add = [&](const std::string& what, std::size_t point, double value) {
    numbers.names.push_back(name_of(what, plan, point));
    numbers.values.push_back(value);
  };
  const Selection& selection = result.study.selection;
  for (std::size_t point = 0; point < result.status.size(); ++point) {
    add("status", point, result.status[point]);
    for (std::size_t i = 0; i < selection.quantities.size(); ++i) {
      add(selection.quantities[i].name, point, result.values[i][point]);
    }
    for (std::size_t i = 0; i < selection.poincare.size(); ++i) {
      for (const double sample : samples_of(result, point, i)) {
        add(result.study.model->states[selection.poincare[i]].name + " at phase 0", point, sample);
      }
    }
  }
  return numbers;
}

std::vector<Compared> compare_all(const Numbers& expected, const Numbers& seen, double tolerance) {
  std::vector<Compared> compared;
  for (std::size_t i = 0; i < expected.values.size(); ++i) {
    compared.push_back({expected.names[i], expected.values[i], seen.values.at(i), tolerance});
  }
  return compared;
}

std::vector<Compared> compare_engines(const Subject& subject, const std::string& integrate,
                                      double tolerance) {
  const std::string reference = impacts("engine = 'reference'\n");
  return compare_all(numbers_of(subject.compute(read_study(reference, "verify"))),
                     numbers_of(subject.compute(read_study(impacts(integrate), "verify"))),
                     tolerance);
}

// The numbers of the same maps in a file.
Numbers numbers_in(const std::string& path, const SweepResult& written) {
  const ResultFile file(path);
  const Selection& selection = written.study.selection;
  std::vector<std::vector<double>> maps = {file.read("status").values};
  for (const Quantity& quantity : selection.quantities) {
    maps.push_back(file.read(quantity.name).values);
  }
  const ResultMap samples = file.read("poincare");
  const std::size_t width = samples.values.size() / written.status.size();
  Numbers numbers{numbers_of(written).names, {}};
  for (std::size_t point = 0; point < written.status.size(); ++point) {
    for (const std::vector<double>& map : maps) numbers.values.push_back(map.at(point));
    const auto first = samples.values.begin() + static_cast<std::ptrdiff_t>(point * width);
    numbers.values.insert(numbers.values.end(), first, first + static_cast<std::ptrdiff_t>(width));
  }
  return numbers;
}

}  // namespace

// Without contraction, fp64 knows one result of each operation (OpenCL 1.2, section 7.4), and on
// CPUs the bits are the same. They were on the one GPU that was tried (NVIDIA H100, driver 580),
// too; on GPUs a difference in rounding is let pass, as between the engines.
std::vector<Compared> compare_bits(const Subject& subject) {
  const SweepResult result =
      subject.compute(with_whole_kernel(read_study(impacts("contract = false\n"), "verify")));
  const Plan plan(result.study, result.study.points());
  const Integrate& integrate = result.study.integrate;
  std::vector<Compared> compared;
  for (std::size_t point = 0; point < result.status.size(); ++point) {
    for (std::size_t sample = 0; sample < integrate.record; ++sample) {
      const std::vector<double> host = step_on_host(plan, point, integrate.settle + sample + 1);
      for (std::size_t i = 0; i < host.size(); ++i) {
        compared.push_back({name_of(result.study.model->states[i].name, plan, point), host[i],
                            samples_of(result, point, i)[sample], subject.is_cpu ? 0.0 : 1e-11});
      }
    }
  }
  return compared;
}

// They share the formula alone and round differently: 1e-13 after twelve periods was seen.
std::vector<Compared> compare_engines_fp64(const Subject& subject) {
  return compare_engines(subject, "", 1e-11);
}

// 1536 roundings of 6e-8, if they all added up, are 1e-4 of a state of size 1; the motions separate
// by less than ten times in twelve periods.
std::vector<Compared> compare_engines_fp32(const Subject& subject) {
  return compare_engines(subject, "precision = 'fp32'\n", 1e-3);
}

// In fp32, which every device has; numbers in the file are fp64.
std::vector<Compared> compare_file(const Subject& subject) {
  const SweepResult result = subject.compute(read_study(impacts("precision = 'fp32'\n"), "verify"));
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "map.nc").string();
  write_result(result, path, {"gearsweep verify", version(), source_hash()});
  const Numbers written = numbers_of(result);
  std::vector<Compared> compared = compare_all(written, numbers_in(path, result), 0.0);
  const SweepResult again = subject.compute(read_study(read_study_text(path), "verify"));
  for (const Compared& one : compare_all(written, numbers_of(again), 0.0)) compared.push_back(one);
  return compared;
}

}  // namespace gearsweep
