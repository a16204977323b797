// The result file says all of the sweep, opens in xarray without help, and is there whole or not at
// all.
#include "result/result_file.hpp"

#include <gmock/gmock.h>

#include <numeric>

#include "result/example_result.hpp"
#include "result/python.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

namespace fs = std::filesystem;
using gearsweep::testing::example_result;
using gearsweep::testing::kNaN;
using gearsweep::testing::kProvenance;
using gearsweep::testing::run_python;
using gearsweep::testing::spectrum_result;
using gearsweep::testing::Spoken;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::NanSensitiveDoubleEq;
using ::testing::Pointwise;

class ResultFileTest : public gearsweep::testing::IoTest {};

// The same numbers, to the last bit; NaN is equal to NaN.
auto same_numbers(const std::vector<double>& numbers) {
  return Pointwise(::testing::NanSensitiveDoubleEq(), numbers);
}

TEST_F(ResultFileTest, MapsComeBack) {
  const SweepResult result = example_result();
  const ResultFile file(write(result));
  EXPECT_EQ(file.title(), result.study.title);
  EXPECT_THAT(file.quantities(), ElementsAre("status", "x1_rms", "contact_class", "poincare"));

  const ResultMap map = file.read("x1_rms");
  EXPECT_THAT(map.values, same_numbers(result.values[0]));
  EXPECT_EQ(map.unit, "b_n");
  EXPECT_THAT(map.meaning, HasSubstr("root mean square"));
  ASSERT_EQ(map.axes.size(), 2U);
  EXPECT_EQ(map.axes[0].name, "omega");
  EXPECT_EQ(map.axes[0].unit, "varpi");
  EXPECT_EQ(map.axes[0].values, result.study.axes[0].values);
  EXPECT_EQ(map.axes[1].name, "b");
  EXPECT_EQ(map.axes[1].values, result.study.axes[1].values);
}

TEST_F(ResultFileTest, AClassHasNamesAndNoClassIsMissing) {
  const SweepResult result = example_result();
  const ResultMap map = ResultFile(write(result)).read("contact_class");
  EXPECT_THAT(map.flags, ElementsAre("no_impact", "single_sided", "double_sided", "wedged"));
  EXPECT_THAT(map.values, same_numbers(result.values[1]));
}

TEST_F(ResultFileTest, StatusIsAlwaysThereWithTheNamesOfItsCodes) {
  SweepResult result = example_result();
  result.study.selection.quantities.clear();
  result.study.selection.poincare.clear();
  result.values.clear();
  const ResultFile file(write(result));
  EXPECT_THAT(file.quantities(), ElementsAre("status"));
  const ResultMap status = file.read("status");
  EXPECT_EQ(status.values[5], STATUS_diverged);
  EXPECT_EQ(status.flags[STATUS_diverged], "diverged");
  EXPECT_EQ(status.flags[STATUS_ok], "ok");
}

TEST_F(ResultFileTest, PoincareSamplesComeBackByState) {
  const SweepResult result = example_result();
  const ResultFile file(write(result));
  EXPECT_THAT(file.poincare_states(), ElementsAre("x1", "v1"));
  const ResultMap all = file.read("poincare");
  EXPECT_EQ(all.samples, 5U);
  EXPECT_THAT(all.values, same_numbers(result.samples));

  const ResultMap velocity = file.read("poincare:v1");
  ASSERT_EQ(velocity.parts.size(), 1U);
  EXPECT_EQ(velocity.unit, "b_n varpi");
  EXPECT_EQ(velocity.values.size(), 12U * 5U);
  EXPECT_EQ(velocity.values[7 * 5 + 3], result.samples[(7 * 2 + 1) * 5 + 3]);
}

