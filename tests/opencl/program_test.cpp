// Kernel programs: put together, built, and what is said when that fails.
#include "opencl/detail/program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/error.hpp"
#include "opencl/detail/kernel_sources.hpp"
#include "opencl/device.hpp"
#include "opencl/opencl_engine.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// What building `source` says.
std::string build_error(const std::string& source, const std::string& options) {
  const cl::Device device = find_devices().at(default_device(list_devices()));
  const cl::Context context(device);
  try {
    build_program(context, device, source, options);
  } catch (const RunError& error) {
    return error.what();
  }
  return "";
}

std::string default_device_name() {
  const std::vector<DeviceInfo> devices = list_devices();
  return devices[default_device(devices)].name;
}

Study some_study(const std::string& rest = "") {
  return read_study("[[axes]]\nname = 'omega'\nvalues = [0.7]\n" + rest, "test.toml");
}

TEST(Flatten, MarksEachFileWithLine) {
  const std::map<std::string, std::string> sources = {
      {"main.cl", "first\n#include \"part/inner.h\"\nlast\n"},
      {"part/inner.h", "inside\n#include <system.h>\n"}};
  EXPECT_EQ(flatten("main.cl", sources),
            "#line 1 \"kernels/main.cl\"\nfirst\n"
            "#line 1 \"kernels/part/inner.h\"\ninside\n#include <system.h>\n"
            "#line 3 \"kernels/main.cl\"\nlast\n");
}

TEST(Flatten, NamesTheMissingFile) {
  const std::map<std::string, std::string> sources = {{"main.cl", "#include \"gone.h\"\n"}};
  try {
    flatten("main.cl", sources);
    FAIL() << "a missing file was not noticed";
  } catch (const RunError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'gone.h'"));
  }
}

TEST(ProgramSource, IncludesNothingMore) {
  EXPECT_THAT(program_source(some_study(), "sweep.cl"), Not(HasSubstr("#include \"")));
}

TEST(ProgramSource, HasTheObservablesThatTheStudyAsksFor) {
  const std::string source =
      program_source(some_study("[observe]\nquantities = ['x1_rms']\n"), "sweep.cl");
  EXPECT_THAT(source, AllOf(HasSubstr("kernels/observables/moments.h"),
                            Not(HasSubstr("kernels/observables/contact.h")),
                            Not(HasSubstr("kernels/observables/poincare.h"))));
}

TEST(ProgramSource, CallsEachObserverByName) {
  const std::string source = program_source(
      some_study("[observe]\nquantities = ['dmf_mean', 'contact_class', 'period', 'poincare']\n"
                 "poincare = ['v1']\n"),
      "sweep.cl");
  EXPECT_THAT(source,
              AllOf(HasSubstr("real moments_of_dmf_sums[moments_accumulators];"),
                    HasSubstr("moments_init(observers->moments_of_dmf, start->signals.u_dmf);"),
                    HasSubstr("contact_step(observers->contact, contact_depths("),
                    HasSubstr("period_end_period(observers->period, section);"),
                    HasSubstr("poincare_end_period(0, section);"), HasSubstr("{STATE_u_v1, }")));
}

TEST(ProgramSource, ObservesOnlyWhereItRecords) {
  const Study study = some_study("[observe]\nquantities = ['period']\n");
  for (const std::string file : {"orbit.cl", "trace.cl"}) {
    EXPECT_THAT(program_source(study, file), Not(HasSubstr("period_init"))) << file;
  }
}

// So that what one study has compiled serves others over the same model and quantities.
TEST(ProgramSource, IsTheSameForAnyAxes) {
  const Study one = some_study("[[axes]]\nname = 'b'\nvalues = [0.5]\n");
  const Study two = read_study(
      "[[axes]]\nname = 'x1'\nvalues = [0.5]\n[[axes]]\nname = 'omega'\nvalues = [0.7]\n",
      "test.toml");
  for (const std::string file : {"sweep.cl", "orbit.cl", "trace.cl"}) {
    EXPECT_EQ(program_source(two, file), program_source(one, file));
  }
}

TEST(BuildOptions, SayPrecisionLanesContractionAndEvents) {
  const Study study = some_study("[integrate]\nprecision = 'fp32'\ncontract = false\n");
  EXPECT_THAT(build_options(study, 8),
              AllOf(HasSubstr("-DREAL_BITS=32"), HasSubstr("-DLANES=8"), HasSubstr("-DCONTRACT=0"),
                    HasSubstr("-DEVENTS=1"), HasSubstr("-cl-std=CL1.2")));
  EXPECT_THAT(build_options(some_study("[integrate]\nevents = false\n"), 8),
              HasSubstr("-DEVENTS=0"));
  const std::string exact = "-cl-fp32-correctly-rounded-divide-sqrt";
  EXPECT_THAT(build_options(study, 1, true), HasSubstr(exact));
  EXPECT_THAT(build_options(study, 1, false), Not(HasSubstr(exact)));
  EXPECT_THAT(build_options(some_study(), 1, true), Not(HasSubstr(exact)));  // fp64
}

TEST(BuildProgram, AcceptsTheKernels) {
  const Study study = some_study();
  EXPECT_EQ(build_error(program_source(study, "sweep.cl"), build_options(study, 1)), "");
}

// With no observer at all, and with one of each role.
TEST(BuildProgram, AcceptsAnySelection) {
  for (const std::string quantities : {"'status'", "'x1_rms', 'settled', 'poincare'"}) {
    const Study study = some_study("[observe]\nquantities = [" + quantities + "]\n");
    EXPECT_EQ(build_error(program_source(study, "sweep.cl"), build_options(study, 1)), "")
        << quantities;
  }
}

// An error that someone makes in kernels/rk4/rk4.h, say.
TEST(BuildProgram, NamesFileAndLineOfAnError) {
  if (!list_devices().front().is_cpu) GTEST_SKIP() << "NVIDIA's compiler counts lines of the whole";
  const Study study = some_study();
  std::map<std::string, std::string> sources = kernel_sources();
  std::string& text = sources["rk4/rk4.h"];
  const std::size_t lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  text += "this_is_no_type broken;\n";
  sources["models/gear5.h"] = study.model->kernel;
  const std::string source = flatten("dialect.h", sources) + flatten("models/gear5.h", sources) +
                             flatten("rk4/rk4.h", sources);
  const std::string options = build_options(study, 1);
  EXPECT_THAT(build_error(source, options),
              AllOf(HasSubstr("kernels/rk4/rk4.h:" + std::to_string(lines + 1)),
                    HasSubstr("this_is_no_type"), HasSubstr(default_device_name()),
                    HasSubstr("options: " + options)));
}

TEST(Devices, AnUnknownNumberIsTheUsersError) {
  try {
    make_opencl_engine(some_study(), DeviceChoice{999});
    FAIL() << "device 999 was found";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no device 999"));
  }
}

TEST(Devices, WithoutOneTheReferenceEngineIsNamed) {
  try {
    default_device({});
    FAIL() << "a device was chosen from none";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("integrate.engine = \"reference\""));
  }
}

DeviceInfo device_like(bool is_cpu, bool fp64) {
  DeviceInfo info;
  info.is_cpu = is_cpu;
  info.fp64 = fp64;
  return info;
}

TEST(Devices, TheFirstCpuIsTheDefault) {
  const DeviceInfo cpu = device_like(true, true);
  const DeviceInfo gpu = device_like(false, true);
  EXPECT_EQ(default_device({gpu, gpu, cpu}), 2U);
  EXPECT_EQ(default_device({gpu, gpu}), 0U);
}

}  // namespace
}  // namespace gearsweep::testing
