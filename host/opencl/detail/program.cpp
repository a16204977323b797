#include "opencl/detail/program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "model/error.hpp"
#include "opencl/detail/kernel_sources.hpp"
#include "opencl/detail/observer_source.hpp"

namespace gearsweep {
namespace {

// The file that a line includes; empty when it is no #include "...".
std::string included_file(const std::string& line) {
  const std::string directive = "#include \"";
  if (!line.starts_with(directive)) return "";
  const std::string rest = line.substr(directive.size());
  return rest.substr(0, rest.find('"'));
}

// What the model says of each of its states.
void write_states(const Model& model, std::ostream& out) {
  out << fmt::format("#define RANGE_GROUPS {{{}}}\n", fmt::join(model.range_groups, ", "));
  out << "#define STATE_LIMITS {";
  for (const double limit : model.diverged_above) {
    out << (std::isinf(limit) ? "INFINITY" : fmt::format("{}", limit)) << ", ";
  }
  out << "}\n";
}

// Whether the kept states are still positions, then their velocities in the same order, if the
// whole model's are.
bool has_positions_first(const Reduction& reduction, std::size_t states) {
  const std::size_t half = reduction.kept.size() / 2;
  if (reduction.kept.size() % 2 != 0 || states % 2 != 0) return false;
  for (std::size_t i = 0; i < half; ++i) {
    if (reduction.kept[half + i] != reduction.kept[i] + states / 2) return false;
  }
  return true;
}

// What reduced_model.h wants to know of a reduced model, and the places of the states that it
// keeps.
void write_reduction(const Model& model, std::ostream& out) {
  const Reduction& reduction = model.reduction;
  std::vector<std::string> whole(model.whole->states.size(), "(real)(0)");
  std::string kept;
  for (std::size_t i = 0; i < reduction.kept.size(); ++i) {
    kept += fmt::format("{}, ", reduction.kept[i]);
    whole[reduction.kept[i]] = fmt::format("(x)[{}]", i);
  }
  for (const MirrorPairs::Pair& mirror : reduction.mirrors) {
    whole[mirror.second] = "-" + whole[mirror.first];
  }
  out << fmt::format("#define KEPT_COUNT {}\n#define KEPT_STATES {{{}}}\n", model.states.size(),
                     kept);
  out << fmt::format("#define WHOLE_STATE(x) {{{}}}\n", fmt::join(whole, ", "));
  out << "#include \"reduced_model.h\"\n";
  for (std::size_t i = 0; i < model.states.size(); ++i) {
    out << fmt::format("#define STATE_{} {}\n", model.name_in_kernel(model.states[i].name), i);
  }
  if (!has_positions_first(reduction, whole.size())) out << "#undef MODEL_SECOND_ORDER\n";
}

// A file with what it includes; nothing when it is among `included`, to which it is added.
std::string flatten_once(const std::string& name, const std::map<std::string, std::string>& sources,
                         std::set<std::string>* included) {
  if (!included->insert(name).second) return "";
  const auto source = sources.find(name);
  if (source == sources.end()) {
    throw RunError(fmt::format("kernel source '{}' is missing", name));
  }
  std::istringstream in(source->second);
  std::ostringstream out;
  out << fmt::format("#line 1 \"kernels/{}\"\n", name);
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const std::string file = included_file(line);
    if (file.empty()) {
      out << line << '\n';
    } else {
      out << flatten_once(file, sources, included)
          << fmt::format("#line {} \"kernels/{}\"\n", number + 1, name);
    }
  }
  return out.str();
}

std::string build_log(const cl::Program& program, const cl::Device& device) {
  try {
    return program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device);
  } catch (const cl::Error&) {
    return "(the driver gives no log)";
  }
}

}  // namespace

std::string selection_header(const Study& study) {
  std::ostringstream out;
  if (!study.selection.orders.empty()) {
    out << fmt::format("#define ORDER_COUNT {}\n", study.selection.orders.size());
  }
  out << fmt::format("#include \"models/{}.h\"\n", study.model->name);
  if (study.model->whole != nullptr) write_reduction(*study.model, out);
  out << "#include \"rk4/rk4.h\"\n#define MODEL_OPTION_VALUES {";
  for (const int option : study.setting.options) out << option << ", ";
  // OpenCL C knows no empty initialiser; a model without options has one dummy member.
  if (study.setting.options.empty()) out << 0;
  out << "}\n";
  write_states(*study.model, out);
  out << fmt::format("#define STATES {}\n", study.model->states.size());
  out << fmt::format("#define TANGENTS {}\n", study.selection.tangent_count());
  return out.str();
}

std::string flatten(const std::string& name, const std::map<std::string, std::string>& sources) {
  std::set<std::string> included;
  return flatten_once(name, sources, &included);
}

std::string program_source(const Study& study, const std::string& file) {
  std::map<std::string, std::string> sources = kernel_sources();
  Study seen = study;
  if (file != "sweep.cl") {  // only there does it matter what is observed
    seen.selection = {};
    seen.selection.orders = study.selection.orders;  // but these are in the tables of all
  }
  const Model& model = *seen.model;
  sources[fmt::format("models/{}.h", model.name)] = model.kernel;
  sources["selection.h"] = selection_header(seen);
  sources["observers.h"] = observers_header(seen);
  return flatten(file, sources);
}

std::string build_options(const Study& study, std::size_t lanes, bool rounds_fp32_division) {
  const bool fp64 = study.integrate.fp64;
  return fmt::format(
      "-cl-std=CL1.2 -DREAL_BITS={} -DLANES={} -DCONTRACT={} -DEVENTS={}{}", fp64 ? 64 : 32, lanes,
      study.integrate.contract ? 1 : 0, study.integrate.events ? 1 : 0,
      rounds_fp32_division && !fp64 ? " -cl-fp32-correctly-rounded-divide-sqrt" : "");
}

cl::Program build_program(const cl::Context& context, const cl::Device& device,
                          const std::string& source, const std::string& options) {
  cl::Program program(context, source);
  try {
    // Without warnings, which are not for users: PoCL tells the terminal how many there were.
    program.build({device}, (options + " -w").c_str());
  } catch (const cl::Error& error) {
    throw RunError(fmt::format("cannot build the kernels for '{}' ({})\noptions: {}\n{}",
                               device.getInfo<CL_DEVICE_NAME>(), describe_code(error.err()),
                               options, build_log(program, device)));
  }
  return program;
}

}  // namespace gearsweep