// Orders are called by their values, which need not be whole.
TEST_F(ResultFileTest, AmplitudesComeBackByOrder) {
  SweepResult result = example_result();
  const Model& model = *result.study.model;
  result.study.selection = select_quantities(model, {"x1_order_amplitude"}, {}, {0.5, 1.0, 2.5});
  result.samples.clear();
  result.values = {std::vector<double>(3 * result.status.size())};
  std::iota(result.values[0].begin(), result.values[0].end(), 1.0);
  const ResultFile file(write(result));
  const ResultMap all = file.read("x1_order_amplitude");
  EXPECT_EQ(all.dimension, "order");
  ASSERT_EQ(all.part_count(), 3U);
  EXPECT_EQ(all.parts[0].name, "0.5");
  EXPECT_EQ(all.parts[0].unit, "b_n");
  const ResultMap first = file.read("x1_order_amplitude:1");
  EXPECT_EQ(first.values[4], result.values[0][4 * 3 + 1]);
  EXPECT_THAT(first.meaning, HasSubstr("order 1"));
  EXPECT_THAT(refusal([&] { file.read("x1_order_amplitude:2"); }),
              HasSubstr("no quantity 'x1_order_amplitude:2'"));
  // One order has its dimension, too.
  result.study.selection = select_quantities(model, {"x1_order_phase"}, {}, {4.0});
  result.values = {std::vector<double>(result.status.size(), 0.25)};
  const ResultFile single(write(result, "single.nc"));
  EXPECT_EQ(single.read("x1_order_phase:4").values[0], 0.25);
  EXPECT_EQ(single.read("x1_order_phase").unit, "rad");
}

TEST_F(ResultFileTest, ALyapunovSpectrumComesBackByExponent) {
  const SweepResult result = spectrum_result();
  const ResultFile file(write(result));
  EXPECT_THAT(file.quantities(), ElementsAre("status", "lyapunov_max", "lyapunov_spectrum"));
  EXPECT_THAT(file.poincare_states(), ElementsAre());
  EXPECT_TRUE(file.read("lyapunov_max").parts.empty());

  const ResultMap all = file.read("lyapunov_spectrum");
  EXPECT_EQ(all.dimension, "exponent");
  EXPECT_EQ(all.part_count(), 10U);
  EXPECT_EQ(all.parts[9].name, "10");
  EXPECT_FALSE(all.is_poincare());
  EXPECT_THAT(all.values, same_numbers(result.values[1]));

  const ResultMap first = file.read("lyapunov_spectrum:1");
  EXPECT_THAT(first.values, same_numbers(result.values[0]));
  EXPECT_EQ(first.unit, "1/tau");
  EXPECT_THAT(first.meaning, HasSubstr("exponent 1"));
  const ResultMap tenth = file.read("lyapunov_spectrum:10", file.find_cut("b", 1.5));
  ASSERT_EQ(tenth.values.size(), 4U);
  EXPECT_EQ(tenth.values[3], result.values[1][11 * 10 + 9]);
  EXPECT_THAT(refusal([&] { file.read("lyapunov_spectrum:11"); }),
              HasSubstr("no quantity 'lyapunov_spectrum:11'"));
  EXPECT_THAT(refusal([&] { file.read("lyapunov_max:1"); }),
              HasSubstr("no quantity 'lyapunov_max:1'"));
  EXPECT_THAT(refusal([&] { file.read("lyapunov_spectrun:2"); }),
              HasSubstr("did you mean 'lyapunov_spectrum:2'?"));
}

TEST_F(ResultFileTest, ASpectrumOfOneAxisInSinglePrecision) {
  SweepResult result = spectrum_result(7, 0);
  result.study.integrate.fp64 = false;
  const ResultMap map = ResultFile(write(result)).read("lyapunov_spectrum");
  ASSERT_EQ(map.values.size(), 70U);
  EXPECT_EQ(map.values[62], static_cast<double>(static_cast<float>(result.values[1][62])));
  EXPECT_TRUE(std::isnan(map.values[50]));
}

// The list of attractors has a dimension of its own and is no map.
TEST_F(ResultFileTest, AttractorsAreListedBesideTheMaps) {
  SweepResult result = example_result();
  result.study.selection = select_quantities(*result.study.model, {"attractor"}, {});
  result.study.selection.quantities[0].flags = {"undecided", "1_period_1", "2_chaotic"};
  result.values = {std::vector<double>(12, 2.0)};
  result.samples.clear();
  result.attractors = {
      {.motion = 1, .period = 1.0, .rms = 1.25, .peak = 0.2, .exponent = -0.01, .trajectories = 3},
      {.motion = 3, .period = 0.0, .rms = 1.5, .peak = 0.7, .exponent = 0.04, .trajectories = 9}};
  const std::string path = write(result);
  const ResultFile file(path);
  EXPECT_THAT(file.quantities(), ElementsAre("status", "attractor"));
  EXPECT_EQ(file.read("attractor").flags[2], "2_chaotic");
  const Spoken spoken = run_python(
      "import sys, xarray\n"
      "maps = xarray.open_dataset(sys.argv[1])\n"
      "assert maps.attractor_period.dims == ('attractor_number',)\n"
      "assert list(maps.attractor_number) == [1, 2]\n"
      "assert list(maps.attractor_period) == [1, 0]\n"
      "assert list(maps.attractor_x1_rms) == [1.25, 1.5]\n"
      "assert list(maps.attractor_dmf_max) == [0.2, 0.7]\n"
      "assert list(maps.attractor_lyapunov_max) == [-0.01, 0.04]\n"
      "assert list(maps.attractor_share) == [0.25, 0.75]\n"
      "names = maps.attractor_motion_class.flag_meanings.split()\n"
      "assert names[int(maps.attractor_motion_class[1])] == 'chaotic'\n",
      path);
  EXPECT_EQ(spoken.status, 0) << spoken.text;
}

TEST_F(ResultFileTest, NoAttractorFoundIsAnEmptyList) {
  SweepResult result = example_result();
  result.study.selection = select_quantities(*result.study.model, {"attractor"}, {});
  result.values = {std::vector<double>(12, 0.0)};
  result.samples.clear();
  EXPECT_THAT(ResultFile(write(result)).quantities(), ElementsAre("status", "attractor"));
}

TEST_F(ResultFileTest, SamplesOfManyPointsAreWrittenBlockByBlock) {
  SweepResult result = example_result(700, 2);
  const std::size_t record = result.study.integrate.record = 300;
  result.samples.resize(1400 * 2 * record);
  for (std::size_t i = 0; i < result.samples.size(); ++i) {
    result.samples[i] = static_cast<double>(i);
  }
  EXPECT_EQ(ResultFile(write(result)).read("poincare").values, result.samples);
}

TEST_F(ResultFileTest, OneAxisGivesMapsOfOneDimension) {
  const SweepResult result = example_result(7, 0);
  const ResultFile file(write(result));
  ASSERT_EQ(file.axes().size(), 1U);
  EXPECT_THAT(file.read("x1_rms").values, same_numbers(result.values[0]));
  EXPECT_THAT(file.read("poincare").values, same_numbers(result.samples));
}

TEST_F(ResultFileTest, SinglePrecisionKeepsTheFloatsAndInfinity) {
  SweepResult result = example_result();
  result.study.integrate.fp64 = false;
  result.values[0][0] = INFINITY;
  const ResultMap map = ResultFile(write(result)).read("x1_rms");
  EXPECT_EQ(map.values[0], INFINITY);
  EXPECT_TRUE(std::isnan(map.values[5]));
  EXPECT_EQ(map.values[1], static_cast<double>(static_cast<float>(result.values[0][1])));
}

TEST_F(ResultFileTest, ACutIsTheNearestRowOrColumn) {
  const SweepResult result = example_result();
  const ResultFile file(write(result));
  const Cut row = file.find_cut("b", 1.0);  // of 0.3, 0.9, 1.5
  EXPECT_EQ(row.index, 1U);
  EXPECT_THAT(file.read("x1_rms", row).values, same_numbers({10.1, kNaN, 12.1, 13.1}));
  const Cut column = file.find_cut("omega", 2.0);
  EXPECT_THAT(file.read("x1_rms", column).values, same_numbers({3.1, 13.1, 23.1}));
  EXPECT_EQ(file.read("x1_rms", column).axes[0].name, "b");
  EXPECT_THAT(refusal([&] { file.find_cut("b", 7.0); }),
              AllOf(HasSubstr("b = 7"), HasSubstr("from 0.3 to 1.5")));
  EXPECT_THAT(refusal([&] { file.find_cut("omga", 1.0); }), HasSubstr("did you mean 'omega'"));
}

TEST_F(ResultFileTest, AnUnknownQuantityIsRefusedWithTheNearest) {
  const ResultFile file(write(example_result()));
  EXPECT_THAT(refusal([&] { file.read("x1_rsm"); }), HasSubstr("did you mean 'x1_rms'?"));
  EXPECT_THAT(refusal([&] { file.read("poincare:v2"); }), HasSubstr("poincare:v1"));
  EXPECT_THAT(refusal([&] { file.read("x1_rms:v1"); }), HasSubstr("no quantity 'x1_rms:v1'"));
  EXPECT_THAT(refusal([&] { file.read("omega"); }), HasSubstr("no quantity 'omega'"));
}

TEST_F(ResultFileTest, HoldsTheStudyOfAnyLength) {
  SweepResult result = example_result();
  // A list of values can make a study longer than the 64 KiB of a plain HDF5 attribute.
  result.study.toml += "# " + std::string(300000, 'x') + "\n";
  EXPECT_EQ(read_study_text(write(result)), result.study.toml);
}

TEST_F(ResultFileTest, OtherFilesAreNotTakenForResults) {
  const std::string text = in_folder("study.toml");
  std::ofstream(text) << "title = 'not NetCDF'\n";
  EXPECT_FALSE(is_netcdf(text));
  EXPECT_FALSE(is_netcdf(in_folder("missing.nc")));
  EXPECT_FALSE(is_netcdf(folder_.string()));
  EXPECT_THAT(refusal([&] { read_study_text(text); }),
              AllOf(HasSubstr("study.toml"), HasSubstr("not a NetCDF file")));
  EXPECT_THAT(refusal([&] { ResultFile{in_folder("missing.nc")}; }), HasSubstr("cannot open"));

  const std::string whole = write(example_result());
  EXPECT_TRUE(is_netcdf(whole));
  const std::string half = in_folder("half.nc");
  std::ofstream(half, std::ios::binary) << content(whole).substr(0, 2000);
  EXPECT_THAT(refusal([&] { ResultFile{half}; }), HasSubstr("cut short"));

  // The smallest file of the classic format: no dimension, attribute or variable.
  const std::string foreign = in_folder("foreign.nc");
  std::ofstream(foreign, std::ios::binary) << "CDF\x01" + std::string(28, '\0');
  EXPECT_THAT(refusal([&] { read_study_text(foreign); }), HasSubstr("did not write"));
  EXPECT_THAT(refusal([&] { ResultFile{foreign}; }), HasSubstr("did not write"));
}

TEST_F(ResultFileTest, ABadPlaceIsRefusedAndLeftAsItWas) {
  const std::string file = in_folder("file");
  std::ofstream(file) << "x";
  for (const std::string& path :
       {in_folder("missing/map.nc"), file + "/map.nc", folder_.string(), in_folder("")}) {
    EXPECT_THAT(refusal([&] { ensure_writable(path); }), HasSubstr("cannot write")) << path;
    EXPECT_NE(refusal([&] { write_result(example_result(), path, kProvenance); }), "accepted");
  }
  EXPECT_THAT(refusal([&] { ensure_writable("/dev/null"); }), HasSubstr("not a plain file"));
  EXPECT_THAT(refusal([&] { ensure_writable(""); }), HasSubstr("cannot write"));
  EXPECT_EQ(files(), 1U);
}

TEST_F(ResultFileTest, AGoodPlaceIsLeftAsItWasUntilTheResultIsThere) {
  const std::string path = in_folder("map.nc");
  ensure_writable(path);
  EXPECT_EQ(files(), 0U);
  std::ofstream(path) << "before";
  ensure_writable(path);
  EXPECT_EQ(content(path), "before");
  EXPECT_EQ(files(), 1U);
}

TEST_F(ResultFileTest, AFailureKeepsTheOldFileAndNoOther) {
  const std::string path = in_folder("map.nc");
  std::ofstream(path) << "before";
  SweepResult result = example_result();
  // Two variables of one name: the library refuses the second when the file is half written.
  result.study.selection.quantities[1].name = "x1_rms";
  EXPECT_THROW(write_result(result, path, kProvenance), RunError);
  EXPECT_EQ(content(path), "before");
  EXPECT_EQ(files(), 1U);
}

TEST_F(ResultFileTest, ALinkStaysALink) {
  fs::create_directory(folder_ / "elsewhere");
  std::ofstream(in_folder("elsewhere/map.nc")) << "before";
  fs::create_symlink(fs::path("elsewhere") / "map.nc", folder_ / "map.nc");
  write(example_result());
  EXPECT_TRUE(fs::is_symlink(folder_ / "map.nc"));
  EXPECT_TRUE(is_netcdf(in_folder("elsewhere/map.nc")));
}

constexpr const char* kXarrayScript = R"(
import sys
import numpy as np
import xarray as xr

ds = xr.open_dataset(sys.argv[1])
assert dict(ds.sizes) == {"b": 3, "omega": 4, "state": 2, "sample": 5}, ds.sizes
assert ds["x1_rms"].dims == ("b", "omega")
assert ds["x1_rms"].dtype == np.float64
assert ds["poincare"].dims == ("b", "omega", "state", "sample")
# The reader may place the values in another order of operations: two roundings.
np.testing.assert_allclose(ds["omega"], np.linspace(0.4, 2.0, 4), rtol=5e-16)
np.testing.assert_allclose(ds["b"], [0.3, 0.9, 1.5], rtol=5e-16)
np.testing.assert_array_equal(ds["sample"], np.arange(1, 6))
assert ds["omega"].attrs["units"] == "varpi"
assert ds["omega"].attrs["long_name"] == "mesh frequency / varpi"
assert ds["omega"].attrs["scale_to_SI"] == 1000.0
assert ds["omega"].attrs["SI_units"] == "rad/s"
assert ds["x1_rms"].attrs["units"] == "b_n"
assert ds["x1_rms"].attrs["scale_to_SI"] == 2e-5
assert ds["x1_rms"].attrs["SI_units"] == "m"

x1 = ds["x1_rms"]
assert x1.sel(b=1.5, omega=2.0, method="nearest") == 23.1
assert np.isnan(x1[1, 1]) and int(np.isnan(x1).sum()) == 1
assert x1[2, 0] == 20.1

contact = ds["contact_class"]
assert contact.attrs["flag_meanings"] == "no_impact single_sided double_sided wedged"
assert list(contact.attrs["flag_values"]) == [0, 1, 2, 3]
assert np.isnan(contact[1, 1]) and contact[0, 2] == 2
assert ds["status"].dtype == np.int8 and ds["status"][1, 1] == 1 and ds["status"].sum() == 1
assert ds["status"].attrs["flag_meanings"].split()[:2] == ["ok", "diverged"]
assert list(ds["status"].attrs["flag_values"])[:2] == [0, 1]

assert list(ds["state"].values) == ["x1", "v1"], ds["state"].values
assert list(ds["state_units"].values) == ["b_n", "b_n varpi"]
v1 = ds["poincare"].sel(state="v1", sample=4)
np.testing.assert_allclose(v1[2, 3], 11 + 0.01 + 0.003, rtol=1e-15)

attrs = ds.attrs
assert attrs["title"] == 'omega x b, "coarse" gear'
assert attrs["study"].startswith("title = 'ϖ'"), attrs["study"]
assert attrs["gearsweep_version"] == "0.1.0" and attrs["source_hash"] == "abcdef"
assert attrs["device"] == "a device" and attrs["driver"] == "3.1"
assert attrs["kernel_macros"] == "-DLANES=8"
assert attrs["command_line"] == "gearsweep run study.toml -o 'map one.nc'"
np.datetime64(attrs["created"].rstrip("Z"))
assert attrs["integration_steps"] == 12345 and attrs["compute_seconds"] == 0.5
assert attrs["scale_varpi_rad_per_s"] == 1000.0 and attrs["scale_b_n_m"] == 2e-5
assert attrs["scale_k0_N_per_m"] == 1e8 and attrs["scale_force_N"] == 1e8 * 2e-5
assert attrs["scale_rpm_per_omega"] == 250.0
)";

constexpr const char* kSpectrumScript = R"(
import sys
import numpy as np
import xarray as xr

ds = xr.open_dataset(sys.argv[1])
spectrum = ds["lyapunov_spectrum"]
assert spectrum.dims == ("b", "omega", "exponent"), spectrum.dims
np.testing.assert_array_equal(ds["exponent"], np.arange(1, 11))
assert spectrum.attrs["units"] == "1/tau" and spectrum.attrs["SI_units"] == "1/s"
np.testing.assert_array_equal(spectrum.sel(exponent=1), ds["lyapunov_max"])
np.testing.assert_allclose(spectrum[2, 3, 9], 0.3 + 0.11 - 1.0, rtol=1e-15)
assert np.isnan(spectrum[1, 1]).all() and int(np.isnan(spectrum).sum()) == 10
)";

TEST_F(ResultFileTest, XarraySelectsAnExponent) {
  SweepResult result = spectrum_result();
  result.study.scales = {1000.0, 2e-5, 1e8, 250.0};
  const Spoken said = run_python(kSpectrumScript, write(result));
  EXPECT_EQ(said.status, 0) << said.text;
}

TEST_F(ResultFileTest, XarrayOpensItWithNamesAndUnits) {
  SweepResult result = example_result();
  result.study.scales = {1000.0, 2e-5, 1e8, 250.0};
  const Spoken said = run_python(kXarrayScript, write(result));
  EXPECT_EQ(said.status, 0) << said.text;
}

}  // namespace
}  // namespace gearsweep
